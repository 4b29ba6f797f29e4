"""Worked examples that are frames of Modbus RTU: the check, the fields and the values that they carry."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import NamedTuple

from regscribe.checks.rule import RuleScope
from regscribe.checks.worked_values import compare, example_rule, hexadecimal, in_example, judged
from regscribe.model import FrameExample, Register, Space, View
from regscribe.reference import Surroundings
from regscribe_runtime.wire import enron
from regscribe_runtime.wire.packing import MalformedError, expect_bytes, unpack_words
from regscribe_runtime.wire.pdu import EXCEPTION_BIT, OFF, ON, decode_request
from regscribe_runtime.wire.requests import (
    BIT_READS,
    BLOCK_WRITES,
    BYTES_IN_WORD,
    READ_HOLDING,
    SPACES,
    WORD_READS,
    WRITE_COIL,
    WRITES,
)

CRC_LENGTH = 2
SHORTEST = 2
COMPARED = frozenset({*BIT_READS, *WORD_READS, *WRITES})
"""Functions whose fields are compared (application protocol V1.1b3, 6); of others unit and function only."""


@dataclass(frozen=True, slots=True)
class FrameFields:
    """What a frame says; None where it has no such field (`address` of the answer to a read).

    `carried` is what registers or coils hold after it, `words` how it is printed: function 05 sends FF00 or 0000.
    """

    unit: int
    function: int
    address: int | None = None
    count: int | None = None
    words: tuple[int, ...] | None = None
    carried: tuple[int, ...] = ()
    exception: int = 0


def parse(data: bytes, *, answer: bool, long: bool = False) -> FrameFields:
    """Read a frame without its CRC, of registers of 32 bits if `long`; MalformedError if its length does not fit it."""
    if len(data) < SHORTEST:
        message = f"{len(data)} bytes are no frame"
        raise MalformedError(message)
    unit, function, pdu = data[0], data[1], data[1:]
    head = FrameFields(unit, function & ~EXCEPTION_BIT if answer else function)
    if answer and function & EXCEPTION_BIT:
        expect_bytes(pdu[1:], 1)
        return replace(head, exception=pdu[1])
    return _answer(head, pdu, long) if answer else _request(head, pdu, long)


def _answer(head: FrameFields, pdu: bytes, long: bool) -> FrameFields:  # noqa: FBT001 (as of the frame)
    if head.function in WORD_READS:
        size = pdu[1] if len(pdu) > 1 else 0
        expect_bytes(pdu[1:], 1 + size)
        if size % BYTES_IN_WORD:
            message = f"{size} bytes are no whole number of words"
            raise MalformedError(message)
        words = unpack_words(pdu[2:])
        return replace(head, count=len(words) // (1 + long), words=words, carried=words)
    if head.function in BLOCK_WRITES:  # address and count, as a read asks for them
        request = decode_request(bytes([READ_HOLDING]) + pdu[1:])
        return replace(head, address=request.address, count=request.quantity)
    return _request(head, pdu, long) if head.function in WRITES else head


def _request(head: FrameFields, pdu: bytes, long: bool) -> FrameFields:  # noqa: FBT001 (as above)
    if head.function not in COMPARED:
        return head
    request = enron.decode_request(pdu) if long else decode_request(pdu)
    space = request.space or Space.HOLDING
    head = replace(head, address=space.plain(request.address), count=request.quantity // space.each)
    if request.reads:
        return head
    if not request.quantity:
        message = "it writes nothing"
        raise MalformedError(message)
    words = tuple(ON if bit else OFF for bit in request.words) if head.function == WRITE_COIL else request.words
    return replace(head, words=words, carried=request.words)


def _parsed(example: FrameExample, long: bool) -> FrameFields:  # noqa: FBT001 (as above)
    body = example.frame[:-CRC_LENGTH] if example.crc else example.frame
    return parse(body, answer=example.answer, long=long)


def _is_long(example: FrameExample, scope: RuleScope) -> bool:
    """Whether a frame is about registers of 32 bits."""
    start = example.address
    if start is None and not (example.answer and example.function in WORD_READS):
        start = int.from_bytes(example.frame[2:4])
    if start is None or example.function not in enron.FUNCTIONS:
        return False
    places = (place for register in scope.model.registers for place in _places(register, ""))
    return any(view.space is Space.ENRON and address == Space.ENRON.within(start) for view, address in places)


HELP_FRAME = "correct the bytes or the field; `crc: false` if it has no CRC"


@example_rule(
    "RS0447", "Frame of a worked example is not what the map says of it", FrameExample, "the frame", HELP_FRAME
)
def frame_fields(example: FrameExample, scope: RuleScope) -> Iterator[str]:
    """A frame proves addresses and functions."""
    if example.crc and (wrong := _wrong_crc(example.frame)):
        yield wrong
        return
    try:
        frame = _parsed(example, _is_long(example, scope))
    except MalformedError as malformed:
        yield str(malformed)
        return
    stated = replace(example, function=example.function & ~EXCEPTION_BIT)
    for name in ("unit", "function", "address", "count", "words"):
        said, found = getattr(stated, name), getattr(frame, name)
        if said is not None and found is not None and said != found:
            yield f"its {name} is {found}, the map says {said}"


def _wrong_crc(frame: bytes) -> str:
    from regscribe_runtime.wire.framing import RTU, build  # noqa: PLC0415 (pymodbus loads only for a map with frames)

    should = build(RTU, frame[0], frame[1:-CRC_LENGTH])
    stated, computed = (one[-CRC_LENGTH:].hex(" ").upper() for one in (frame, should))
    return f"its CRC is {stated}, computed {computed}" if stated != computed else ""


@example_rule("RS0448", "Values of a worked frame are not reproduced", FrameExample, "the frame")
def frame_values(example: FrameExample, scope: RuleScope) -> Iterator[str]:
    """The printed words prove scales, types and commands."""
    try:
        frame = _parsed(example, _is_long(example, scope))
    except MalformedError:
        return
    known = in_example(scope, (*example.state, *example.writes))
    spaces = _spaces(example, frame, scope)
    for path, value in example.writes:
        register = scope.registers.get(path)
        if register is None:
            yield f"model {scope.model.name} has no `{path}`"
        elif register.block:
            yield f"`{path}` stands in block {register.block}, whose base a frame does not tell: give its `words`"
        elif problem := _value(example, frame, register, value, known, spaces):
            yield f"`{path}`: {problem}"
    yield from _command(example, frame, scope)


def _spaces(example: FrameExample, frame: FrameFields, scope: RuleScope) -> set[Space]:
    """The spaces that the function of a frame reads or writes."""
    same = {frame.function, *(code for codes in scope.register_map.alike if frame.function in codes for code in codes)}
    return {Space.ENRON} if _is_long(example, scope) else {SPACES[code] for code in same if code in SPACES}


class Addressed(NamedTuple):
    """A register that a frame asks for or carries: the view that it uses, and its words as far as they are in it."""

    register: Register
    view: View
    words: tuple[int, ...]


def addressed(example: FrameExample, scope: RuleScope) -> tuple[FrameFields, tuple[Addressed, ...]] | None:
    """The fields of a frame and what always exists at its addresses, in their order; None if it is malformed."""
    try:
        frame = _parsed(example, _is_long(example, scope))
    except MalformedError:
        return None
    start = frame.address if frame.address is not None else example.address
    if start is None:
        return frame, ()
    count, spaces = len(frame.carried) or frame.count or 0, _spaces(example, frame, scope)
    named = dict(example.writes)
    found: dict[str, tuple[int, Addressed]] = {}
    for register in scope.model.registers:
        if register.block or (register.path not in named if named else not register.when.always):
            continue
        for view, address in _places(register, example.view):
            offset = address - view.space.within(start)
            if view.space in spaces and view.allows(frame.function) and 0 <= offset <= count - view.words:
                words = frame.carried[offset : offset + view.words]
                found.setdefault(register.path, (offset, Addressed(register, view, words)))
    return frame, tuple(one for _, one in sorted(found.values(), key=lambda each: each[0]))


def _value(
    example: FrameExample,
    frame: FrameFields,
    register: Register,
    value: Fraction,
    known: Surroundings,
    spaces: set[Space],
) -> str:
    """Why a frame does not carry a value of a register; `spaces` are those that its function reads or writes."""
    start = frame.address if frame.address is not None else example.address
    if start is None:
        return "the frame has no address; say it under `address`"
    words = frame.carried
    for view, address in _places(register, example.view):
        offset = address - view.space.within(start)
        if not 0 <= offset <= len(words) - view.words:
            continue
        if view.space not in spaces:
            return f"it stands in space {view.space}, which function {frame.function:02d} does not address"
        if not view.allows(frame.function):
            return f"its {view.name} view is by functions {list(view.functions)}, not {frame.function:02d}"
        return judged(partial(compare, register, view, words[offset : offset + view.words], value, known))
    return f"it is not among the addresses {start}..{start + len(words) - 1} of the frame"


def _places(register: Register, name: str) -> Iterator[tuple[View, int]]:
    yield from ((view, view.address(register.at)) for view in register.views if name in {"", view.name})
    if name in {"", register.base.name}:
        yield from ((register.base, alias) for alias in register.aliases)


def _command(example: FrameExample, frame: FrameFields, scope: RuleScope) -> Iterator[str]:
    if not example.command:
        return
    command = next((one for one in scope.model.commands if one.id == example.command), None)
    if command is None:
        yield f"model {scope.model.name} has no command `{example.command}`"
        return
    if any(step.block for step in command.steps):
        yield f"command `{command.id}` writes in a block, whose base a frame does not tell: leave it out"
        return
    words = frame.carried
    steps = [
        (
            step.function,
            step.space.plain(step.address),
            words if step.argument and len(words or ()) == len(step.words) else step.words,
        )
        for step in command.steps
        if step.words
    ]
    if (frame.function, frame.address, frame.carried) not in steps:
        listed = "; ".join(f"function {code:02d} at {address}: {hexadecimal(words)}" for code, address, words in steps)
        yield f"no step of command `{command.id}` sends it ({listed})"
