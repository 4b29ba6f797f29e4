"""The exporter of a poll by Telegraf's input plug-in modbus, in the metric style.

Facts from the plug-in's own documentation (plugins/inputs/modbus): one byte order for each metric block, a scale but no
offset, and scaled values are floats unless `output` says otherwise.
"""

from collections.abc import Iterator, Mapping, Sequence

from regscribe.dialects.telegraf import BIT, ORDERS, SPACES, TYPES
from regscribe.export.device import RESOLVED, Carries, Carry, Device, Point, Target, Wire, exported
from regscribe.export.device.options import DEVICE_OPTIONS
from regscribe.losses import Exported, Grade
from regscribe.model import Kind, RegisterMap, WireType, show
from regscribe.visible import json_text

name = "telegraf"
summary = "a configuration of Telegraf's modbus input, metric style"
options = DEVICE_OPTIONS

carries: Carries = RESOLVED | {
    **dict.fromkeys(("scale", "unit", "string", "boolean", "flags", "array", "group"), Carry.WHOLE),
    "offset": Carry.PARTLY,
    "name": Carry.NO,
}


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.space not in SPACES:
        return False
    return wire.space.is_bits or (wire.type in TYPES and (wire.words, wire.bytes) in ORDERS)


TARGET = Target(name=name, carries=carries, fits=_fits)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the configuration. Raises OptionError."""
    return exported(TARGET, maps, options, _text)


def _text(device: Device) -> str:
    head = [
        f"# {device.name}, from the map {device.register_map.id}",
        "[[inputs.modbus]]",
        f"  name = {_quoted(device.name)}",
        f'  interval = "{device.request.every}s"',
        *_connection(device),
        '  configuration_type = "metric"',
    ]
    by_block: dict[tuple[str, str], list[Point]] = {}
    for point in device.points:
        by_block.setdefault((_order(point), point.unit), []).append(point)
    blocks = (line for (order, unit), points in by_block.items() for line in _block(device, order, unit, points))
    return "\n".join([*head, *blocks]) + "\n"


def _connection(device: Device) -> Iterator[str]:
    place = device.place
    if place.host:
        yield f"  controller = {_quoted(f'tcp://{place.host}:{place.port}')}"
        return
    data, parity, stop = tuple(place.format)
    yield f"  controller = {_quoted(f'file://{place.device}')}"
    yield f"  baud_rate = {place.baud}"
    yield f"  data_bits = {data}"
    yield f'  parity = "{parity}"'
    yield f"  stop_bits = {stop}"
    yield '  transmission_mode = "RTU"'


def _order(point: Point) -> str:
    wire = point.wire
    return "ABCD" if wire.space.is_bits else ORDERS[wire.words, wire.bytes]  # type: ignore[index]  # what fits is there


def _block(device: Device, order: str, unit: str, points: Sequence[Point]) -> Iterator[str]:
    yield ""
    yield "  [[inputs.modbus.metric]]"
    yield f"    slave_id = {device.request.unit}"
    yield f'    byte_order = "{order}"'
    yield f"    measurement = {_quoted(device.model.class_name)}"
    yield "    fields = ["
    for point in points:
        for field in _fields(device, point):
            yield f"      {{ {', '.join(f'{key} = {value}' for key, value in field.items())} }},"
    yield "    ]"
    if unit:
        yield "    [inputs.modbus.metric.tags]"
        yield f"      unit = {_quoted(unit)}"


def _fields(device: Device, point: Point) -> Iterator[dict[str, str]]:
    field = {
        "register": _quoted(SPACES[point.wire.space]),
        "address": str(point.address),
        "name": _quoted(point.id),
    }
    if point.wire.space.is_bits:
        yield field
        return
    if point.register.kind is Kind.FLAGS and point.words == 1:
        for flag in point.fields:
            yield field | {"name": _quoted(f"{point.id}_{flag.id}"), "type": _quoted(BIT), "bit": str(flag.low)}
        return
    yield field | {"type": _quoted(TYPES[point.wire.type])} | _scale(device, point) | _length(point)


def _scale(device: Device, point: Point) -> dict[str, str]:
    if point.offset:
        done = f"exported without it: add {show(point.offset)} to each value, by a processor for instance"
        device.lose(point.register, "offset", Grade.LOST, done)
    if point.slope == 1:
        return {}
    return {
        "scale": show(point.slope) if "/" not in show(point.slope) else repr(float(point.slope)),
        "output": '"FLOAT64"',
    }


def _length(point: Point) -> dict[str, str]:
    return {"length": str(point.words)} if point.wire.type is WireType.STRING else {}


def _quoted(text: str) -> str:
    """A text as a basic string of TOML, which escapes as JSON does."""
    return json_text(text)
