"""What a simulated device holds: the words of each register in all its views, and which of them may be written."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from fractions import Fraction

from regscribe.export.device import Device, Point
from regscribe.losses import Grade
from regscribe.model import Kind, Register, Space, View, WireType
from regscribe.reference import (
    AS_IS,
    Known,
    RefusedError,
    UnknownValueError,
    choose,
    encode,
    ieee_number,
    number_of,
    straight,
    transmit,
    word_order,
)
from regscribe_runtime.values.kinds import OCTETS

SPACES: tuple[Space, ...] = (Space.COIL, Space.DISCRETE, Space.INPUT, Space.HOLDING)
"""In the order in which their blocks follow each other."""

CELL_BITS = 16
"""A cell of the simulator holds a word, or so many coils."""

PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})

Value = int | float | str


@dataclass(frozen=True, slots=True)
class Typed:
    """Cells of a space that one list of the simulator describes by a value, as its words are in the usual order."""

    space: Space
    address: int
    words: tuple[int, ...]
    section: str
    value: Value


@dataclass(frozen=True, slots=True)
class Memory:
    """Cells by space and address, which of them may be written, and those that are better said as a value."""

    cells: dict[Space, dict[int, int]] = field(default_factory=lambda: {space: {} for space in SPACES})
    writable: dict[Space, set[int]] = field(default_factory=lambda: {space: set() for space in SPACES})
    typed: list[Typed] = field(default_factory=list)


def memory_of(device: Device) -> Memory:
    """Return what the device holds, and tell what it cannot do."""
    memory = Memory()
    for point in device.points:
        _hold(device, point, memory)
    return memory


def _hold(device: Device, point: Point, memory: Memory) -> None:
    register, known = point.register, device.request.known
    value = _value(register, known)
    places = [(view, view.address(register.at)) for view in register.views if view.space in SPACES]
    places += [(register.base, address) for address in register.aliases]
    for view, address in places:
        words = _words(device, register, view, value)
        if view.space.is_bits:
            _set_bit(memory, view, address, words[0])
        else:
            _set_words(device, point, memory, view, address, words)
        if register.access.writable and view.writable:
            cells = (address // CELL_BITS,) if view.space.is_bits else (address + offset for offset in view.offsets)
            memory.writable[view.space].update(cells)
    _tell(device, register)


def _value(register: Register, known: Known) -> Fraction | str | None:
    """The value that was stated for the register, else its default."""
    if register.kind in OCTETS or register.kind is Kind.VERSION:
        found = register.default
        return found if found is not None else _chosen(register, known)
    try:
        return known.look_up(register.path)
    except UnknownValueError:
        found = register.default if register.default is not None else _chosen(register, known)
        return number_of(register, found)


def _chosen(register: Register, known: Known) -> Fraction | str | None:
    try:
        return choose(register.default_cases, known)
    except UnknownValueError:
        return None


def _words(device: Device, register: Register, view: View, value: Fraction | str | None) -> tuple[int, ...]:
    """The words of a value; zeros, which is told, where there is none."""
    if value is None:
        device.lose(register, "default", Grade.COSMETIC, "the map states none: it holds zeros")
        return (0,) * view.words
    try:
        return _encoded(register, view, value, device.request.known)
    except (RefusedError, UnknownValueError) as why:
        device.lose(register, "default", Grade.LOST, f"it holds zeros: {why}")
        return (0,) * view.words


def _encoded(register: Register, view: View, value: Fraction | str, known: Known) -> tuple[int, ...]:
    """The words of a value; clipped as the device clips it, where the view cannot carry it."""
    try:
        return encode(register, view, value, known, rounded=True)
    except RefusedError:
        line = None if isinstance(value, str) else straight(choose(register.scale, known), known)
        if line is None or isinstance(value, str) or register.kind in PATTERNS:
            raise
        return transmit(view, line.stored(value), known)


def _set_bit(memory: Memory, view: View, address: int, value: int) -> None:
    cell, bit = divmod(address, CELL_BITS)
    cells = memory.cells[view.space]
    cells[cell] = cells.get(cell, 0) | value << bit


def _set_words(device: Device, point: Point, memory: Memory, view: View, address: int, words: tuple[int, ...]) -> None:
    """Hold words; of two registers with the same word the first counts, but that each byte has its own."""
    register, cells = point.register, memory.cells[view.space]
    taken = {address + offset: words[offset] for offset in view.offsets}
    if view.is_byte:
        cells[address] = cells.get(address, 0) | words[0]
        return
    if any(cells.get(place, word) != word for place, word in taken.items()):
        device.lose(register, "default", Grade.LOST, "its words are those of another register at the same address")
    fresh = not any(place in cells for place in taken)
    for place, word in taken.items():
        cells.setdefault(place, word)
    if fresh and not view.is_apart and _is_usual(view, device.request.known):
        memory.typed.extend(_typed(view, address, words))


def _is_usual(view: View, known: Known) -> bool:
    try:
        return word_order(view, known) == AS_IS
    except UnknownValueError:
        return False


def _typed(view: View, address: int, words: tuple[int, ...]) -> Iterator[Typed]:
    raw = b"".join(word.to_bytes(2, "big") for word in words)
    bits = int.from_bytes(raw, "big")
    if view.type is WireType.UINT32:
        yield Typed(view.space, address, words, "uint32", bits)
    elif view.type in {WireType.FLOAT32, WireType.FLOAT64}:
        number = float(ieee_number(bits, view.type))
        if number or not bits:  # a negative zero is said by its words
            yield Typed(view.space, address, words, view.type.value, number)
    elif view.type is WireType.STRING and (text := raw.decode("latin-1")).isascii() and text.isprintable():
        yield Typed(view.space, address, words, "string", text)


def _tell(device: Device, register: Register) -> None:
    if len(register.views) > 1 or register.aliases:
        fact = "view" if len(register.views) > 1 else "alias"
        device.lose(register, fact, Grade.LOST, "each place holds words of its own: a write of one leaves the others")
    if not register.access.readable:
        device.lose(register, "write-only", Grade.LOST, "it can be read as well")
    if register.access.writable and register.base.space is Space.COIL:
        device.lose(register, "write", Grade.LOST, "coils are written, or not, with all sixteen that stand in one cell")
