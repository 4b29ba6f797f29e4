"""A simulated device: requests in, answers (or silence) out, without any line in between."""

import math
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from threading import RLock
from typing import Any

from regscribe.model import SILENCE, Model, RegisterMap, Space
from regscribe.simulate.device import state_files
from regscribe.simulate.device.commands import Commands
from regscribe.simulate.device.side_effects import Conduct
from regscribe.simulate.device.state import DeviceState, Value
from regscribe.simulate.device.value_arguments import GivenValue, Plain
from regscribe.simulate.device.word_access import Refusal, WordAccess
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.line.line_settings import Tuning
from regscribe.simulate.process.controller import controller_of
from regscribe.simulate.process.thermal_process import ThermalProcess
from regscribe_runtime.values.wire_types import PAGE_BITS, WRITE_AND_READ
from regscribe_runtime.wire import enron, identification, parts
from regscribe_runtime.wire import requests as functions
from regscribe_runtime.wire.packing import MalformedError
from regscribe_runtime.wire.pdu import EXCEPTION_BIT, CoilStateError, decode_request, encode_reply
from regscribe_runtime.wire.requests import Reply, Request

READS = {1: Space.COIL, 2: Space.DISCRETE, 3: Space.HOLDING, 4: Space.INPUT}


class SimulatedDevice:
    """One device of one model: typed state, the map's limits and faults, and commands that were run.

    `handle` is pure but for the state: no I/O, no clock. All methods may be called from any thread. Registers whose
    write needs an `unlock` refuse it (as an unmet condition) until that command was run since power came. A write
    that needs an `apply` shows at once and counts after that command. `seed` decides the garbage that some devices
    send for addresses that they do not have, the noise of `process` and the latencies. `addressing` is modbus, or
    jbus for a device that counts its addresses from 1; a register that governs these or the unit id changes them. With
    a `process`, the map's process value moves as time passes (`advance`); without one it stays where it is put, and
    outputs and alarms follow it. `bases` are addresses by the ids of blocks, and of chains (their markers); where none
    is stated, a chain begins where the device may have it, with the blocks of the map one behind the other. It is
    `without` some of the registers that not every device has.
    """

    def __init__(  # noqa: PLR0913 (all but two are keywords)
        self,
        register_map: RegisterMap,
        model: str,
        *,
        unit: int | None = None,
        givens: Mapping[str, GivenValue] | None = None,
        seed: int = 0,
        addressing: str = "modbus",
        process: ThermalProcess | bool = False,
        bases: Mapping[str, int] | None = None,
        without: Collection[str] = (),
    ) -> None:
        self.register_map = register_map
        self.state = DeviceState.of(register_map, _model(register_map, model), givens or {}, bases or {}, without)
        self.model = self.state.blueprint.model
        self.seed = seed
        self._tuning = Tuning(self.state, unit=_unit(register_map, unit), addressing=addressing)
        self._protocol = register_map.protocol
        self._commands = Commands(self.model.commands, self.state)
        self._conduct = Conduct(self.state, self._commands, controller_of(self.state, process=process, seed=seed))
        self._words = WordAccess(self.state, self._commands, self._conduct, seed, self.unit)
        self.moves = bool(process)
        self._asked: int | None = None
        self._lock = RLock()
        self._long = self.state.blueprint.layout.plain(Space.ENRON)
        self._functions: dict[int, Callable[[bytes], bytes]] = {
            **dict.fromkeys(READS, self._read),
            **dict.fromkeys(functions.WRITES, self._write),
            functions.READ_STATUS: self._status,
            functions.READ_FILE: self._read_records,
            functions.WRITE_FILE: self._write_records,
            functions.READ_QUEUE: self._read_queue,
            functions.IDENTIFY: self._identify,
            functions.LOOPBACK: self._loopback,
            functions.MASK_REGISTER: self._mask_word,
            WRITE_AND_READ: self._write_and_read,
        }

    @property
    def unit(self) -> int:
        """The unit id to which it answers now."""
        return self._tuning.unit

    @property
    def commands_run(self) -> tuple[str, ...]:
        """The ids of the commands that were run, in order."""
        return tuple(self._commands.run)

    def peek(self, path: str) -> Value:
        """Return the present value of a register or of `register.field`, in the unit of use (see `State.peek`)."""
        with self._lock:
            return self.state.peek(path)

    def poke(self, path: str, value: Plain) -> None:
        """Set a register or `register.field` to a value of use, read-only ones too (see `State.poke`)."""
        with self._lock:
            self.state.poke(path, value)

    def peek_words(self, path: str, view: str = "") -> tuple[int, ...]:
        """Return the words that a view of a register (default: the base view) transmits now."""
        with self._lock:
            return self.state.peek_words(path, view)

    @property
    def wear(self) -> Mapping[str, int]:
        """Writes to the lasting memory of each register, by path (only of registers that the map calls lasting)."""
        return dict(self._conduct.wear)

    @property
    def pending(self) -> tuple[str, ...]:
        """The registers that show a value which takes effect only with an `apply` command."""
        return tuple(self.state.pending)

    def snapshot(self) -> dict[str, Any]:
        """Return all that the device holds as plain values, ready for YAML or JSON; `restore` takes it back."""
        with self._lock:
            return state_files.snapshot(self.state, self.unit, self._conduct.wear)

    def restore(self, document: Mapping[str, Any], *, name: str = "the state") -> None:
        """Set the device to a snapshot, or to a backup of a real one; it answers as the same unit as before.

        Raises SimulatorError, which calls the document `name`, if it is of another model.
        """
        with self._lock:
            self._conduct.wear.update(state_files.restore(self.state, document, name))
            self._tuning.keep()

    def save(self, path: str | Path) -> None:
        """Write what the device holds to a YAML file. SimulatorError if that fails."""
        state_files.save(Path(path), self.snapshot())

    def load(self, path: str | Path) -> None:
        """Set the device to a file of `save`, or to a backup. SimulatorError if it is none, or of another model."""
        self.restore(state_files.load(Path(path)), name=str(path))

    def power_cycle(self) -> None:
        """Cut power and restore it: RAM takes the values of lasting memory, where the map says from which register."""
        with self._lock:
            self._conduct.power_cycle()
            self._tuning.follow(restarted=True)

    def advance(self, seconds: float) -> None:
        """Let simulated time pass: the process goes on, outputs and alarms follow. SimulatorError for less than 0.

        Time passes in steps of half a second; the rest of a step is kept for the next call.
        """
        if not 0 <= seconds < math.inf:
            message = f"time cannot advance by {seconds!r} seconds: give a number of 0 or more"
            raise SimulatorError(message)
        with self._lock:
            if self._conduct.controller is not None:
                self._conduct.controller.advance(seconds)

    def handle(self, pdu: bytes, *, broadcast: bool = False, unit: int | None = None) -> bytes | None:
        """Carry out a request (function code and data) and return the answer; None where the device keeps silent.

        A broadcast is acted on if the protocol says that its function may be broadcast, and never answered. `unit` is
        the id that was asked, where it is not its own.
        """
        if not pdu or pdu[0] & EXCEPTION_BIT or (broadcast and pdu[0] not in self._protocol.broadcast):
            return None
        with self._lock:
            self._asked = unit
            try:
                answer: bytes | None = self._act(pdu)
            except Refusal as refusal:
                answer = None if refusal.code == SILENCE else encode_reply(Reply(pdu[0], exception=refusal.code))
            lost = pdu[0] not in READS and self._tuning.follow()
        return None if broadcast or lost else answer

    def _act(self, pdu: bytes) -> bytes:
        act = self._functions.get(pdu[0]) if pdu[0] in self._protocol.functions else None
        if act is None:
            raise Refusal(self.register_map.faults.function)
        return act(pdu)

    def _request(self, pdu: bytes) -> Request:
        """The decoded request, its address counted from 0; one of a wrong length is refused for its quantity."""
        faults = self.register_map.faults
        try:
            request = self.understood(pdu).shifted(-self._tuning.first)
        except CoilStateError:
            raise Refusal(faults.value) from None
        except MalformedError:
            raise Refusal(faults.quantity) from None
        if request.address < 0 or request.into < 0:
            raise Refusal(faults.address)
        return request

    def understood(self, pdu: bytes) -> Request:
        """The decoded request: one that begins at a register of 32 bits has four bytes for each."""
        long = pdu[0] in enron.FUNCTIONS and int.from_bytes(pdu[1:3]) - self._tuning.first in self._long
        return enron.decode_request(pdu) if long else decode_request(pdu)

    def _check_edge(self, request: Request) -> None:
        """Refuse a request for registers of 16 and of 32 bits."""
        space = request.space
        if not self._long or (space is not Space.HOLDING and space is not Space.ENRON):
            return
        layout, plain = self.state.blueprint.layout, space.plain
        addresses = {plain(each) for each in range(request.address, request.address + request.quantity)}
        short = any(layout.place(Space.HOLDING, each) for each in addresses)
        if short if space is Space.ENRON else not self._long.isdisjoint(addresses):
            raise Refusal(self.register_map.faults.address)

    def _read(self, pdu: bytes) -> bytes:
        """Read with the request's function, or with one that the map calls alike and whose space has the address."""
        request = self._request(pdu)
        self._check_edge(request)
        if request.space is Space.ENRON:
            words = self._words.read(Space.ENRON, request.function, request.address, request.quantity)
            return encode_reply(Reply(request.function, words, request.address))
        alike = (codes for codes in self.register_map.alike if request.function in codes)
        candidates = (request.function, *(code for codes in alike for code in codes if code in READS))
        documents = self.state.blueprint.layout.documents
        function = next((code for code in candidates if documents(READS[code], request.address)), request.function)
        space = READS[function]
        words = self._words.read(space, function, self.on_page(space, request.address, self._asked), request.quantity)
        return encode_reply(Reply(request.function, words))

    def _write(self, pdu: bytes) -> bytes:
        request = self._request(pdu)
        self._check_edge(request)
        space = request.space or Space.HOLDING
        done = self._words.write(
            space, request.function, self.on_page(space, request.address, self._asked), request.words
        )
        return encode_reply(Reply(request.function, request.words, request.shifted(self._tuning.first).address, done))

    @property
    def units(self) -> tuple[int, ...]:
        """All unit ids to which it answers now: its own, and those of groups behind it."""
        return (self.unit, *(page.unit for page in self.model.pages if page.unit))

    def on_page(self, space: Space, address: int, unit: int | None = None) -> int:
        """The address on the page that is selected now, if that has something there; of a `unit` behind it, there."""
        layout = self.state.blueprint.layout
        if behind := [
            number for number, page in enumerate(self.model.pages, start=1) if page.unit and page.unit == unit
        ]:
            return behind[0] << PAGE_BITS | address
        for number, page in enumerate(self.model.pages, start=1):
            paged = number << PAGE_BITS | address
            here = layout.place(space, paged) or layout.place(space, paged, writing=True)
            if (
                here
                and page.steps
                and all(self.state.shows(*one) for one in zip(page.steps, page.selectors, strict=True))
            ):
                return paged
        return address

    def _mask_word(self, pdu: bytes) -> bytes:
        request = self._request(pdu)
        keep, put = request.words
        address = self.on_page(Space.HOLDING, request.address, self._asked)
        (word,) = self._words.read(Space.HOLDING, request.function, address, 1)
        masked = ((word & keep) | (put & ~keep & 0xFFFF),)
        self._words.write(Space.HOLDING, request.function, address, masked)
        return pdu

    def _write_and_read(self, pdu: bytes) -> bytes:
        """Function 23: a read behind a write, so of the page that the write selects."""
        request = self._request(pdu)
        function, space = request.function, Space.HOLDING
        self._words.write(space, function, self.on_page(space, request.into, self._asked), request.words)
        words = self._words.read(space, function, self.on_page(space, request.address, self._asked), request.quantity)
        return encode_reply(Reply(function, words))

    def _status(self, pdu: bytes) -> bytes:
        request = self._request(pdu)
        (status,) = self.state.words(Space.STATUS, 0, 1)
        if status is None:
            raise Refusal(self.register_map.faults.function)
        return encode_reply(Reply(request.function, (status,)))

    def _read_records(self, pdu: bytes) -> bytes:
        groups = self._groups(pdu)
        return parts.join_records(
            [self._words.read(Space.FILE, one.function, one.address, one.quantity) for one in groups]
        )

    def _write_records(self, pdu: bytes) -> bytes:
        for one in self._groups(pdu):
            self._words.write(Space.FILE, one.function, one.address, one.words)
        return pdu

    def _groups(self, pdu: bytes) -> list[Request]:
        try:
            return parts.decode_groups(pdu)
        except MalformedError:
            raise Refusal(self.register_map.faults.quantity) from None

    def _read_queue(self, pdu: bytes) -> bytes:
        """The count that the queue has, and so many of its values."""
        request = self._request(pdu)
        count, *values = self.state.words(Space.QUEUE, request.address, Space.QUEUE.most)
        if count is None:
            raise Refusal(self.register_map.faults.address)
        if count >= Space.QUEUE.most:
            raise Refusal(self.register_map.faults.value)
        words = (count, *(value or 0 for value in values[:count]))
        return encode_reply(Reply(request.function, words))

    def _identify(self, pdu: bytes) -> bytes:
        """One object, or a stream of those of a category."""
        try:
            category, first = identification.category_of(pdu)
        except MalformedError:
            raise Refusal(self.register_map.faults.value) from None
        objects = self._objects()
        if category == identification.INDIVIDUAL and first not in objects:
            raise Refusal(self.register_map.faults.address)
        return identification.encode_objects(category, first, objects)

    def _objects(self) -> dict[int, bytes]:
        """The objects of the identification by number."""
        space, found = Space.IDENTIFICATION, {}
        for register in self.model.registers:
            if register.base.space is space:
                words = self.state.words(space, register.address, register.base.words)
                found[register.address >> space.part_bits] = identification.text_of([word or 0 for word in words])
        return found

    def _loopback(self, pdu: bytes) -> bytes:
        """The request itself, however much data it has."""
        if pdu[1:3] != b"\0\0":
            raise Refusal(self.register_map.faults.function)
        return pdu


def _model(register_map: RegisterMap, name: str) -> Model:
    if not register_map.has(name):
        known = ", ".join(model.name for model in register_map.models)
        message = f"map {register_map.id} has no model {name!r}: it has {known}"
        raise SimulatorError(message)
    return register_map.model(name)


def _unit(register_map: RegisterMap, unit: int | None) -> int:
    low, high = register_map.protocol.unit_ids
    if unit is None:
        return low if register_map.default_unit is None else register_map.default_unit
    if not low <= unit <= high:
        message = f"unit {unit} is outside {low}..{high}, the unit ids of this device (elsewhere 0 is the broadcast)"
        raise SimulatorError(message)
    return unit
