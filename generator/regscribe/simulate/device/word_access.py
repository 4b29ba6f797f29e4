"""Read and write requests to the words (or bits) of a device, with its answers to those that it refuses."""

import struct
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from regscribe.model import Later, Register, Space
from regscribe.reference import holds
from regscribe.simulate.device import codec
from regscribe.simulate.device.commands import Commands
from regscribe.simulate.device.device_plan import AddressSpan, Blueprint, Stored
from regscribe.simulate.device.side_effects import Conduct
from regscribe.simulate.device.state import DeviceState
from regscribe_runtime.values.kinds import DIVISIBLE

WRITE_ONE = 6


class Refusal(Exception):  # noqa: N818 -- the device refuses; nothing went wrong in the program
    """The device refuses a request: `code` is the exception code that it answers, or `SILENCE`."""

    def __init__(self, code: int) -> None:
        super().__init__(f"exception code {code}")
        self.code = code


def check_request(blueprint: Blueprint, space: Space, function: int, address: int, count: int, *, most: str) -> None:
    """Refuse a request for its form: count (`most` names the limit), function or alignment in the region of a view.

    The form is checked before any register is looked up, as devices do.
    """
    faults = blueprint.register_map.faults
    if not 1 <= count <= blueprint.register_map.most(space, most):
        raise Refusal(faults.quantity)
    region = blueprint.layout.region(space, address, function)
    if region is None:
        return
    if region.functions and function not in region.functions:
        raise Refusal(faults.view_function)
    if count % region.align:
        raise Refusal(faults.misaligned_count)
    if address % region.align:
        raise Refusal(faults.misaligned_address)


@dataclass(frozen=True, slots=True)
class WordAccess:
    """Reads and writes words of one device through any view; half of a value is refused as misaligned.

    `seed` and `unit` make the garbage behind the end of a value its own, and the same at every run.
    """

    state: DeviceState
    commands: Commands
    conduct: Conduct
    seed: int
    unit: int

    def read(self, space: Space, function: int, address: int, count: int) -> tuple[int, ...]:
        """Return the `count` words (bits) from `address` on; raises Refusal."""
        blueprint = self.state.blueprint
        check_request(blueprint, space, function, address, count, most="read")
        for each in range(address, address + count):
            place = self.state.place(space, each)
            if place is not None and not place.view.allows(function):
                raise Refusal(blueprint.register_map.faults.view_function)
        found = tuple(
            self._fill(space, address + index, first=index == 0) if word is None else word
            for index, word in enumerate(self.state.words(space, address, count))
        )
        self._clear(space, address, count)
        return found

    def _clear(self, space: Space, address: int, count: int) -> None:
        """Set what this reading clears to 0, or to an empty text."""
        places = (self.state.place(space, each) for each in range(address, address + count))
        for path in {place.register.path for place in places if place and place.register.reading.clears}:
            self.state.store(path, "" if isinstance(self.state.stored(path), str) else Fraction(0))

    def _fill(self, space: Space, address: int, *, first: bool) -> int:
        """The word at an address where no readable register stands; raises Refusal."""
        layout, register_map = self.state.blueprint.layout, self.state.blueprint.register_map
        later = register_map.faults.later_read
        if (space, address) in layout.fixed:
            return layout.fixed[space, address]
        if (space, address) in layout.silent:
            return 0
        hole = layout.documents(space, address) and self.state.place(space, address) is None
        if hole and later is not Later.GARBAGE and register_map.protocol.read_holes:
            return 0
        if first or later not in {Later.GARBAGE, Later.ZEROS}:
            raise Refusal(register_map.faults.address)
        garbage = zlib.crc32(struct.pack(">qBI", self.seed, self.unit & 0xFF, address))
        return 0 if later is Later.ZEROS else garbage & (1 if space.is_bits else 0xFFFF)

    def write(self, space: Space, function: int, address: int, words: Sequence[int]) -> int:
        """Write from `address` on; returns how many words (bits) were written. Raises Refusal.

        The values are written one by one. Where the protocol says that a later bad word stops the write, fewer than all
        may be written; otherwise a refused request leaves the state as it was. A command is run once its words are
        written.
        """
        check_request(self.state.blueprint, space, function, address, len(words), most="write")
        place = self.state.place(space, address, writing=True)
        writable = place is not None and place.register.access.writable
        if not writable and self.commands.is_step(space, address, words, function=function):
            self.conduct.commanded(self.commands.saw(space, address, words))
            return len(words)
        argument = None if writable else self.commands.argument(space, address, words, function=function)
        if argument is not None:
            self._accepted(AddressSpan(argument, argument.write_view, address), tuple(words), limited=True)
            self.conduct.commanded(self.commands.saw(space, address, words))
            return len(words)
        return self._write_values(space, function, address, words)

    def _write_values(self, space: Space, function: int, address: int, words: Sequence[int]) -> int:
        written: list[tuple[AddressSpan, int, tuple[int, ...], Stored]] = []
        limited = not self.commands.is_step(space, address, words)
        done = 0
        try:
            while done < len(words):
                place = self._place(space, function, address + done, len(words) - done)
                self._check_access(place.register)
                start, before = address + done, self.state.stored(place.register.path)
                sent = tuple(words[done : done + place.end - start])
                self.state.store(
                    place.register.path, self._accepted(place, self._whole(place, start, sent), limited=limited)
                )
                written.append((place, start, sent, before))
                done += len(sent)
        except Refusal:
            if not done or self.state.blueprint.register_map.faults.later_write is not Later.STOP:
                for place, _, _, before in reversed(written):
                    self.state.store(place.register.path, before)
                raise
        for place, start, sent, before in written:
            self.conduct.written(place.register, before)
            self.conduct.commanded(self.commands.saw(space, start, sent))
        if len(written) > 1 and done == len(words):  # a step may write several values at once
            self.conduct.commanded(self.commands.saw(space, address, words))
        return done

    def _place(self, space: Space, function: int, address: int, left: int) -> AddressSpan:
        faults, layout = self.state.blueprint.register_map.faults, self.state.blueprint.layout
        place = self.state.place(space, address, writing=True)
        if place is None:
            if (space, address) in layout.reserved or (space, address) in layout.fixed:
                raise Refusal(faults.read_only)
            if (space, address) in layout.command_addresses:
                raise Refusal(faults.value)
            raise Refusal(faults.unused_write if (space, address) in layout.unused else faults.address)
        if not place.view.allows(function):
            raise Refusal(faults.view_function)
        if self._is_divisible(place):
            return place
        if address != place.start:
            raise Refusal(faults.misaligned_address)
        if place.view.words > left:
            raise Refusal(faults.view_function if function == WRITE_ONE else faults.misaligned_count)
        return place

    def _is_divisible(self, place: AddressSpan) -> bool:
        """Whether a value takes several requests."""
        most = self.state.blueprint.register_map.protocol.most_written(place.view.space)
        return place.register.kind in DIVISIBLE and place.view.words > most

    def _whole(self, place: AddressSpan, start: int, sent: tuple[int, ...]) -> tuple[int, ...]:
        """All words of a value of which some are sent, from the address `start` on."""
        if len(sent) == place.view.words:
            return sent
        held, before = self.state.peek_words(place.register.path, place.view.name), start - place.start
        return (*held[:before], *sent, *held[before + len(sent) :])

    def _check_access(self, register: Register) -> None:
        faults = self.state.blueprint.register_map.faults
        if not register.access.writable:
            raise Refusal(faults.read_only)
        if register.writable is not None and not holds(register.writable.when, self.state):
            raise Refusal(faults.condition)
        if register.unlock and register.unlock not in self.commands.since_power:
            raise Refusal(faults.condition)

    def _accepted(self, place: AddressSpan, words: tuple[int, ...], *, limited: bool) -> Stored:
        """The value to store for the words of one value; `limited` unless the whole request is a step of a command."""
        register, view, state = place.register, place.view, self.state
        stored = codec.decode(state.seen(view), words, state.order(view))
        if isinstance(stored, str):
            return stored
        held = None if stored is None else state.kept(register, stored)
        limited = limited and not self.commands.is_step(view.space, place.start, words)
        if held is None or (limited and not state.accepts(register, state.to_value(register, held))):
            raise Refusal(state.blueprint.register_map.faults.value)
        return held
