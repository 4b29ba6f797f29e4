"""How a device takes a write: value by value, whole values only, and what it does at the first one it refuses."""

from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.model import Later, Register, RegisterMap, Space
from regscribe.reference import holds
from regscribe.simulate.device import codec
from regscribe.simulate.device.accepted_values import accepts
from regscribe.simulate.device.address_index import AddressIndex, AddressSpan
from regscribe.simulate.device.commands import Commands
from regscribe.simulate.device.device_plan import Stored
from regscribe.simulate.device.read_requests import check_request
from regscribe.simulate.device.refusal import Refusal
from regscribe.simulate.device.side_effects import Conduct
from regscribe.simulate.device.state import DeviceState

WRITE_ONE = 6


@dataclass(frozen=True, slots=True)
class _Written:
    place: AddressSpan
    words: tuple[int, ...]
    before: Stored


@dataclass(frozen=True, slots=True)
class Writer:
    """Writes words (or bits) of one device through any view; half of a value is refused as misaligned."""

    register_map: RegisterMap
    layout: AddressIndex
    state: DeviceState
    commands: Commands
    conduct: Conduct

    def write(self, space: Space, function: int, address: int, words: Sequence[int]) -> int:
        """Write from `address` on; returns how many words (bits) were written. Raises Refusal.

        Where the protocol says that a later bad word stops the write, fewer than all may be written; otherwise a
        refused request leaves the state as it was. A command counts as run once its words are written.
        """
        most = self.register_map.accepted("write_bits" if space.is_bits else "write_words")
        check_request(self.register_map.faults, self.layout, space, function, address, len(words), most=most)
        place = self.layout.place(space, address)
        holds = place is not None and place.register.access.writable  # a read-only register may still take a command
        if not holds and self.commands.is_step(space, address, words, function=function):
            self.conduct.commanded(self.commands.saw(space, address, words))
            return len(words)
        return self._write_values(space, function, address, words)

    def _write_values(self, space: Space, function: int, address: int, words: Sequence[int]) -> int:
        written: list[_Written] = []
        commanded = self.commands.is_step(space, address, words)
        done = 0
        try:
            while done < len(words):
                place = self._place(space, function, address + done, len(words) - done)
                value = tuple(words[done : done + place.words])
                written.append(self._write_value(place, value, limited=not commanded))
                done += place.words
        except Refusal:
            if not done or self.register_map.faults.later_write is not Later.STOP:
                self._undo(written)
                raise
        for each in written:
            self.conduct.written(each.place.register, each.before)
            self.conduct.commanded(self.commands.saw(space, each.place.start, each.words))
        if len(written) > 1 and done == len(words):  # a step may write several values at once
            self.conduct.commanded(self.commands.saw(space, address, words))
        return done

    def _undo(self, written: Sequence[_Written]) -> None:
        for each in reversed(written):
            self.state.store(each.place.register.path, each.before)

    def _write_value(self, place: AddressSpan, words: tuple[int, ...], *, limited: bool) -> _Written:
        path = place.register.path
        self._check_access(place.register)
        before = self.state.stored(path)
        self.state.store(path, self._accepted(place, words, limited=limited))
        return _Written(place, words, before)

    def _place(self, space: Space, function: int, address: int, left: int) -> AddressSpan:
        faults = self.register_map.faults
        place = self.layout.place(space, address)
        if place is None:
            if (space, address) in self.layout.reserved:
                raise Refusal(faults.read_only)
            if (space, address) in self.layout.command_addresses:
                raise Refusal(faults.value)
            raise Refusal(faults.unused_write if (space, address) in self.layout.unused else faults.address)
        if not place.view.allows(function):
            raise Refusal(faults.view_function)
        if address != place.start:
            raise Refusal(faults.misaligned_address)
        if place.words > left:
            raise Refusal(faults.view_function if function == WRITE_ONE else faults.misaligned_count)
        return place

    def _check_access(self, register: Register) -> None:
        if not register.access.writable:
            raise Refusal(self.register_map.faults.read_only)
        if register.writable is not None and not holds(register.writable.when, self.state):
            raise Refusal(self.register_map.faults.condition)
        if register.unlock and register.unlock not in self.commands.since_power:
            raise Refusal(self.register_map.faults.condition)

    def _accepted(self, place: AddressSpan, words: tuple[int, ...], *, limited: bool) -> Stored:
        register, view = place.register, place.view
        stored = codec.decode(view, words, self.state.order(view))
        if isinstance(stored, str):
            return stored
        if stored is None:
            raise Refusal(self.register_map.faults.value)
        held = self.state.kept(register, stored)
        limited = limited and not self.commands.is_step(view.space, place.start, words)
        if limited and not accepts(register, self.state.to_value(register, held), self.state):
            raise Refusal(self.register_map.faults.value)
        return held
