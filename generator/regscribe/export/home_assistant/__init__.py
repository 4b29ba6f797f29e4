"""The exporter of a configuration of Home Assistant's integration `modbus` (docs/export.md).

Facts from the integration's own code, of 2024.3 and of 2026.11: sensors, binary sensors and switches; no numbers and no
selects. Each entity is a request of its own, so limits of requests hold by themselves.
"""

from collections.abc import Mapping, Sequence
from math import ceil

from regscribe.dialects.home_assistant import SPACES, SWAPS, TYPES
from regscribe.emit.words import one_line
from regscribe.export.device import RESOLVED, Carries, Carry, Device, Point, Request, Target, Wire, exported
from regscribe.export.device.names import distinct
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.export.home_assistant.entities import Entity, binary_sensor, is_truth, switch, switches
from regscribe.export.home_assistant.sensors import BYTES, TEXT_CODECS, sensor
from regscribe.files import dump
from regscribe.losses import Exported
from regscribe.model import Order, RegisterMap, WireType

name = "home-assistant"
summary = "a configuration of Home Assistant's modbus integration"
options = DEVICE_OPTIONS

carries: Carries = RESOLVED | {
    **dict.fromkeys(("scale", "offset", "unit", "string", "name", "array"), Carry.WHOLE),
    **dict.fromkeys(("functions", "limits", "pause"), Carry.WHOLE),
    **dict.fromkeys(("boolean", "version", "sentinel", "write", "settle", "poll"), Carry.PARTLY),
}

USUAL_TIMEOUT = 3
"""Seconds to wait for an answer, where none are said."""

LONGEST_STATE = 255
"""Characters that a state may have."""


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.space not in SPACES:
        return False
    if wire.space.is_bits or wire.type in BYTES:
        return True
    swap = SWAPS.get((wire.words, wire.bytes))  # type: ignore[arg-type]  # places of words are no key
    if wire.type is WireType.STRING:
        return wire.words is Order.BIG and swap is not None
    return wire.type in TYPES and swap is not None


def _refuses(point: Point, request: Request) -> str:
    text = point.register.text
    if point.wire.type is not WireType.STRING or point.wire.space.is_bits:
        return ""
    if text.per_register or text.codec not in TEXT_CODECS:
        return "Home Assistant reads texts of UTF-8 or ASCII alone, two bytes in each register"
    if 2 * point.words > LONGEST_STATE:
        return f"Home Assistant keeps {LONGEST_STATE} characters of a state, and the text may have {2 * point.words}"
    most = request.register_map.protocol.most_read(point.wire.space)
    return f"it has {point.words} registers, and the device sends {most} at once" if point.words > most else ""


TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, verified="Home Assistant 2024.3.3")


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the configuration. Raises OptionError."""
    return exported(TARGET, maps, options, _text)


def _text(device: Device) -> str:
    lists: dict[str, list[Entity]] = {"sensors": [], "binary_sensors": [], "switches": []}
    names = distinct((f"{device.name} {one_line(point.register.name)}", point.register.path) for point in device.points)
    for point, called in zip(device.points, names, strict=True):
        kind, made = _entity(device, point)
        lists[kind].append({"name": called, "unique_id": _unique_id(device, point), **made})
    hub = {"name": device.name, **_connection(device), **{key: some for key, some in lists.items() if some}}
    return dump({"modbus": [hub]}, remarks=device.heading)


def _entity(device: Device, point: Point) -> tuple[str, Entity]:
    """The list that a register goes into, and its entity."""
    if switches(device, point):
        return "switches", switch(device, point)
    if is_truth(point):
        return "binary_sensors", binary_sensor(device, point)
    return "sensors", sensor(device, point)


def _unique_id(device: Device, point: Point) -> str:
    return f"{device.register_map.id}:{device.name}:{point.register.path}"


def _connection(device: Device) -> Entity:
    place, protocol = device.place, device.register_map.protocol
    timing: Entity = {"timeout": ceil(protocol.timeout)} if protocol.timeout > USUAL_TIMEOUT else {}
    timing |= {"message_wait_milliseconds": ceil(protocol.pause)} if protocol.pause else {}
    if place.host:
        return {"type": "tcp", "host": place.host, "port": place.port, **timing}
    data, parity, stop = tuple(place.format)
    method = "rtu" if "rtu" in protocol.serial.modes else "ascii"
    line = {"baudrate": place.baud, "bytesize": int(data), "method": method, "parity": parity, "stopbits": int(stop)}
    return {"type": "serial", "port": place.device, **line, **timing}
