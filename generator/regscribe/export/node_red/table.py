"""The table from which a function node decodes and encodes: plain values, numbers as text `a/b`, bytes by their place.

What the table says is data: the code of a node is the same for every map, so that no text of a map is ever code.
"""

from collections.abc import Sequence
from datetime import timedelta
from fractions import Fraction
from typing import Any

from regscribe.emit.words import labels_of
from regscribe.export.device import Point
from regscribe.export.device.places import places_of
from regscribe.model import BitField, Kind, Sentinel, WireType
from regscribe.reference.limits import Limits
from regscribe_runtime.values.kinds import MOMENTS
from regscribe_runtime.values.octets import EPOCH, SPANS, TextForm, layout_of

Entry = dict[str, Any]
"""What JSON has."""

WHOLE_BYTES = {"utf-8": "utf8", "utf-16": "utf16le"}
"""Encodings that Node.js reads by itself; of others each byte is a letter, or the format does not have them."""

DECIMAL = {
    **dict.fromkeys((WireType.BCD16, WireType.BCD32, WireType.BCD48, WireType.BCD64), "bcd"),
    **dict.fromkeys((WireType.MOD10K_2, WireType.MOD10K_3, WireType.MOD10K_4), "mod10k"),
    **dict.fromkeys((WireType.SIGNMAG16, WireType.SIGNMAG32), "signmag"),
}

ADDRESS_BYTES = {WireType.IPV4: 4, WireType.IPV6: 16, WireType.EUI48: 6, WireType.EUI64: 8}


def entry_of(point: Point, first: int) -> Entry:
    """Return how to read a register from an answer that begins at the address `first`."""
    at = point.address - first
    if point.wire.space.is_bits:
        where: Entry = {"bit": at}
    else:
        every = [2 * at + place for place in places_of(point)]
        used = _used(point, every)
        where = {"bytes": used} | ({"raw": every} if point.wire.type.is_octets and used != every else {})
    return {"path": point.path, **where, **_meaning(point)} | ({"unit": point.unit} if point.unit else {})


def _used(point: Point, every: list[int]) -> list[int]:
    """The bytes that say something: the letters of a text, the lowest of a narrow number."""
    register, wire_type = point.register, point.wire.type
    if register.kind is Kind.STRING and register.text.per_register:
        return every[register.text.per_register == "low" :: 2]
    if size := ADDRESS_BYTES.get(wire_type):
        return every[1::2] if len(every) == 2 * size else every[-size:]
    is_narrow = wire_type.spelling and wire_type not in DECIMAL
    return every[-(wire_type.bits // 8) :] if is_narrow else every


def _meaning(point: Point) -> Entry:
    register, wire_type = point.register, point.wire.type
    said: Entry = {"kind": str(register.kind)}
    if register.kind is Kind.STRING:
        said |= _text(register.text)
    elif register.kind in MOMENTS:
        said["layout"] = _layout(register.layout)
    elif not wire_type.is_octets:
        said |= {"type": type_of(wire_type)} | _number(point)
    if register.enum:
        labels: dict[int, list[str]] = {}
        for member in point.members:
            labels.setdefault(member.code, []).append(member.label)
        said["labels"] = [[str(code), " / ".join(dict.fromkeys(several))] for code, several in labels.items()]
    if faults := _octet_faults(point.sentinels) if wire_type.is_octets else _faults(point):
        said["faults"] = faults
    return said


def type_of(wire_type: WireType) -> str:
    """Return how the bytes of a type are read: one of the ways that decode.js knows."""
    if wire_type is WireType.BIT:
        return "bit"
    if wire_type in DECIMAL:
        return DECIMAL[wire_type]
    return "float" if wire_type.is_float else "int" if wire_type.minimum < 0 else "uint"


def _number(point: Point) -> Entry:
    register, wire_type = point.register, point.wire.type
    said: Entry = {"multiply": str(point.slope), "add": str(point.offset)}
    if register.fractional:
        said["fractional"] = True
    if point.view.saturates and wire_type.is_integer:
        said["clips"] = [str(wire_type.minimum), str(wire_type.maximum)]
    if point.special_numbers:
        said["special"] = [[str(one.wire), str(one.value), one.label, str(one.code)] for one in point.special_numbers]
    if point.valid:
        said["valid"] = intervals(point.valid)
    if register.kind in {Kind.FLAGS, Kind.FIELDS}:
        said["parts"] = [_part(field) for field in point.fields]
    if register.kind is Kind.VERSION:
        said |= {"digits": register.version_digits, "group": register.version_group or register.version_digits}
    return said


def intervals(found: Limits) -> list[list[str | None]]:
    """Return the ends of intervals as text; null where nothing limits."""
    return [[None if end is None else str(Fraction(end)) for end in interval] for interval in found]


def _faults(point: Point) -> list[list[str]]:
    return [
        ["nan" if one.low is None else str(one.low), "nan" if one.high is None else str(one.high), one.label]
        for one in point.faults
    ]


def _octet_faults(sentinels: Sequence[Sentinel]) -> list[list[str]]:
    return [[str(one.ends[0]), str(one.ends[1]), one.label] for one in sentinels if one.ends]


def _part(field: BitField) -> Entry:
    said: Entry = {"id": field.id, "low": field.low, "width": field.width}
    if field.is_flag:
        return said | {"flag": True}
    if field.signed:
        said["signed"] = True
    if field.enum:
        said["labels"] = [[str(code), label] for code, label in labels_of(field.enum).items()]
    else:
        said |= {"multiply": str(field.multiply), "add": str(field.add)}
    if field.valid:
        said["valid"] = [str(end) for end in field.valid]
    if faults := _octet_faults(field.sentinels):
        said["faults"] = faults
    return said


def _text(form: TextForm) -> Entry:
    said: Entry = {"width": form.size, "padding": form.padding, "ends": list(form.ends)}
    return said | {"charset": WHOLE_BYTES.get(form.encoding) or {"letters": letters_of(form.encoding)}}


def _layout(text: str) -> Entry:
    """How words tell a date: seconds since a moment, or parts with their bytes."""
    layout = layout_of(text)
    if layout.step:
        epoch = (layout.epoch - EPOCH) // timedelta(seconds=1)
        return {"step": layout.step, "epoch": epoch} | ({"daily": True} if text in SPANS else {})
    if not layout.parts:
        return {"iec870": True}
    forms = (("ascii" if one.ascii else "bcd" if one.bcd else "whole", one) for one in layout.parts)
    return {"parts": [[one.letter, one.place, one.size, form, one.digits, one.after] for form, one in forms]}


def is_readable(form: TextForm) -> bool:
    """Whether the flow knows the encoding of a text: each byte, or Node.js itself, makes a letter of it."""
    return form.encoding in WHOLE_BYTES or len(bytes(range(256)).decode(form.encoding, "replace")) == 256  # noqa: PLR2004


def letters_of(encoding: str) -> str:
    """Return the letter of each byte in an encoding of one byte a letter; U+FFFD where it has none."""
    letters = "".join(bytes([byte]).decode(encoding, "replace") for byte in range(256))
    return letters.rstrip("\ufffd")
