"""The exporter of a poll by collectd's modbus plugin, of one model of one map (docs/export.md is its contract).

The plugin reads a number at a fixed address with a fixed type, scale and shift, each by a request of its own.
"""

from collections.abc import Iterator, Mapping, Sequence

from regscribe.emit.words import one_line, sentinel_words
from regscribe.export.device import RESOLVED, Carries, Carry, Device, Point, Request, Target, Wire, exported
from regscribe.export.device.numbers import decimal, is_exact
from regscribe.export.device.options import DEVICE_OPTIONS, EIGHT_N_ONE
from regscribe.losses import Exported, Grade, Loss
from regscribe.model import Kind, Order, RegisterMap, Space, WireType

name = "collectd"
summary = "a configuration of collectd's modbus plugin that polls one model"
options = DEVICE_OPTIONS

SPACES = {Space.HOLDING: "ReadHolding", Space.INPUT: "ReadInput"}
TYPES = {
    WireType.INT16: "Int16",
    WireType.UINT16: "Uint16",
    WireType.INT32: "Int32",
    WireType.UINT32: "Uint32",
    WireType.FLOAT32: "Float",
    WireType.INT64: "Int64",
    WireType.UINT64: "Uint64",
}
"""What the plugin calls a type whose most significant word comes first."""

SWAPPED = frozenset({WireType.INT32, WireType.UINT32, WireType.FLOAT32})
"""Types that it also has with the least significant word first, by `LE` behind the name."""

LONGEST_NAME = 127
"""collectd cuts longer names off."""

carries: Carries = RESOLVED | dict.fromkeys(("scale", "offset", "limits"), Carry.WHOLE)


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.bytes is not Order.BIG or wire.space not in SPACES or wire.type not in TYPES:
        return False
    return wire.words is Order.BIG or (wire.words is Order.LITTLE and wire.type in SWAPPED)


def _refuses(point: Point, request: Request) -> str:
    too_long = len(_called(request.name, point)) > LONGEST_NAME
    return f"its name has more than {LONGEST_NAME} characters" if too_long else ""


TARGET = Target(name=name, carries=carries, fits=_fits, refuses=_refuses, verified="collectd 5.12")


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the configuration. Raises OptionError."""
    return exported(TARGET, maps, options, collectd_text)


def collectd_text(device: Device) -> str:
    """Return the configuration: one `Data` block for each number, one `Host` that collects them all.

    What is no number for the plugin, or cannot be worked out, stands in a comment with the reason.
    """
    lines: list[str] = []
    for one in device.each():
        if isinstance(one, Loss):
            lines.append(f"  # {one.done.replace(':', f': {one.register} -', 1)}")
        else:
            lines += _data(device, one)
    head = [f"# {line}" for line in device.heading]
    return "\n".join([*head, "LoadPlugin modbus", "<Plugin modbus>", *lines, *_host(device), "</Plugin>"]) + "\n"


def _data(device: Device, point: Point) -> Iterator[str]:
    register, wire = point.register, point.wire
    yield f"  <Data {_quoted(_called(device.name, point))}>"
    yield from (f"    # no value: {one_line(sentinel_words(each))}" for each in register.sentinels)
    if register.kind is Kind.RAW:
        yield "    # the manual does not state the scale"
    yield f"    RegisterBase {point.address}"
    yield f"    RegisterType {TYPES[wire.type]}{'LE' if wire.words is Order.LITTLE else ''}"
    yield f"    RegisterCmd {SPACES[wire.space]}"
    yield '    Type "gauge"'
    yield f"    Instance {_quoted(point.id)}"
    if point.slope != 1:
        yield f"    Scale {decimal(point.slope)}"
    if point.offset:
        yield f"    Shift {decimal(point.offset)}"
    yield "  </Data>"
    if not (is_exact(point.slope) and is_exact(point.offset)):
        device.lose(register, "scale-rounded", Grade.COSMETIC, "its scale is rounded to a decimal of 17 digits")


def _host(device: Device) -> Iterator[str]:
    place = device.place
    yield f"  <Host {_quoted(device.name)}>"
    if place.device:
        yield f"    Device {_quoted(place.device)}"
        yield f"    Baudrate {place.baud}"
        if place.format != EIGHT_N_ONE:
            done = (
                f"the plugin speaks {EIGHT_N_ONE} only, and the line of the map is {place.format}: set the device to it"
            )
            device.lose("", "serial-line", Grade.WRONG, done)
    else:
        yield f"    Address {_quoted(place.host)}"
        yield f'    Port "{place.port}"'
    yield f"    Interval {device.request.every}"
    yield f"    <Slave {place.unit}>"
    yield from (f"      Collect {_quoted(_called(device.name, point))}" for point in device.points)
    yield "    </Slave>"
    yield "  </Host>"


def _called(device: str, point: Point) -> str:
    """The name of its block: the plugin knows one set of blocks for all hosts."""
    return f"{device}.{point.id}"


def _quoted(text: str) -> str:
    escaped = one_line(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
