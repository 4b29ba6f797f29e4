"""The exporter of a template of Zabbix 6.0 whose items agent 2 reads (`modbus.get`).

What the agent cannot do itself, a script of the item does before the value is stored: floats exactly (the agent tells
six decimals), int64, texts, fault words, scales with an offset. Zabbix runs them by Duktape: they are of ECMAScript 5.
"""

from collections.abc import Mapping, Sequence

from regscribe.dialects import ABCD, BADC
from regscribe.dialects.zabbix import BITS, ENDIANNESS, IN_WORDS, TYPES
from regscribe.export.device import RESOLVED, Carries, Carry, Point, Request, Target, Wire, exported
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.export.zabbix.template import template
from regscribe.losses import Exported
from regscribe.model import Kind, Order, RegisterMap

name = "zabbix"
summary = "a template of Zabbix 6.0 with items of agent 2"
options = DEVICE_OPTIONS

carries: Carries = RESOLVED | {
    "boolean": Carry.PARTLY,
    **dict.fromkeys(("scale", "offset", "unit", "flags", "fields", "string"), Carry.WHOLE),
    **dict.fromkeys(("padding", "group", "name", "description"), Carry.WHOLE),
    **dict.fromkeys(("sentinel", "enum", "special-value", "valid", "functions", "limits"), Carry.PARTLY),
}

ADDRESSES = 0xFFFF
PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})
PATTERN_BITS = 32
"""A script has numbers of 53 bits, and takes parts out of words of so many at most."""
ENCODINGS = frozenset({"ascii", "latin-1", "utf-8"})


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.space.last != ADDRESSES or not (wire.space.is_bits or wire.space.is_words):
        return False
    if wire.space.is_bits:
        return True
    if wire.type in IN_WORDS:
        return isinstance(wire.words, Order) and (Order.BIG, wire.bytes) in (ABCD, BADC)
    known = wire.type in TYPES or wire.type in BITS
    return known and (wire.words, wire.bytes) in ENDIANNESS[wire.type.words]


def _refuses(point: Point, _: Request) -> str:
    if point.register.kind in PATTERNS and point.wire.type.bits > PATTERN_BITS:
        return f"its bits are {point.wire.type.bits}, and a script takes {PATTERN_BITS} apart at most"
    if point.register.kind is Kind.STRING and point.register.text.encoding not in ENCODINGS:
        return f"its text is {point.register.text.encoding}, which a script does not decode"
    return ""


VERIFIED = "zabbix-agent2 6.0.14, its scripts with Node.js, the import check of the frontend 6.0.14; no server took it"
TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, verified=VERIFIED, truth_as_number=True)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the template. Raises OptionError."""
    return exported(TARGET, maps, options, template)
