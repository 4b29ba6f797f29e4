"""The resources of a point: a number, a text or a bit, and each part of a word by mask and shift."""

from collections.abc import Iterable, Iterator, Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any, NamedTuple

from regscribe import files
from regscribe.dialects.edgex import BOOL, RAW_TYPES, SWAPS, TABLES, TYPES
from regscribe.emit.words import one_line
from regscribe.export.device import LEFT_OUT, Device, Point
from regscribe.export.device.names import Names
from regscribe.export.device.numbers import decimal, is_exact
from regscribe.export.device.writes import obstacle
from regscribe.losses import Grade
from regscribe.model import BitField, Kind, Order, Space, WireType, show

Plain = dict[str, Any]

WORD = 16
FLOAT = "Float64"
UNSIGNED = {WireType.INT16: WireType.UINT16, WireType.INT32: WireType.UINT32, WireType.INT64: WireType.UINT64}
PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})


class Resource(NamedTuple):
    """A resource as the profile has it, and the labels of its codes, which a command tells in their place."""

    said: Plain
    labels: Mapping[str, str] = {}


def resources_of(device: Device, point: Point, names: Names) -> Iterator[Resource]:
    """Yield the resources of a point, and tell what they lose."""
    register, written = point.register, _is_written(device, point)
    if not register.access.readable and not written:
        device.lose(register, LEFT_OUT, Grade.LOST, "left out: it cannot be read, and is not written by EdgeX")
        return
    _tell(device, point)
    if register.kind not in PATTERNS or written or not point.fields:
        apart = written and register.access.readable and point.write != point.address
        access = ("R" if register.access.readable else "") + ("W" if written and not apart else "")
        yield _value(device, point, names.give(point.id), access, point.address)
        if apart and point.write is not None:
            yield _value(device, point, names.give(f"{point.id}_write"), "W", point.write)
    for part in point.fields if register.access.readable else ():
        if part.is_scaled:
            done = f"{part.id} is left out: its number is not that of its bits"
            device.lose(register, "fields", Grade.LOST, done)
            continue
        yield _part(point, part, names.give(f"{point.id}_{part.id}"))


def _is_written(device: Device, point: Point) -> bool:
    """Whether it can be written; tells why not, where the map lets others write it."""
    if not point.register.access.writable or point.write is None:
        return False
    function = _write_function(point)
    view = point.register.write_view
    reasons = {
        (why := obstacle(point, device.register_map.protocol)): bool(why),
        "a scaled number is cut, not rounded, when it is written": point.is_scaled,
        f"it would be written by function {function}, which the device does not take for it": function
        not in device.register_map.protocol.functions
        or not view.allows(function),
    }
    why = next((why for why, holds in reasons.items() if holds), "")
    if why:
        device.lose(point.register, "write", Grade.LOST, f"read only: {why}")
    return not why


def _write_function(point: Point) -> int:
    if point.wire.space is Space.COIL:
        return 15
    return 6 if point.words == 1 else 16


def _value(device: Device, point: Point, name: str, access: str, address: int) -> Resource:
    kind = UNSIGNED.get(point.wire.type, point.wire.type) if point.register.kind in PATTERNS else point.wire.type
    attributes: Plain = {"primaryTable": TABLES[point.wire.space], "startingAddress": address}
    properties: Plain = {"valueType": TYPES.get(kind, BOOL), "readWrite": access}
    if point.wire.space.is_bits:
        properties["valueType"] = BOOL
    elif point.register.kind is Kind.BOOLEAN and "W" not in access and point.words == 1:
        attributes["startingAddress"], properties["valueType"] = f"{address}.{_turned(0, point)}", BOOL
    elif kind is WireType.STRING:
        attributes["stringRegisterSize"] = point.words
    else:
        attributes |= _swaps(point)
        properties |= _scale(point, kind, attributes)
    properties |= _range(device, point) if "W" in access else {}
    properties |= {"units": point.unit} if point.unit else {}
    codes = {one.code: one.label for one in point.members}
    return _resource(
        name, _text((point.register.name, point.register.description), codes), attributes, properties, codes
    )


def _scale(point: Point, kind: WireType, attributes: Plain) -> Plain:
    """Scale and offset; of whole numbers as a float made of the raw type, where there is one."""
    if not point.is_scaled:
        return {}
    said = {"scale": point.slope} if point.slope != 1 else {}
    said |= {"offset": point.offset} if point.offset else {}
    if kind in RAW_TYPES:
        attributes["rawType"] = RAW_TYPES[kind]
        return {"valueType": FLOAT} | {key: _number(value) for key, value in said.items()}
    return {key: _number(value) for key, value in said.items()}


def _range(device: Device, point: Point) -> Plain:
    """The limits of writes; special values outside widen them, which is told."""
    register = point.register
    if register.range and point.limits is None:
        device.lose(register, "range", Grade.LOST, "its range is not known as the device is stated")
    if point.limits is None:
        return {}
    if point.ranges and len(point.ranges) > 1:
        device.lose(register, "range-union", Grade.LOST, "writes between its lowest and highest value are not refused")
    outside = [one.code for one in point.special_numbers if not point.limits[0] <= one.code <= point.limits[1]]
    if outside:
        done = f"it is as wide as its special values ({', '.join(map(show, outside))}), with what lies between"
        device.lose(register, "range", Grade.LOST, done)
    ends = (*point.limits, *outside)
    return {"minimum": _number(min(ends)), "maximum": _number(max(ends))}


def _part(point: Point, part: BitField, name: str) -> Resource:
    """A part of a word: a bit by its place, a wider one by mask and shift, which count in this order."""
    attributes: Plain = {"primaryTable": TABLES[point.wire.space]}
    codes = part.enum.labels if part.enum else {}
    text = _text((f"{point.register.name}: {part.label}",), codes)
    if part.width == 1 and not part.enum:
        word, bit = divmod(part.low, WORD)
        further = word if point.wire.words is Order.LITTLE else point.words - 1 - word
        attributes["startingAddress"] = f"{point.address + further}.{_turned(bit, point)}"
        return _resource(name, text, attributes, {"valueType": BOOL, "readWrite": "R"})
    kind = UNSIGNED.get(point.wire.type, point.wire.type)
    attributes |= {"startingAddress": point.address} | _swaps(point)
    mask = ((1 << part.width) - 1) << part.low
    properties: Plain = {"valueType": TYPES[kind], "readWrite": "R", "mask": mask}
    return _resource(name, text, attributes, properties | ({"shift": part.low} if part.low else {}), codes)


def _turned(bit: int, point: Point) -> int:
    """The number of a bit as the service counts: it does not turn the bytes of a word of which it takes a bit."""
    return (bit + WORD // 2) % WORD if point.wire.bytes is Order.LITTLE else bit


def _swaps(point: Point) -> Plain:
    byte, word = SWAPS.get((point.wire.words, point.wire.bytes), (False, False))  # type: ignore[arg-type]  # what fits
    return ({"isByteSwap": True} if byte else {}) | ({"isWordSwap": True} if word else {})


def _resource(
    name: str, description: str, attributes: Plain, properties: Plain, codes: Mapping[int, str] | None = None
) -> Resource:
    said = {"name": name, "isHidden": False, "description": description}
    is_bool = properties["valueType"] == BOOL
    labels = {
        str(bool(code)).lower() if is_bool else str(code): one_line(label) for code, label in (codes or {}).items()
    }
    return Resource({**said, "attributes": files.OneLine(attributes), "properties": properties}, labels)


def _text(said: Iterable[str], codes: Mapping[int, str]) -> str:
    """A description, with the labels of codes."""
    labels = ", ".join(f"{code} = {label}" for code, label in codes.items())
    return one_line("; ".join(filter(None, (*said, labels))))


def _number(number: Fraction) -> int | Decimal:
    return int(number) if number.denominator == 1 else Decimal(decimal(number))


def _tell(device: Device, point: Point) -> None:
    register = point.register
    if register.kind is Kind.BOOLEAN and not point.wire.space.is_bits:
        device.lose(register, "truth-of-words", Grade.WRONG, "its lowest bit counts, or any number is told as it is")
    if point.members:
        done = "labels are told in place of codes, and stand in the description; codes are written"
        device.lose(register, "enum", Grade.COSMETIC, done)
    for number in (point.slope, point.offset):
        if not is_exact(number):
            device.lose(register, "scale-rounded", Grade.COSMETIC, f"{decimal(number)} for {show(number)}")
    if point.is_scaled and point.wire.type is WireType.FLOAT32:
        device.lose(register, "precision-float32", Grade.LOST, "it is scaled as a float of 32 bits")
    if point.is_scaled and point.wire.type.is_integer and point.wire.type not in RAW_TYPES:
        done = f"a value beyond {point.wire.type.value} is an error"
        device.lose(register, "scale", Grade.LOST, done)
    for fault in point.faults:
        if fault.low is not None:
            done = f"{show(fault.low)} is told as a number: {one_line(fault.label)}"
            device.lose(register, "sentinel", Grade.WRONG, done)
