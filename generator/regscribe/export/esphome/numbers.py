"""Numbers that are written in ESPHome: the raw number divided by `multiply`, or what lambdas make of it and back."""

from fractions import Fraction

from regscribe.export.device import Device, Point
from regscribe.export.device.numbers import EXACT_SINGLE, decimal, is_exact
from regscribe.export.device.places import step_of
from regscribe.export.device.writes import obstacle, writes_several
from regscribe.export.esphome.items import Item, Keys
from regscribe.export.esphome.sensors import (
    LAMBDA,
    faults_of,
    float_text,
    is_fault,
    lose_digits,
    lose_faults,
    place,
    unit,
)
from regscribe.files import Plain, Tagged
from regscribe.losses import Grade
from regscribe.model import Kind, Space, WireType, show

LAST = EXACT_SINGLE - 1
"""The largest limit that the component takes."""

STEP = Fraction(1, 1000)
"""The step of a number that may have any decimals."""

WRITTEN = frozenset({Kind.NUMBER, Kind.INTEGER, Kind.RAW})


def number(device: Device, point: Point) -> Item | None:
    """A number that is written; None, with the reason told, where it is only read."""
    limits = _limits(point)
    why = "" if point.wire.space is Space.HOLDING else "the component writes holding registers alone"
    why = why or obstacle(point, device.register_map.protocol)
    why = why or ("it is written at another address than it is read at" if point.write != point.address else "")
    why = why or ("" if limits else "its limits are not known as the device is stated, or beyond those of ESPHome")
    if why or limits is None or point.register.kind not in WRITTEN or point.wire.type is WireType.UINT8:
        device.lose(point.register, "write", Grade.LOST, f"read only: {why or 'no entity writes such a value'}")
        return None
    lose_digits(device, point)
    lose_faults(device, point)
    return Item(
        platform="number",
        point=point,
        label=point.register.name,
        address=point.address,
        count=point.words,
        keys=place(point) | _written(device, point, *limits) | _unit(point) | _conversion(point),
    )


def _unit(point: Point) -> Keys:
    """The unit of a number, which has no class of what is measured."""
    return {key: value for key, value in unit(point).items() if key != "state_class"}


def _limits(point: Point) -> tuple[Fraction, Fraction] | None:
    """The lowest and the highest value that may be written: what the map says, else what its type carries."""
    if point.ranges is None:
        return None
    kind = point.wire.type
    wire = (Fraction(-LAST), Fraction(LAST)) if kind.is_float else kind.ends
    low, high = sorted(point.slope * end + point.offset for end in wire)
    lows, highs = zip(*point.ranges, strict=True) if point.ranges else ((None,), (None,))
    least, most = min(low if one is None else one for one in lows), max(high if one is None else one for one in highs)
    return (least, most) if max(least, Fraction(-LAST)) < min(most, Fraction(LAST)) else None


def _written(device: Device, point: Point, low: Fraction, high: Fraction) -> Keys:
    least, most = max(low, Fraction(-LAST)), min(high, Fraction(LAST))
    if (least, most) != (low, high):
        done = f"written from {show(least)} to {show(most)} only, of {show(low)} to {show(high)}"
        device.lose(point.register, "range", Grade.LOST, done)
    done = "after a write the value that was asked for is shown, refused or not, until the next poll"
    device.lose(point.register, "write-echo", Grade.LOST, done)
    step = _step(device, point)
    several = writes_several(point, device.register_map.protocol)
    return {
        "min_value": Plain(decimal(least)),
        "max_value": Plain(decimal(most)),
        "step": Plain(decimal(step)),
        **({"use_write_multiple": True} if several and point.words == 1 else {}),
    }


def _step(device: Device, point: Point) -> Fraction:
    """The step that is offered: that of the map where it states one, else that of the number on the wire."""
    stated = step_of(point, device.request.known)
    if stated is not None:
        done = "offered to users: a value between two steps is written as it comes" if stated else "left out"
        device.lose(point.register, "step", Grade.LOST, done)
    if stated:
        return abs(point.slope) * stated
    return STEP if point.wire.type.is_float else abs(point.slope)


def _conversion(point: Point) -> Keys:
    inverse = 1 / point.slope
    if not point.offset and is_exact(inverse) and not faults_of(point):
        return {"multiply": Plain(decimal(inverse))} if inverse != 1 else {}
    faults = "".join(f"if ({is_fault(one)}) return NAN; " for one in faults_of(point))
    read = f"{faults}return x * {float_text(point.slope)} + {float_text(point.offset)};"
    write = f"return (x - {float_text(point.offset)}) {_divided(point.slope)};"
    return {"lambda": Tagged(read, LAMBDA), "write_lambda": Tagged(write, LAMBDA)}


def _divided(slope: Fraction) -> str:
    return f"* {float_text(1 / slope)}" if is_exact(1 / slope) else f"/ {float_text(slope)}"
