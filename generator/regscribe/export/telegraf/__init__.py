"""The exporter of a poll by Telegraf's input plug-in modbus, in the metric style.

Facts from the plug-in's own documentation and source (plugins/inputs/modbus): one byte order for each metric block, a
scale but no offset (a processor adds it), scaled values are floats, a text loses one NUL at its end, no other filling.
"""

from collections.abc import Mapping, Sequence

from regscribe.dialects.telegraf import ORDERS, SPACES, TYPES
from regscribe.export.device import RESOLVED, Carries, Carry, Point, Request, Target, Wire, exported
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.export.telegraf.configuration import byte_type, configuration
from regscribe.losses import Exported
from regscribe.model import Order, RegisterMap, WireType

name = "telegraf"
summary = "a configuration of Telegraf's modbus input, metric style"
options = DEVICE_OPTIONS

carries: Carries = RESOLVED | {
    "boolean": Carry.PARTLY,
    **dict.fromkeys(("unit", "string", "flags", "limits", "pause"), Carry.WHOLE),
    **dict.fromkeys(("scale", "offset", "functions"), Carry.PARTLY),
}

LAST = 0xFFFF
ENCODINGS = frozenset({"ascii", "utf-8"})
"""Characters that are bytes of UTF-8, for which Telegraf takes a text."""


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.space not in SPACES:
        return False
    if wire.space.is_bits:
        return True
    if byte_type(wire):
        return True
    if wire.type is WireType.STRING:  # the plug-in turns the bytes of a text, never its words
        return wire.words is Order.BIG and (wire.words, wire.bytes) in ORDERS
    return wire.type in TYPES and (wire.words, wire.bytes) in ORDERS


def _refuses(point: Point, _: Request) -> str:
    if point.address + point.words > LAST:
        return f"the plug-in reads no register that ends at {LAST}"
    if point.wire.type is WireType.STRING and point.register.text.encoding not in ENCODINGS:
        return f"its text is {point.register.text.encoding}, and the plug-in takes the bytes for UTF-8"
    return ""


TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, truth_as_number=True)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the configuration. Raises OptionError."""
    return exported(TARGET, maps, options, configuration)
