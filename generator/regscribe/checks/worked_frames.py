"""Worked examples that are frames of Modbus RTU, read byte by byte as the standard defines them."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from regscribe.checks.assumed_values import in_example
from regscribe.checks.rule import MAP, Finding, RuleScope, map_rule
from regscribe.checks.worked_values import compare, hexadecimal, printed, unsigned
from regscribe.model import FrameExample, Register, Rule, Space, View
from regscribe.reference import RefusedError, Surroundings, UnknownValueError

CRC_LENGTH = 2
SHORTEST = 2
EXCEPTION = 0x80
BIT_WORDS = {0xFF00: 1, 0x0000: 0}


@dataclass(frozen=True, slots=True)
class Frame:
    """What a frame says; None where it has no such field (`address` of the answer to a read).

    `bits` are what it writes to coils, of which function 05 sends each as a word of its own (FF00 or 0000).
    """

    unit: int
    function: int
    address: int | None = None
    count: int | None = None
    words: tuple[int, ...] | None = None
    bits: tuple[int, ...] | None = None

    @property
    def carried(self) -> tuple[int, ...]:
        """What it carries, as registers hold it."""
        return (self.words if self.bits is None else self.bits) or ()


class MalformedError(ValueError):
    """Bytes that are no frame of this function."""


def crc16(data: bytes) -> int:
    """The CRC-16 of Modbus (serial line V1.02, 6.2.2); sent with the low byte first."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ 0xA001 if crc & 1 else crc >> 1
    return crc


def parse(data: bytes, *, answer: bool) -> Frame:
    """Read a frame without its CRC. Raises MalformedError if it is too short or too long for what it says."""
    if len(data) < SHORTEST:
        message = f"{len(data)} bytes are no frame"
        raise MalformedError(message)
    head, body = Frame(data[0], data[1]), data[2:]
    if answer and head.function & EXCEPTION:
        _length(body, 1)
        return replace(head, function=head.function & ~EXCEPTION)
    read = (ANSWERS if answer else REQUESTS).get(head.function)
    return read(head, body) if read else head


def _length(body: bytes, expected: int) -> None:
    if len(body) != expected:
        message = f"{len(body)} bytes after the function code, {expected} expected"
        raise MalformedError(message)


def _words(data: bytes) -> tuple[int, ...]:
    return tuple(int.from_bytes(data[place : place + 2], "big") for place in range(0, len(data) - 1, 2))


def _address_and_count(head: Frame, body: bytes) -> Frame:
    _length(body, 4)
    address, count = _words(body)
    return replace(head, address=address, count=count)


def _one_word(head: Frame, body: bytes) -> Frame:
    _length(body, 4)
    address, word = _words(body)
    return replace(head, address=address, count=1, words=(word,))


def _one_bit(head: Frame, body: bytes) -> Frame:
    _length(body, 4)
    address, word = _words(body)
    if word not in BIT_WORDS:
        message = f"{word:04X} is no state of a coil: FF00 is on, 0000 is off"
        raise MalformedError(message)
    return replace(head, address=address, count=1, words=(word,), bits=(BIT_WORDS[word],))


def _many_bits(head: Frame, body: bytes) -> Frame:
    address, count, data = _block(body)
    if len(data) != (count + 7) // 8:
        message = f"{count} bits are announced, but {len(data)} bytes"
        raise MalformedError(message)
    bits = tuple(data[place // 8] >> place % 8 & 1 for place in range(count))
    return replace(head, address=address, count=count, words=bits, bits=bits)


def _many_words(head: Frame, body: bytes) -> Frame:
    address, count, data = _block(body)
    if len(data) != 2 * count:
        message = f"{count} words are announced, but {len(data)} bytes"
        raise MalformedError(message)
    return replace(head, address=address, count=count, words=_words(data))


def _block(body: bytes) -> tuple[int, int, bytes]:
    """Address, count and data of a write of several; at least one is written."""
    if len(body) < 5:  # noqa: PLR2004 (address, count, number of bytes)
        _length(body, 5)
    address, count = _words(body[:4])
    _length(body, 5 + body[4])
    if not count:
        message = "it writes nothing"
        raise MalformedError(message)
    return address, count, body[5:]


def _words_read(head: Frame, body: bytes) -> Frame:
    _length(body, 1 + body[0] if body else 1)
    if body[0] % 2:
        message = f"{body[0]} bytes are no whole number of words"
        raise MalformedError(message)
    return replace(head, count=body[0] // 2, words=_words(body[1:]))


REQUESTS: dict[int, Callable[[Frame, bytes], Frame]] = {
    **dict.fromkeys((1, 2, 3, 4), _address_and_count),
    5: _one_bit,
    6: _one_word,
    15: _many_bits,
    16: _many_words,
}
ANSWERS: dict[int, Callable[[Frame, bytes], Frame]] = {
    **dict.fromkeys((3, 4), _words_read),
    5: _one_bit,
    6: _one_word,
    **dict.fromkeys((15, 16), _address_and_count),
}
"""Functions whose fields are compared (application protocol V1.1b3, 6); of others unit and function only."""


Alike = tuple[tuple[int, ...], ...]
"""Functions that do the same, as the map has them."""


def _frames(scopes: tuple[RuleScope, ...]) -> Iterator[FrameExample]:
    for example in scopes[0].register_map.examples:
        if isinstance(example, FrameExample):
            yield example


def _body(example: FrameExample) -> bytes:
    return example.frame[:-CRC_LENGTH] if example.crc else example.frame


@map_rule(
    Rule(
        "RS0447", "Frame of a worked example is not what the map says of it", "A frame proves addresses and functions."
    )
)
def frame_fields(scopes: tuple[RuleScope, ...]) -> Iterator[Finding]:
    """Check the CRC, read the frame, compare its fields with those that the map states."""
    for example in _frames(scopes):
        for problem in _problems(example):
            message = f"{printed('the frame', example)}: {problem}"
            yield Finding(MAP, example.span, message, "correct the bytes or the field; `crc: false` if it has no CRC")


def _problems(example: FrameExample) -> Iterator[str]:
    body = _body(example)
    if example.crc and (told := int.from_bytes(example.frame[-CRC_LENGTH:], "little")) != (crc := crc16(body)):
        yield f"its CRC is {_swapped(told)}, computed {_swapped(crc)}"
        return
    try:
        frame = parse(body, answer=example.answer)
    except MalformedError as malformed:
        yield str(malformed)
        return
    stated: tuple[tuple[str, object, object], ...] = (
        ("unit", example.unit, frame.unit),
        ("function", example.function & ~EXCEPTION, frame.function),
        ("address", example.address, frame.address),
        ("count", example.count, frame.count),
        ("words", None if example.words is None else unsigned(example.words), frame.words),
    )
    for name, said, found in stated:
        if said is not None and found is not None and said != found:
            yield f"its {name} is {found}, the map says {said}"


def _swapped(crc: int) -> str:
    return crc.to_bytes(CRC_LENGTH, "little").hex(" ").upper()


@map_rule(
    Rule("RS0448", "Values of a worked frame are not reproduced", "The printed words prove scales, types and commands.")
)
def frame_values(scopes: tuple[RuleScope, ...]) -> Iterator[Finding]:
    """Decode the words of a frame as the registers they go to, and compare commands with their steps."""
    by_name = {scope.model.name: scope for scope in scopes}
    for example in _frames(scopes):
        scope = by_name.get(example.model, scopes[0])
        try:
            frame = parse(_body(example), answer=example.answer)
        except MalformedError:
            continue
        for problem in (*_values(example, frame, scope), *_command(example, frame, scope)):
            help_text = "correct the map; if the manual errs, tell in `errata`"
            yield Finding(MAP, example.span, f"{printed('the frame', example)}: {problem}", help_text)


def _values(example: FrameExample, frame: Frame, scope: RuleScope) -> Iterator[str]:
    said = (*example.state, *example.writes)
    known = in_example(scope.register_map, scope.model, scope.beginning, said)
    for path, value in example.writes:
        register = scope.registers.get(path)
        if register is None:
            yield f"model {scope.model.name} has no `{path}`"
        elif problem := _value(example, frame, register, value, known, scope.register_map.alike):
            yield f"`{path}`: {problem}"


def _value(
    example: FrameExample, frame: Frame, register: Register, value: Fraction, known: Surroundings, alike: Alike
) -> str:
    start = frame.address if frame.address is not None else example.address
    if start is None:
        return "the frame has no address; say it under `address`"
    words = frame.carried
    for view, address in _places(register, example.view):
        offset = address - start
        if 0 <= offset <= len(words) - view.words:
            there = words[offset : offset + view.words]
            return _unaddressed(view, frame.function, alike) or _compared(register, view, there, value, known)
    return f"it is not among the addresses {start}..{start + len(words) - 1} of the frame"


def _unaddressed(view: View, function: int, alike: Alike) -> str:
    """Why a function does not address a view; empty if it does."""
    if view.space not in _spaces(function, alike):
        return f"it stands in space {view.space}, which function {function:02d} does not address"
    if not view.allows(function):
        return f"its {view.name} view is by functions {list(view.functions)}, not {function:02d}"
    return ""


def _compared(register: Register, view: View, words: tuple[int, ...], value: Fraction, known: Surroundings) -> str:
    try:
        return compare(register, view, words, value, known)
    except UnknownValueError as unknown:
        return f"it depends on `{unknown}`; say its value under `with`"
    except RefusedError as refused:
        return str(refused)


def _spaces(function: int, alike: Alike) -> set[Space]:
    """The spaces that a function reads or writes, those included where another one does the same."""
    same = {function, *(code for codes in alike if function in codes for code in codes)}
    reads = {space for space in Space if space.read_function in same}
    return reads | {space for space in Space if same & set(space.write_functions)}


def _places(register: Register, name: str) -> Iterator[tuple[View, int]]:
    yield from ((view, view.address) for view in register.views if name in {"", view.name})
    if name in {"", register.base.name}:
        yield from ((register.base, alias) for alias in register.aliases)


def _command(example: FrameExample, frame: Frame, scope: RuleScope) -> Iterator[str]:
    if not example.command:
        return
    command = next((one for one in scope.model.commands if one.id == example.command), None)
    if command is None:
        yield f"model {scope.model.name} has no command `{example.command}`"
        return
    steps = [(step.function, step.address, unsigned(step.words)) for step in command.steps if step.words]
    if (frame.function, frame.address, frame.carried) not in steps:
        told = "; ".join(f"function {code:02d} at {address}: {hexadecimal(words)}" for code, address, words in steps)
        yield f"no step of command `{command.id}` sends it ({told})"
