"""What frames say in the names of a map: requests and their answers, registers with values, exceptions, commands."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from regscribe.tools.live.capture import RECEIVED, SENT
from regscribe.tools.live.names import Driver, commands_of
from regscribe.tools.live.reading import unit_of
from regscribe.tools.live.value_text import Plain, as_text, show
from regscribe_runtime import Register, RegscribeError, View
from regscribe_runtime.errors import STANDARD
from regscribe_runtime.registers import codec
from regscribe_runtime.values.facts import CommandStep
from regscribe_runtime.wire.capture import CapturedFrame
from regscribe_runtime.wire.pdu import EXCEPTION_BIT, MalformedError, decode_reply, decode_request
from regscribe_runtime.wire.requests import (
    BIT_READS,
    BLOCK_WRITES,
    HEAD_SIZE,
    LOOPBACK,
    READ_STATUS,
    SPACES,
    WORD_READS,
    WRITES,
    Request,
    sizes,
)


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
        self._asked: tuple[int, Request] | None = None
        """A request that waits for its answer, with its unit."""
        self._index = _index(driver)

    def feed(self, frame: CapturedFrame, direction: str = "") -> Decoded:
        """Decode the next frame; `direction` is sent, received, or "" where only the frames themselves tell."""
        if not frame.pdu:
            return self._strange("request", frame, "no function code")
        if direction != SENT and (answer := self._as_answer(frame, sure=direction == RECEIVED)):
            return answer
        asked = _asked(frame, self.first)
        self._asked = (frame.unit, asked) if asked else None
        return self._request(frame, asked)

    def _as_answer(self, frame: CapturedFrame, *, sure: bool) -> Decoded | None:
        """What a frame says if it is an answer; `sure` if it can be nothing else."""
        unit, asked = self._asked or (frame.unit, None)
        if asked and unit == frame.unit and _answers(frame, asked, sure=sure):
            self._asked = None
            return self._answer(frame, asked)
        return self._unasked(frame) if sure or _is_answer(frame) else None

    def _request(self, frame: CapturedFrame, asked: Request | None) -> Decoded:
        if asked is None:
            return self._strange("request", frame, "of a form that is not known")
        items = tuple(self._items(frame.unit, asked, asked.words if asked.function in WRITES else None))
        return Decoded(
            "request", frame.unit, frame.function, self._verb(asked), asked.address, items, 0, frame.complaint
        )

    def _answer(self, frame: CapturedFrame, asked: Request) -> Decoded:
        if frame.pdu[0] & EXCEPTION_BIT:
            return self._exception(frame, asked)
        if asked.function in WRITES:
            self._learn(frame.unit, asked, asked.words)
            return Decoded("response", frame.unit, asked.function, "written", asked.address, (), 0, frame.complaint)
        words = decode_reply(asked, frame.pdu).words
        if len(words) != asked.quantity:
            return self._strange("response", frame, f"{len(words)} values where {asked.quantity} were asked for")
        self._learn(frame.unit, asked, words)
        items = tuple(self._items(frame.unit, asked, words))
        return Decoded("response", frame.unit, asked.function, "", asked.address, items, 0, frame.complaint)

    def _unasked(self, frame: CapturedFrame) -> Decoded:
        if frame.pdu[0] & EXCEPTION_BIT:
            return self._exception(frame, None)
        return self._strange("response", frame, "to a request that is not in the capture")

    def _exception(self, frame: CapturedFrame, asked: Request | None) -> Decoded:
        code = frame.pdu[1] if len(frame.pdu) > 1 else 0
        _, name, meaning = self.driver.protocol.exception(code)
        said = f"exception {code:02d} ({name or STANDARD.get(code, 'unknown')}{f': {meaning}' if meaning else ''})"
        address = asked.address if asked else None
        items = tuple(self._items(frame.unit, asked, None)) if asked else ()
        return Decoded("response", frame.unit, frame.function, said, address, items, code, frame.complaint)

    def _strange(self, kind: str, frame: CapturedFrame, said: str) -> Decoded:
        function = frame.function if frame.pdu else 0
        return Decoded(kind, frame.unit, function, f"function {function:02d}, {said}", None, (), 0, frame.complaint)

    def _verb(self, asked: Request) -> str:
        if asked.function == LOOPBACK:
            return "loopback"
        if asked.function == READ_STATUS:
            return "read the exception status"
        space, end = SPACES[asked.function], asked.address + asked.quantity - 1
        where = f"{space} {asked.address}" + (f" to {end}" if end > asked.address else "")
        step = CommandStep(asked.function, asked.address, asked.words)
        acts = [name for name, command in commands_of(self.driver).items() if step in command.steps]
        told = f" (command {' or '.join(acts)})" if acts else ""
        return f"{'write' if asked.function in WRITES else 'read'} {where}{told}"

    def _state(self, unit: int) -> dict[str, Any]:
        return self._states.setdefault(unit, dict(self._known))

    def _learn(self, unit: int, asked: Request, words: tuple[int, ...]) -> None:
        """Keep what registers hold now; those first whose values others need."""
        state = self._state(unit)
        for register, view, part in list(self._found(asked, words)) * 2:
            try:
                state[register.path] = codec.decode(register, view, part, state, self._givens, named=False)
            except (RegscribeError, KeyError, ValueError):
                state.pop(register.path, None)

    def _items(self, unit: int, asked: Request, words: tuple[int, ...] | None) -> Iterator[DecodedItem]:
        for register, view, part in self._found(asked, words):
            yield (
                self._item(unit, register, view, part) if words is not None else DecodedItem(register.path, view.name)
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
        self, asked: Request, words: tuple[int, ...] | None
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
    if function & EXCEPTION_BIT or function == READ_STATUS:
        return bool(data)
    if function in BLOCK_WRITES:
        return len(data) == HEAD_SIZE
    counted = bool(data) and data[0] == len(data) - 1
    return function in (*BIT_READS, *WORD_READS) and len(data) != HEAD_SIZE and counted


def _answers(frame: CapturedFrame, asked: Request, *, sure: bool) -> bool:
    """Whether a frame of the same unit is the answer to a request; `sure` if it is known to be an answer."""
    if frame.function != asked.function:
        return False
    return sure or bool(frame.pdu[0] & EXCEPTION_BIT) or len(frame.pdu) == sizes(asked)[1]


def _asked(frame: CapturedFrame, first: int) -> Request | None:
    """The request of a frame; None for one of another form."""
    try:
        request = decode_request(frame.pdu).shifted(-first)
    except MalformedError:
        return None
    known = request.function in {*SPACES, LOOPBACK}
    return request._replace(address=max(request.address, 0)) if known else None


def _hexadecimal(words: tuple[int, ...]) -> str:
    return " ".join(f"{word:04X}" for word in words)
