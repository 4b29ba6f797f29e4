"""The exporter of a device profile of EdgeX for its device service Modbus.

Facts from the sources of device-modbus-go and device-sdk-go (v4, May 2026): a scale on a whole number multiplies by its
whole part, so scaled numbers are floats with a raw type, of which there are three; a scaled number is cut, not rounded,
when it is written, so it is read only; 64 bits, one word and texts are never swapped.
"""

from collections.abc import Mapping, Sequence

from regscribe.dialects import ABCD
from regscribe.dialects.edgex import RAW_TYPES, SWAPS, TABLES, TYPES
from regscribe.export.device import RESOLVED, Carries, Carry, Point, Request, Target, Wire, exported
from regscribe.export.device.options import CHOICE, MODEL, STATE
from regscribe.export.edgex.profile import profile
from regscribe.losses import Exported
from regscribe.model import RegisterMap, WireType

name = "edgex"
summary = "a device profile of EdgeX's device service Modbus"
options = (MODEL, *CHOICE, *STATE)

carries: Carries = RESOLVED | {
    **dict.fromkeys(("unit", "flags", "string", "boolean", "group", "name", "description"), Carry.WHOLE),
    **dict.fromkeys(("write-only",), Carry.WHOLE),
    **dict.fromkeys(("scale", "offset", "range", "range-union", "sentinel", "enum", "fields", "write"), Carry.PARTLY),
    **dict.fromkeys(("functions", "limits"), Carry.PARTLY),
}

SWAPPED_WORDS = 2
LONGEST_TEXT = 123
ENCODINGS = frozenset({"ascii", "utf-8"})


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.space not in TABLES:
        return False
    if wire.space.is_bits:
        return True
    orders = SWAPS if wire.type.words == SWAPPED_WORDS else (ABCD,)
    return wire.type in TYPES and (wire.words, wire.bytes) in orders


def _refuses(point: Point, request: Request) -> str:
    wire, form = point.wire, point.register.text
    most = request.register_map.protocol.most_read(wire.space)
    if wire.type is WireType.STRING and (form.encoding not in ENCODINGS or form.per_register):
        return f"its text is {form.encoding}{', one byte in a register' * bool(form.per_register)}: it must be UTF-8"
    if point.words > min(most, LONGEST_TEXT):
        return f"it has {point.words} words, of which one request has {min(most, LONGEST_TEXT)} at most"
    if point.is_scaled and wire.space.is_bits:
        return "a bit has no scale"
    if point.is_scaled and wire.type.is_integer and wire.type not in RAW_TYPES and not _is_whole(point):
        return f"a scaled {wire.type.value} has no raw type: there are int16, uint16 and int32"
    return ""


def _is_whole(point: Point) -> bool:
    return point.slope.denominator == 1 and point.slope > 0 and not point.offset


TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, placed=False)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the profile. Raises OptionError."""
    return exported(TARGET, maps, options, profile)
