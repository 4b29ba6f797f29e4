"""What frames say in the names of a map: requests and their answers, registers with values, exceptions, commands."""

import struct
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from regscribe.tools.live.capture import RECEIVED, SENT
from regscribe.tools.live.captured_frames import EXCEPTION, CapturedFrame
from regscribe.tools.live.names import Driver, commands_of
from regscribe.tools.live.reading import unit_of
from regscribe.tools.live.value_text import Plain, as_text, show
from regscribe_runtime import Register, RegscribeError, View
from regscribe_runtime.errors import STANDARD
from regscribe_runtime.registers import codec
from regscribe_runtime.wire.requests import (
    LOOPBACK,
    READ_SPACES,
    READ_STATUS,
    WRITE_COIL,
    WRITE_COILS,
    WRITE_REGISTER,
    WRITE_REGISTERS,
)

SPACES = READ_SPACES | {
    WRITE_COIL: "coil",
    WRITE_COILS: "coil",
    WRITE_REGISTER: "holding",
    WRITE_REGISTERS: "holding",
}
WRITES = frozenset({WRITE_COIL, WRITE_REGISTER, WRITE_COILS, WRITE_REGISTERS})
BITS = frozenset({"coil", "discrete"})
ON = 0xFF00
HEAD = 4
"""Bytes of an address with a quantity or a value."""


class DecodedItem(NamedTuple):
    """A register in a frame: its words there and its value with unit, or the problem; without words it is asked for."""

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
        told = f"{self.text} {self.unit}".rstrip() if not self.problem else f"({self.problem})"
        return f"{self.name} = {told}" if self.text or self.problem else self.name


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


class DecodedRequest(NamedTuple):
    """A request that waits for its answer."""

    unit: int
    function: int
    address: int
    quantity: int
    words: tuple[int, ...]


class Decoder:
    """Decodes the frames of one line in their order; what it saw of a unit decides scales and units there later on.

    `state` are values of use known beforehand, by register path, for all units; `first` is 1 for JBUS addresses.
    """

    def __init__(
        self,
        driver: Driver,
        *,
        givens: Mapping[str, Any] | None = None,
        state: Mapping[str, Any] | None = None,
        first: int = 0,
    ) -> None:
        self.driver, self.first = driver, first
        self._givens, self._known = dict(givens or {}), dict(state or {})
        self._states: dict[int, dict[str, Any]] = {}
        self._asked: DecodedRequest | None = None
        self._index = _index(driver)

    def feed(self, frame: CapturedFrame, direction: str = "") -> Decoded:
        """Decode the next frame; `direction` is sent, received, or "" where only the frames themselves tell."""
        if not frame.pdu:
            return self._strange("request", frame, "no function code")
        asked = self._asked
        if direction != SENT and asked and self._answers(frame, asked, sure=direction == RECEIVED):
            self._asked = None
            return self._answer(frame, asked)
        if direction == RECEIVED or (direction != SENT and _is_answer(frame)):
            return self._unasked(frame)
        self._asked = _asked(frame, self.first)
        return self._request(frame, self._asked)

    def _answers(self, frame: CapturedFrame, asked: DecodedRequest, *, sure: bool) -> bool:
        if (frame.unit, frame.function) != (asked.unit, asked.function):
            return False
        return sure or bool(frame.pdu[0] & EXCEPTION) or len(frame.pdu) == _answer_size(asked)

    def _request(self, frame: CapturedFrame, asked: DecodedRequest | None) -> Decoded:
        if asked is None:
            return self._strange("request", frame, "of a form that is not known")
        items = tuple(self._items(asked, asked.words if asked.function in WRITES else None))
        return Decoded(
            "request", frame.unit, frame.function, self._verb(asked), asked.address, items, 0, frame.complaint
        )

    def _answer(self, frame: CapturedFrame, asked: DecodedRequest) -> Decoded:
        if frame.pdu[0] & EXCEPTION:
            return self._exception(frame, asked)
        words = _words(frame.pdu, asked)
        if asked.function in WRITES:
            self._learn(asked, asked.words)
            return Decoded("response", frame.unit, asked.function, "written", asked.address, (), 0, frame.complaint)
        if len(words) != asked.quantity:
            return self._strange("response", frame, f"{len(words)} values where {asked.quantity} were asked for")
        self._learn(asked, words)
        items = tuple(self._items(asked, words))
        return Decoded("response", frame.unit, asked.function, "", asked.address, items, 0, frame.complaint)

    def _unasked(self, frame: CapturedFrame) -> Decoded:
        if frame.pdu[0] & EXCEPTION:
            return self._exception(frame, None)
        return self._strange("response", frame, "to a request that is not in the capture")

    def _exception(self, frame: CapturedFrame, asked: DecodedRequest | None) -> Decoded:
        code = frame.pdu[1] if len(frame.pdu) > 1 else 0
        _, name, meaning = self.driver.protocol.exception(code)
        said = f"exception {code:02d} ({name or STANDARD.get(code, 'unknown')}{f': {meaning}' if meaning else ''})"
        address = asked.address if asked else None
        items = tuple(self._items(asked, None)) if asked else ()
        return Decoded("response", frame.unit, frame.function, said, address, items, code, frame.complaint)

    def _strange(self, kind: str, frame: CapturedFrame, said: str) -> Decoded:
        function = frame.function if frame.pdu else 0
        return Decoded(kind, frame.unit, function, f"function {function:02d}, {said}", None, (), 0, frame.complaint)

    def _verb(self, asked: DecodedRequest) -> str:
        if asked.function == LOOPBACK:
            return "loopback"
        if asked.function == READ_STATUS:
            return "read the exception status"
        space, end = SPACES[asked.function], asked.address + asked.quantity - 1
        where = f"{space} {asked.address}" + (f" to {end}" if end > asked.address else "")
        acts = [name for name, command in commands_of(self.driver).items() if _step(asked) in command.steps]
        told = f" (command {' or '.join(acts)})" if acts else ""
        return f"{'write' if asked.function in WRITES else 'read'} {where}{told}"

    def _state(self, unit: int) -> dict[str, Any]:
        return self._states.setdefault(unit, dict(self._known))

    def _learn(self, asked: DecodedRequest, words: tuple[int, ...]) -> None:
        """Keep what registers hold now; those first whose values others need."""
        state = self._state(asked.unit)
        for register, view, part in list(self._found(asked, words)) * 2:
            try:
                state[register.path] = codec.decode(register, view, part, state, self._givens, named=False)
            except (RegscribeError, KeyError, ValueError):
                state.pop(register.path, None)

    def _items(self, asked: DecodedRequest, words: tuple[int, ...] | None) -> Iterator[DecodedItem]:
        for register, view, part in self._found(asked, words):
            yield (
                self._item(asked.unit, register, view, part)
                if words is not None
                else DecodedItem(register.path, view.name)
            )

    def _item(self, unit: int, register: Register[Any], view: View, words: tuple[int, ...]) -> DecodedItem:
        state = self._state(unit)
        item = DecodedItem(register.path, view.name, words)
        if len(words) < view.words:
            return item._replace(problem=f"{len(words)} of {view.words} words: {_hexadecimal(words)}")
        try:
            value = register.decode(words, view=view.name, state=state, givens=self._givens)
        except KeyError as missing:
            return item._replace(problem=f"{_hexadecimal(words)}; {missing.args[0]} decides what it means")
        except RegscribeError as error:
            return item._replace(problem=f"{_hexadecimal(words)}; {str(error).removeprefix(f'{register.path}: ')}")
        unit_name = unit_of(register, {**state, register.path: value}, self._givens)
        return item._replace(value=show(register, value), text=as_text(register, value), unit=unit_name)

    def _found(
        self, asked: DecodedRequest, words: tuple[int, ...] | None
    ) -> Iterator[tuple[Register[Any], View, tuple[int, ...]]]:
        space = SPACES.get(asked.function, "")
        for address in range(asked.address, asked.address + asked.quantity):
            for register, view in self._index.get((space, address), ()):
                at = address - asked.address
                yield register, view, (words or ())[at : at + view.words]


def _index(driver: Driver) -> dict[tuple[str, int], list[tuple[Register[Any], View]]]:
    """Which registers begin at an address, in which view."""
    found: dict[tuple[str, int], list[tuple[Register[Any], View]]] = {}
    for register in driver.registers.values():
        for view in register.views:
            for at in (register.at, *register.aliases):
                found.setdefault((view.space, view.address(at)), []).append((register, view))
    return found


def _is_answer(frame: CapturedFrame) -> bool:
    """Whether a frame can be nothing but an answer, by its form."""
    function, data = frame.pdu[0], frame.pdu[1:]
    if function & EXCEPTION or function == READ_STATUS:
        return bool(data)
    if function in {WRITE_COILS, WRITE_REGISTERS}:
        return len(data) == HEAD
    counted = bool(data) and data[0] == len(data) - 1
    return function in SPACES and function not in WRITES and len(data) != HEAD and counted


def _asked(frame: CapturedFrame, first: int) -> DecodedRequest | None:
    """The request of a frame; None for one of another form."""
    function, data = frame.pdu[0], frame.pdu[1:]
    if function == READ_STATUS:
        return DecodedRequest(frame.unit, function, 0, 1, ())
    short, exact = len(data) < HEAD, len(data) == HEAD or function in {WRITE_COILS, WRITE_REGISTERS, LOOPBACK}
    if short or not exact or function not in {*SPACES, LOOPBACK}:
        return None
    address, number = struct.unpack(">HH", data[:4])
    if function == LOOPBACK:
        return DecodedRequest(frame.unit, function, address, 1, (number,))
    address = max(address - first, 0)
    if function in {WRITE_COIL, WRITE_REGISTER}:
        return DecodedRequest(
            frame.unit, function, address, 1, (int(number == ON) if function == WRITE_COIL else number,)
        )
    words = _unpacked(data[5:], number, bits=function == WRITE_COILS) if function in WRITES else ()
    return (
        None
        if function in WRITES and len(words) != number
        else DecodedRequest(frame.unit, function, address, number, words)
    )


def _unpacked(data: bytes, count: int, *, bits: bool) -> tuple[int, ...]:
    if not bits:
        return struct.unpack(f">{len(data) // 2}H", data[: len(data) // 2 * 2])
    packed = int.from_bytes(data, "little")
    return tuple(packed >> at & 1 for at in range(min(count, 8 * len(data))))


def _words(pdu: bytes, asked: DecodedRequest) -> tuple[int, ...]:
    if asked.function in {LOOPBACK, *WRITES}:
        return asked.words
    if asked.function == READ_STATUS:
        return tuple(pdu[1:2])
    return _unpacked(pdu[2:], asked.quantity, bits=SPACES[asked.function] in BITS)


def _answer_size(asked: DecodedRequest) -> int:
    """How many bytes the answer has behind the unit, before the CRC."""
    if asked.function == READ_STATUS:
        return 2
    if asked.function in {LOOPBACK, *WRITES}:
        return 5
    return 2 + (-(-asked.quantity // 8) if SPACES[asked.function] in BITS else 2 * asked.quantity)


def _step(asked: DecodedRequest) -> tuple[int, int, tuple[int, ...]]:
    return asked.function, asked.address, asked.words


def _hexadecimal(words: tuple[int, ...]) -> str:
    return " ".join(f"{word:04X}" for word in words)
