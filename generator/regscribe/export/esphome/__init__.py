"""The exporter of a configuration of ESPHome's component `modbus_controller` (docs/export.md).

Facts from the component's own code, of 2026.6. It speaks RTU on a UART; a state is a float of 32 bits.
"""

from collections.abc import Mapping, Sequence

from regscribe.dialects.esphome import SPACES, TYPES
from regscribe.export.device import RESOLVED, Carries, Carry, Point, Request, Target, Wire, exported
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.export.esphome.configuration import BUS, configuration
from regscribe.losses import Exported
from regscribe.model import Order, RegisterMap, WireType
from regscribe.plugins import OptionError

name = "esphome"
summary = "a configuration of ESPHome's modbus_controller"
options = (*(one for one in DEVICE_OPTIONS if one.name != "at"), BUS)

carries: Carries = RESOLVED | {
    **dict.fromkeys(("scale", "offset", "unit", "flags", "string", "functions", "limits"), Carry.WHOLE),
    **dict.fromkeys(("sentinel", "enum", "fields", "boolean", "version", "name"), Carry.PARTLY),
    **dict.fromkeys(("write", "range", "step", "pause"), Carry.PARTLY),
}

LONGEST_TEXT = 250
"""Bytes: the component counts those of an answer in one byte."""

ENCODINGS = frozenset({"ascii", "utf-8"})


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.space not in SPACES:
        return False
    if wire.space.is_bits or wire.type is WireType.UINT8:
        return True
    if wire.type is WireType.STRING:
        return wire.words is Order.BIG and wire.bytes is Order.BIG
    return (wire.type, (wire.words, wire.bytes)) in TYPES


def _refuses(point: Point, request: Request) -> str:
    most = request.register_map.protocol.most_read(point.wire.space)
    if point.words > most:
        return f"it has {point.words} registers, and the device sends {most} at once"
    text = point.register.text
    if point.wire.type is not WireType.STRING or point.wire.space.is_bits:
        return ""
    if text.per_register or text.codec not in ENCODINGS:
        return "ESPHome reads texts of UTF-8 or ASCII alone, two bytes in each register"
    return f"ESPHome reads texts of {LONGEST_TEXT} bytes at most" if 2 * point.words > LONGEST_TEXT else ""


TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, verified="ESPHome 2026.6.5", placed=False)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the configuration. Raises OptionError."""
    bus = options[BUS.name]
    if bus and not (bus.isascii() and bus.isidentifier()):
        message = f"--bus {bus}: an id of ESPHome has letters, digits and underscores, a letter first"
        raise OptionError(message)
    return exported(TARGET, maps, options, lambda device: configuration(device, bus))
