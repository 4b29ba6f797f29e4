"""Decodes frames into the names of a map: requests and answers, registers with values, exceptions, commands."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from typing import Any, NamedTuple

from regscribe.emit.words import span_words
from regscribe.tools.live.capture import RECEIVED, SENT
from regscribe.tools.live.givens import defaults
from regscribe.tools.live.names import Driver, commands_of
from regscribe.tools.live.places import RegisterPlaces
from regscribe.tools.live.reading import reason, unit_of
from regscribe.tools.live.value_text import Plain, as_text, show
from regscribe_runtime import Register, RegscribeError, View
from regscribe_runtime.errors import STANDARD
from regscribe_runtime.registers import codec
from regscribe_runtime.values.blocks import stated_bases
from regscribe_runtime.values.facts import CommandStep
from regscribe_runtime.values.wire_types import WRITE_AND_READ, Space
from regscribe_runtime.wire import enron
from regscribe_runtime.wire.capture import CapturedFrame
from regscribe_runtime.wire.packing import MalformedError
from regscribe_runtime.wire.pdu import EXCEPTION_BIT, decode_reply, decode_request
from regscribe_runtime.wire.requests import (
    BIT_READS,
    BLOCK_WRITES,
    HEAD_SIZE,
    LOOPBACK,
    MASK_REGISTER,
    READ_HOLDING,
    READ_STATUS,
    SPACES,
    WORD_READS,
    WRITE_REGISTERS,
    WRITES,
    Request,
    sizes,
)


class DecodedItem(NamedTuple):
    """A register in a frame: its words and its value with unit, or the problem; no words in a request to read it."""

    name: str
    view: str
    words: tuple[int, ...] = ()
    value: Plain | None = None
    text: str = ""
    unit: str = ""
    problem: str = ""

    @property
    def spelled(self) -> str:
        """For people: `setpoint = 150.5 °F`."""
        value = f"{self.text} {self.unit}".rstrip() if not self.problem else f"({self.problem})"
        return f"{self.name} = {value}" if self.text or self.problem else self.name


class Decoded(NamedTuple):
    """A frame in names: `kind` is request or response, `what` is for people, `exception` a code (0: none)."""

    kind: str
    unit: int
    function: int
    what: str
    address: int | None
    items: tuple[DecodedItem, ...]
    exception: int
    complaint: str


class Decoder:
    """Decodes the frames of one line in their order; values seen before decide the scales and units of later ones.

    `state` are values of use known beforehand, by register path, for all units; `first` is 1 for JBUS addresses.
    `bases` are known bases of blocks; those in chains are learned from the headers that a driver reads.
    """

    def __init__(
        self,
        driver: Driver,
        *,
        givens: Mapping[str, Any] | None = None,
        state: Mapping[str, Any] | None = None,
        first: int = 0,
        bases: Mapping[str, int] | None = None,
    ) -> None:
        self.driver, self.first = driver, first
        self._givens, self._initial = {**defaults(driver), **(givens or {})}, dict(state or {})
        self._states: defaultdict[int, dict[str, Any]] = defaultdict(self._initial.copy)
        self._behind = {page.unit for page in driver._pages if page.unit}  # noqa: SLF001 (its facts)
        self._pending: dict[int, Request] = {}
        """The request that waits for its answer, by its unit."""
        known = stated_bases(driver._blocks, self._givens) | dict(bases or {})  # noqa: SLF001 (its facts)
        self._places: defaultdict[int, RegisterPlaces] = defaultdict(lambda: RegisterPlaces(driver, known))

    def feed(self, frame: CapturedFrame, direction: str = "") -> Decoded:
        """Decode the next frame; `direction` is sent, received, or "" where only the frames themselves tell."""
        if not frame.pdu:
            return self._strange("request", frame, "no function code")
        if direction != SENT:
            request = self._pending.get(frame.unit)
            if request and _answers(frame, request, sure=direction == RECEIVED):
                self._pending = {}
                return self._answer(frame, request)
            if direction == RECEIVED or _is_answer(frame):
                return self._answer(frame, None)
        request = self._request(frame)
        if request is None:
            self._pending = {}
            return self._strange("request", frame, "of a form that is not known")
        self._pending = {frame.unit: request}
        items = self._items(frame.unit, request, request.words if request.function in WRITES else None)
        return _decoded("request", frame, self._action(frame.unit, request), request, items)

    def _request(self, frame: CapturedFrame) -> Request | None:
        """The request of a frame; None for a frame of another form."""
        try:
            request = self._decoded(frame).shifted(-self.first)
        except MalformedError:
            return None
        known = request.function in {*SPACES, LOOPBACK, MASK_REGISTER, WRITE_AND_READ}
        return request._replace(address=max(request.address, 0)) if known else None

    def _decoded(self, frame: CapturedFrame) -> Request:
        """The request of a frame: one that begins at a register of 32 bits has four bytes for each."""
        start = Space.ENRON.within(int.from_bytes(frame.pdu[1:3]) - self.first)
        long = frame.function in enron.FUNCTIONS and self._places[frame.unit].at(Space.ENRON, start, frame.unit)
        return enron.decode_request(frame.pdu) if long else decode_request(frame.pdu)

    def _answer(self, frame: CapturedFrame, request: Request | None) -> Decoded:
        if frame.pdu[0] & EXCEPTION_BIT:
            code = frame.pdu[1] if len(frame.pdu) > 1 else 0
            _, name, meaning = self.driver.protocol.exception(code)
            name = name or STANDARD.get(code, "unknown")
            what = f"exception {code:02d} ({name}{f': {meaning}' if meaning else ''})"
            items = self._items(frame.unit, request, None) if request else ()
            return _decoded("response", frame, what, request, items, code)
        if request is None:
            return self._strange("response", frame, "to a request that is not in the capture")
        if request.function in WRITES or request.function == MASK_REGISTER:
            self._learn(frame.unit, request, request.words if request.function in WRITES else ())
            if request.function in WRITES:
                self._places[frame.unit].wrote(request.space or "", request.address, request.words)
            return _decoded("response", frame, "written", request)
        words = decode_reply(request, frame.pdu).words
        if request.function == WRITE_AND_READ:
            self._places[frame.unit].wrote(SPACES[WRITE_REGISTERS], request.into, request.words)
            request = request._replace(function=READ_HOLDING)
        if len(words) != request.quantity:
            return self._strange("response", frame, f"{len(words)} values where {request.quantity} were asked for")
        self._learn(frame.unit, request, words)
        return _decoded("response", frame, "", request, self._items(frame.unit, request, words))

    def _strange(self, kind: str, frame: CapturedFrame, what: str) -> Decoded:
        return _decoded(kind, frame, f"function {frame.function if frame.pdu else 0:02d}, {what}")

    def _action(self, unit: int, request: Request) -> str:
        """What a request does, for people."""
        if request.function == LOOPBACK:
            return "loopback"
        if request.function == READ_STATUS:
            return "read the exception status"
        if request.function == MASK_REGISTER:
            keep, put = request.words
            return f"write bits {~keep & 0xFFFF:04X} of holding {request.address} as {put & ~keep & 0xFFFF:04X}"
        if request.function == WRITE_AND_READ:
            written = " ".join(f"{word:04X}" for word in request.words)
            reads = self._action(unit, request._replace(function=READ_HOLDING))
            return f"write {written} to holding {request.into} and {reads}"
        space = request.space or Space.HOLDING
        ends = span_words(*map(space.spelled, (request.address, request.address + request.quantity - 1)))
        where = f"{space} {ends}"
        placed = self._places[unit].placed
        every = ((name, placed(step)) for name, one in commands_of(self.driver).items() for step in one.steps)
        commands = dict.fromkeys(name for name, step in every if _is_step(request, step))
        named = f" (command {' or '.join(commands)})" if commands else ""
        return f"{'write' if request.function in WRITES else 'read'} {where}{named}"

    def _state(self, unit: int) -> dict[str, Any]:
        """The values of the device that has a unit id; with units behind it, the line has no other of its kind."""
        return self._states[0 if self._behind else unit]

    def _learn(self, unit: int, request: Request, words: tuple[int, ...]) -> None:
        """Keep the values of registers; decoded twice, since the values of some decide those of others."""
        state = self._state(unit)
        self._places[unit].saw(request.space or "", request.address, words)
        for register, view, part in list(self._registers(unit, request, words)) * 2:
            try:
                register.check_present(state, self._givens)
                state[register.path] = codec.decode(register, view, part, state, self._givens, named=False)
            except (RegscribeError, KeyError, ValueError):
                state.pop(register.path, None)
        self._places[unit].counted(state)

    def _items(self, unit: int, request: Request, words: tuple[int, ...] | None) -> Iterator[DecodedItem]:
        placed = list(self._registers(unit, request, words))
        here = {view.address(register.at) for register, view, _ in placed if self._exists(unit, register)}
        for register, view, part in placed:
            item = DecodedItem(register.path, view.name)
            if words is None:
                yield item
            elif self._exists(unit, register) or view.address(register.at) not in here:
                yield self._decode(item, unit, register, view, part)

    def _exists(self, unit: int, register: Register[Any]) -> bool:
        """Whether a register is known to exist, so that no other one at its address does."""
        with suppress(KeyError, RegscribeError):
            register.check_present(self._state(unit), self._givens)
            return True
        return False

    def _decode(
        self, item: DecodedItem, unit: int, register: Register[Any], view: View, words: tuple[int, ...]
    ) -> DecodedItem:
        state, item = self._state(unit), item._replace(words=words)
        digits = " ".join(f"{word:04X}" for word in words)
        if len(words) < view.words:
            return item._replace(problem=f"{len(words)} of {view.words} words: {digits}")
        try:
            value = register.decode(words, view=view.name, state=state, givens=self._givens)
        except KeyError as missing:
            return item._replace(problem=f"{digits}; {missing.args[0]} decides what it means")
        except RegscribeError as error:
            return item._replace(problem=f"{digits}; {reason(error, register.path)}")
        unit_name = unit_of(register, {**state, register.path: value}, self._givens)
        return item._replace(value=show(register, value), text=as_text(register, value), unit=unit_name)

    def _registers(
        self, unit: int, request: Request, words: tuple[int, ...] | None
    ) -> Iterator[tuple[Register[Any], View, tuple[int, ...]]]:
        """The registers that begin within a request, each with its part of the words.

        Where one is read and another one written, those that the request means.
        """
        space = request.space or ""
        for offset in range(request.quantity):
            here = self._places[unit].at(space, request.address + offset, unit)
            meant = [one for one in here if _serves(*one, reading=request.fetches)]
            for register, view in meant or here:
                yield register, view, (words or ())[offset : offset + view.words]


def _is_step(request: Request, step: CommandStep) -> bool:
    sent = request.words if not step.argument else (0,) * len(request.words)
    return (request.function, request.address, sent) == (step.function, step.address, step.words)


def _serves(register: Register[Any], view: View, *, reading: bool) -> bool:
    if reading:
        return register.access.readable and view.readable
    return register.access.writable and view.writable


def _decoded(
    kind: str,
    frame: CapturedFrame,
    what: str,
    request: Request | None = None,
    items: Iterable[DecodedItem] = (),
    exception: int = 0,
) -> Decoded:
    function = frame.function if frame.pdu else 0
    address = request.address if request else None
    return Decoded(kind, frame.unit, function, what, address, tuple(items), exception, frame.complaint)


def _is_answer(frame: CapturedFrame) -> bool:
    """Whether a frame can be nothing but an answer, by its form."""
    function, data = frame.pdu[0], frame.pdu[1:]
    if function & EXCEPTION_BIT or function == READ_STATUS:
        return bool(data)
    if function in BLOCK_WRITES:
        return len(data) == HEAD_SIZE
    counted = bool(data) and data[0] == len(data) - 1
    return function in (*BIT_READS, *WORD_READS) and len(data) != HEAD_SIZE and counted


def _answers(frame: CapturedFrame, request: Request, *, sure: bool) -> bool:
    """Whether a frame of the same unit is the answer to a request; `sure` if it is known to be an answer."""
    if frame.function != request.function:
        return False
    return sure or bool(frame.pdu[0] & EXCEPTION_BIT) or len(frame.pdu) == sizes(request)[1]
