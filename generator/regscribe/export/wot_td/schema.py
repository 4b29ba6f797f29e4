"""The data schema of a property: its type, and what its numbers mean."""

from collections.abc import Iterable
from fractions import Fraction
from math import ceil, floor
from typing import Any

from regscribe.emit.words import conversion_words, labels_of
from regscribe.export.device import Device, Point
from regscribe.export.device.places import step_of
from regscribe.export.wot_td.parts import is_object, offsets_of
from regscribe.losses import Grade
from regscribe.model import BitField, Conversion, Kind, Number, Sentinel, exact, show

Schema = dict[str, Any]

NUMBERS = frozenset({Kind.NUMBER, Kind.INTEGER, Kind.RAW})
TRUTH = {0: "false", 1: "true"}


def schema_of(device: Device, point: Point, *, writable: bool) -> Schema:
    """Return the schema of a register's value, and tell what of its facts stands in terms of our own."""
    kind = point.register.kind
    if kind is Kind.STRING:
        if point.sentinels:
            device.lose(point.register, "sentinel", Grade.WRONG, "left out: fault words are texts like any other")
        return {"type": "string"}
    if kind in {Kind.FLAGS, Kind.FIELDS}:
        return _parts(device, point) | _faults(device, point)
    if kind is Kind.BOOLEAN and point.wire.space.is_bits:
        return {"type": "boolean"}
    said = {"type": "number" if point.wire.type.is_float else "integer"} | _scale(device, point)
    if kind is Kind.VERSION:
        said |= _version(device, point)
    if writable:
        said |= _range(device, point)
    return said | _codes(device, point) | _faults(device, point) | _special(device, point)


def _codes(device: Device, point: Point) -> Schema:
    """The numbers on the wire that have a label."""
    if point.register.kind is Kind.BOOLEAN:
        device.lose(
            point.register, "boolean", Grade.COSMETIC, "exported as 0 and 1: node-wot would write all bits as 1"
        )
        return _labels(TRUTH)
    labels: dict[int, list[str]] = {}
    for member in point.members:
        raw = (member.code - point.offset) / point.slope
        labels.setdefault(raw.numerator, []).append(member.label)  # codes are whole numbers on the wire
    joined = {code: " / ".join(dict.fromkeys(several)) for code, several in labels.items()}
    return _labels(joined) if joined else {}


def _labels(labels: dict[int, str]) -> Schema:
    return {"oneOf": [{"const": code, "title": label} for code, label in labels.items()]}


def _version(device: Device, point: Point) -> Schema:
    register = point.register
    done = f"exported as the number that packs its {register.version_digits} digits, as x-version says"
    device.lose(register, "version", Grade.LOST, done)
    group = register.version_group or register.version_digits
    return {"x-version": {"digits": register.version_digits, "group": group}}


def _scale(device: Device, point: Point) -> Schema:
    """A unit belongs to the value of use, so that of a scaled number stands beside its scale."""
    if not point.is_scaled:
        return {"unit": point.unit} if point.unit else {}
    scale = conversion_words(Conversion(point.slope, point.offset))
    device.lose(point.register, "scale", Grade.LOST, f"exported raw: the value of a raw x is {scale}, as x-scale says")
    if point.unit:
        device.lose(point.register, "unit", Grade.LOST, f"said in x-unit: the raw number is not in {point.unit}")
    unit = {"x-unit": point.unit} if point.unit else {}
    return {"x-scale": {"multiply": show(point.slope), "add": show(point.offset)}} | unit


def _range(device: Device, point: Point) -> Schema:
    """The ends of what may be written, as numbers on the wire; special values widen them."""
    if step_of(point, device.request.known) is not None:
        device.lose(point.register, "step", Grade.LOST, "left out: the device may round what is written between")
    if point.register.kind not in NUMBERS or not point.register.range:
        return {}
    special = [Fraction(one.wire) for one in point.special_numbers]
    lows, highs = ([pair[side] for pair in point.ranges or ()] for side in (0, 1))
    if point.slope < 0:
        lows, highs = highs, lows
    low, high = (_end(point, ends, special, least=least) for ends, least in ((lows, True), (highs, False)))
    if low is None or high is None:
        device.lose(point.register, "range", Grade.LOST, "left out as far as its ends are no numbers as things stand")
    return {key: end for key, end in (("minimum", low), ("maximum", high)) if end is not None}


def _end(
    point: Point, ends: Iterable[Number | None], special: list[Fraction], *, least: bool
) -> int | float | str | None:
    raw = [None if end is None else (Fraction(end) - point.offset) / point.slope for end in ends]
    known = [end for end in raw if end is not None]
    if len(known) < len(raw) or not known:
        return None
    end = (min if least else max)([*known, *special])
    if point.wire.type.is_float:
        number = _json(end)
        return None if isinstance(number, str) else number
    return ceil(end) if least else floor(end)


def _json(number: Number) -> int | float | str:
    """A number of JSON where its decimal text is exact, else a text."""
    if number.denominator == 1:
        return number.numerator
    try:
        nearest = float(number)
    except OverflowError:
        return show(number)
    return nearest if exact(nearest) == number else show(number)


def _faults(device: Device, point: Point) -> Schema:
    if not point.faults:
        return {}
    done = "a reader takes the number for a value: x-faults says which are none"
    device.lose(point.register, "sentinel", Grade.WRONG, done)
    found = []
    for one in point.faults:
        ends = (
            {"raw": "nan"} if one.low is None or one.high is None else {"from": _json(one.low), "to": _json(one.high)}
        )
        found.append({**ends, "label": one.label})
    return {"x-faults": found}


def _special(device: Device, point: Point) -> Schema:
    if not point.special_numbers:
        return {}
    device.lose(point.register, "special-value", Grade.LOST, "a number for the reader: x-special says what it means")
    found: list[Schema] = []
    for one in point.special_numbers:
        found.append({"raw": _json(one.wire), "label": one.label})
        if one.value != one.code:
            done = f"{show(one.code)} for the reader: x-special says that it stands for {show(one.value)}"
            device.lose(point.register, "special-number", Grade.WRONG, done)
            found[-1]["value"] = show(one.value)
    return {"x-special": found}


def _parts(device: Device, point: Point) -> Schema:
    """An object of the parts, by the places of their bits on the wire, where these lie side by side."""
    offsets = offsets_of(point)
    if not is_object(point):
        scattered = [name for name, offset in offsets.items() if offset is None]
        fact = "flags" if point.register.kind is Kind.FLAGS else "fields"
        done = f"exported as a whole number: the bits of {', '.join(scattered) or 'no part'} are not side by side"
        device.lose(point.register, fact, Grade.LOST, done)
        return {"type": "integer"}
    properties = {
        field.id: _part(device, point, field) | {"ex:bitOffset": offsets[field.id], "ex:bitLength": field.width}
        for field in point.fields
    }
    return {"type": "object", "properties": properties}


def _part(device: Device, point: Point, field: BitField) -> Schema:
    said: Schema = {"title": field.label}
    if field.is_flag:
        return said | {"type": "boolean"}
    said["type"] = "integer"
    if field.enum:
        said |= _labels(labels_of(field.enum))
    if not field.is_number:
        return said | ({"unit": field.unit} if field.unit else {})
    device.lose(point.register, "fields", Grade.LOST, f"the part {field.id} is exported as its bits; x-scale, x-faults")
    said["x-scale"] = {"multiply": show(field.multiply), "add": show(field.add), "signed": field.signed}
    if field.unit:
        said["x-unit"] = field.unit
    return said | _part_faults(field.sentinels)


def _part_faults(sentinels: Iterable[Sentinel]) -> Schema:
    found = [
        {"from": _json(one.ends[0]), "to": _json(one.ends[1]), "label": one.label} for one in sentinels if one.ends
    ]
    return {"x-faults": found} if found else {}
