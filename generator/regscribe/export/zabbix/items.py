"""The items of a point: one for its number or text, and one for each part of a word, which depends on the first."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import count

from regscribe.dialects import ABCD, BADC
from regscribe.dialects.zabbix import BITS, ENDIANNESS, IN_WORDS, TYPES, WORD
from regscribe.emit.words import one_line
from regscribe.export.device import Device, Point
from regscribe.export.device.names import Names
from regscribe.export.device.numbers import decimal, is_exact
from regscribe.export.zabbix.scripts import EXACT, checks_of, number_script, part_script, text_script
from regscribe.losses import Grade
from regscribe.model import BitField, Enum, Kind, Order, WireType, show

LONGEST = 255
"""Characters of a name."""

UNSIGNED, FLOAT, TEXT = "UNSIGNED", "FLOAT", "TEXT"
UNSIGNED_OF = {WireType.INT16: WireType.UINT16, WireType.INT32: WireType.UINT32}
PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})

Labels = tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Item:
    """An item: what it is called, the key by which the agent reads it, the steps before its value is stored.

    `labels` are those of codes (an empty code: of all others), `set` is what the map calls them; a part of a word has
    the key of its `master`.
    """

    point: Point
    name: str
    key: str
    value_type: str
    steps: tuple[tuple[str, str], ...] = ()
    unit: str = ""
    description: str = ""
    labels: Labels = ()
    set: str = ""
    master: str = ""


def items_of(device: Device, point: Point, keys: Names) -> Iterator[Item]:
    """Yield the items of a point and tell what they lose. Raises nothing."""
    register = point.register
    key = _key(point, keys)
    name = f"{register.name} ({register.path})" if register.index else register.name
    _tell(device, point)
    if register.kind is Kind.STRING:
        steps = (("JAVASCRIPT", text_script(point)),)
        yield Item(point=point, name=name, key=key, value_type=TEXT, steps=steps, description=register.description)
        return
    yield Item(
        point=point,
        name=name,
        key=key,
        value_type=_value_type(point),
        steps=tuple(_steps(point)),
        unit=point.unit,
        description=register.description,
        labels=_labels(point),
        set=register.enum.id if register.enum else "",
    )
    for part in point.fields:
        yield _part(point, part, name, key)


def _key(point: Point, keys: Names) -> str:
    """The key, which a template has once: of a register with the same words a blank, which agents skip, is added."""
    call, address, rest = _reading(point)
    return next(one for blanks in count() if (one := f"{call}{' ' * blanks}{address}{rest}") == keys.give(one))


def _reading(point: Point) -> tuple[str, int, str]:
    wire = point.wire
    kind = UNSIGNED_OF.get(wire.type, wire.type) if point.register.kind in PATTERNS else wire.type
    many, endian = 1, ""
    if wire.space.is_bits:
        kind = WireType.BIT
    elif kind in IN_WORDS:
        many, endian = point.words, ENDIANNESS[1][BADC if wire.bytes is Order.LITTLE else ABCD]
    else:
        endian = ENDIANNESS[kind.words][wire.words, wire.bytes]  # type: ignore[index]  # only what fits is here
    type_ = WORD if kind in IN_WORDS else TYPES.get(kind) or BITS[kind]
    call = f'modbus.get["{{$MODBUS.AT}}","{{$MODBUS.UNIT}}",{wire.space.read_function},'
    return call, point.address, f",{many},{type_}{',' * bool(endian)}{endian}]"


def _value_type(point: Point) -> str:
    plain = not point.is_scaled and point.wire.type.is_integer and point.wire.type.minimum >= 0
    return UNSIGNED if plain or point.register.kind in PATTERNS else FLOAT


def _steps(point: Point) -> Iterator[tuple[str, str]]:
    pattern = point.register.kind in PATTERNS
    plain = point.wire.type in TYPES and not point.offset and is_exact(point.slope)
    if plain and point.is_scaled and not checks_of(point, pattern=pattern):
        yield "MULTIPLIER", decimal(point.slope)
    elif script := number_script(point, pattern=pattern):
        yield "JAVASCRIPT", script


def _labels(point: Point) -> Labels:
    found = {str(one.code): one_line(one.label) for one in point.members}
    found |= {decimal(Fraction(one.code)): one_line(one.label) for one in point.special_numbers}
    other = point.register.enum.other if point.register.enum else ""
    return tuple((found | ({"": one_line(other)} if other else {})).items())


def _part(point: Point, part: BitField, name: str, master: str) -> Item:
    labels = _part_labels(part.enum)
    plain = not part.signed and part.multiply == 1 and part.add == 0
    return Item(
        point=point,
        name=f"{name}: {part.label}",
        key=f"modbus.part[{point.path.replace('[', '.').replace(']', '')}.{part.id}]",
        value_type=UNSIGNED if plain else FLOAT,
        steps=(("JAVASCRIPT", part_script(part)),),
        unit=part.unit,
        description=part.description,
        labels=labels,
        set=part.enum.id if part.enum else "",
        master=master,
    )


def _part_labels(enum: Enum | None) -> Labels:
    return tuple((str(code), one_line(label)) for code, label in enum.labels.items()) if enum else ()


def _tell(device: Device, point: Point) -> None:
    register = point.register
    if register.kind is Kind.STRING and any(one.ends and one.ends[0] != one.ends[1] for one in point.sentinels):
        device.lose(
            register, "sentinel", Grade.WRONG, "texts that report a fault from one to another are shown as they are"
        )
    if register.valid and point.valid is None:
        device.lose(register, "valid", Grade.LOST, "its limits are not known as the device is stated")
    for one in point.special_numbers:
        if one.value != one.code:
            done = f"{show(one.code)} is shown for {show(one.value)}, with the label {one_line(one.label)}"
            device.lose(register, "special-value", Grade.WRONG, done)
    if _value_type(point) == FLOAT and point.wire.type.is_integer and point.wire.type.bits > EXACT.bit_length() - 1:
        done = "Zabbix has no whole numbers with a sign: beyond 53 bits the last digits are lost"
        device.lose(register, "precision-float64", Grade.LOST, done)
