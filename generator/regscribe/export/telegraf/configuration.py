"""The configuration: a connection, its limits, a block of metrics for each order and unit, and what adds offsets."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from regscribe.dialects.telegraf import BIT, BYTES, LOCATIONS, ORDERS, SPACES, TYPES
from regscribe.export.device import Device, Point, Wire
from regscribe.export.device.names import Names
from regscribe.export.device.numbers import decimal, is_exact
from regscribe.losses import Grade
from regscribe.model import BitField, Kind, Order, Space, WireType, show
from regscribe.visible import json_text

Field = dict[str, str]

WORD = 16
EXACT_BITS = 53
"""A whole number of more bits loses some of them in the double that a scale makes of it."""


@dataclass(frozen=True, slots=True)
class _Fields:
    """Makes the fields of a device; collects the `further` factor and summand where the plug-in has none."""

    device: Device
    names: Names = field(default_factory=Names)
    further: dict[tuple[Fraction, Fraction], list[str]] = field(default_factory=dict)

    def of(self, point: Point) -> Iterator[Field]:
        """Yield the fields of a point: its number or text, and each of its flags."""
        start = {"register": _quoted(SPACES[point.wire.space]), "address": str(point.address)}
        if point.wire.space.is_bits:
            name = self.names.give(point.id)
            if point.is_scaled:
                self.further.setdefault((point.slope, point.offset), []).append(name)
            yield start | {"name": _quoted(name)}
            return
        flags = [one for one in point.fields if one.is_flag]
        if len(flags) < len(point.fields) or not point.fields:
            yield start | self._value(point)
        for flag in flags:
            name = self.names.give(f"{point.id}_{flag.id}")
            yield start | _bit(point, flag) | {"name": _quoted(name), "type": _quoted(BIT)}

    def _value(self, point: Point) -> Field:
        name = self.names.give(point.id)
        if point.offset:
            self.further.setdefault((Fraction(1), point.offset), []).append(name)
        kind = {"name": _quoted(name), "type": _quoted(byte_type(point.wire) or TYPES[point.wire.type])}
        return kind | _scale(self.device, point) | _length(point)


def configuration(device: Device) -> str:
    """Return the text; one connection for each place of texts in words, which a connection has one of."""
    by_location: dict[str, list[Point]] = {"": []}
    for point in device.points:
        is_text = point.wire.type is WireType.STRING
        by_location.setdefault(point.register.text.per_register if is_text else "", []).append(point)
    fields = _Fields(device)
    lines = [f"# {line}" for line in device.heading]
    for location, points in by_location.items():
        if points:
            lines += ["", *_connection(device, location), *_blocks(device, points, fields)]
    return "\n".join([*lines, *_processor(device, fields.further)]) + "\n"


def _connection(device: Device, location: str) -> Iterator[str]:
    yield "[[inputs.modbus]]"
    yield f"  name = {_quoted(device.name)}"
    yield f'  interval = "{device.request.every}s"'
    yield from _line(device)
    yield '  configuration_type = "metric"'
    protocol = device.register_map.protocol
    words = min(protocol.most_read(space) for space in (Space.HOLDING, Space.INPUT))
    bits = min(protocol.most_read(space) for space in (Space.COIL, Space.DISCRETE))
    workarounds = {
        "string_register_location": _quoted(LOCATIONS[location]) if location else "",
        "max_word_registers_per_request": str(words) if words < Space.HOLDING.most else "",
        "max_bit_registers_per_request": str(bits) if bits < Space.COIL.most else "",
        "pause_between_requests": f'"{show(protocol.pause)}ms"' if protocol.pause else "",
    }
    said = [f"    {key} = {value}" for key, value in workarounds.items() if value]
    yield from (["  [inputs.modbus.workarounds]", *said] if said else [])


def _line(device: Device) -> Iterator[str]:
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


def _blocks(device: Device, points: Sequence[Point], fields: _Fields) -> Iterator[str]:
    found: dict[tuple[str, str], list[Field]] = {}
    for point in points:
        found.setdefault((_order(point), point.unit), []).extend(fields.of(point))
    for (order, unit), some in found.items():
        if some:
            yield from _block(device, order, unit, some)


def _block(device: Device, order: str, unit: str, fields: Sequence[Field]) -> Iterator[str]:
    yield ""
    yield "  [[inputs.modbus.metric]]"
    yield f"    slave_id = {device.request.unit}"
    yield f'    byte_order = "{order}"'
    yield f"    measurement = {_quoted(device.model.class_name)}"
    yield "    fields = ["
    yield from (f"      {{ {', '.join(f'{key} = {value}' for key, value in field.items())} }}," for field in fields)
    yield "    ]"
    if unit:
        yield "    [inputs.modbus.metric.tags]"
        yield f"      unit = {_quoted(unit)}"


def _order(point: Point) -> str:
    """The order of a block that has the point; of what stands in one byte or bit none counts."""
    wire = point.wire
    if wire.space.is_bits or not isinstance(wire.words, Order) or not isinstance(wire.bytes, Order) or byte_type(wire):
        return ORDERS[Order.BIG, Order.BIG]
    return ORDERS[wire.words, wire.bytes]


def byte_type(wire: Wire) -> str:
    """The type of a value in one byte of a word; empty for others."""
    which = "high" if wire.bytes is Order.LITTLE else "low"
    return next((word for word, one in BYTES.items() if one == (wire.type, which)), "")


def _bit(point: Point, flag: BitField) -> Field:
    """Where a flag is: the plug-in takes a bit of one word, and turns its bytes as its block says."""
    word, bit = divmod(flag.low, WORD)
    from_first = word if point.wire.words is Order.LITTLE else point.words - 1 - word
    shift = WORD // 2 if byte_type(point.wire).endswith("H") else 0
    return {"address": str(point.address + from_first), "bit": str(bit + shift)}


def _scale(device: Device, point: Point) -> Field:
    if point.register.kind is Kind.BOOLEAN:
        device.lose(point.register, "truth-of-words", Grade.LOST, "any other number is told as it is")
    for number in (point.slope, point.offset):
        if not is_exact(number):
            device.lose(point.register, "scale-rounded", Grade.COSMETIC, f"{decimal(number)} for {show(number)}")
    if point.is_scaled and point.wire.type.is_integer and point.wire.type.bits > EXACT_BITS:
        done = f"a double has the scaled number: of more than {EXACT_BITS} bits the last digits are lost"
        device.lose(point.register, "precision-float64", Grade.LOST, done)
    return {} if point.slope == 1 else {"scale": _float(point.slope), "output": '"FLOAT64"'}


def _processor(device: Device, further: dict[tuple[Fraction, Fraction], list[str]]) -> Iterator[str]:
    """Yield the processor that scales fields of this measurement and adds numbers to them."""
    if not further:
        return
    yield ""
    yield "[[processors.scale]]"
    yield f"  namepass = [{_quoted(device.model.class_name)}]"
    for (factor, offset), names in further.items():
        yield "  [[processors.scale.scaling]]"
        yield f"    factor = {_float(factor)}"
        yield f"    offset = {_float(offset)}"
        yield f"    fields = [{', '.join(map(_quoted, names))}]"


def _float(number: Fraction) -> str:
    """A float of TOML, which a whole number is not."""
    text = decimal(number)
    return text if "." in text else f"{text}.0"


def _length(point: Point) -> Field:
    return {"length": str(point.words)} if point.wire.type is WireType.STRING else {}


def _quoted(text: str) -> str:
    """A text as a basic string of TOML, which escapes as JSON does."""
    return json_text(text)
