"""Numbers in ESPHome: sensors with filters, and what can be written as numbers with limits.

Every number is a float of 32 bits. Of a sensor the filters work in their order; of a number a lambda, or `multiply`, by
which the raw number is divided.
"""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.dialects.esphome import SPACES, TYPES
from regscribe.emit.words import one_line, span_words
from regscribe.export.device import Device, Point
from regscribe.export.device.numbers import EXACT_SINGLE, decimal, is_exact, places
from regscribe.export.device.points import Fault
from regscribe.export.device.writes import obstacle, writes_several
from regscribe.export.esphome.items import Item, Keys
from regscribe.export.home_assistant.units import classes
from regscribe.files import Plain, Tagged
from regscribe.losses import Grade
from regscribe.model import Kind, Order, Space, WireType, show

LAST = EXACT_SINGLE - 1
"""The largest limit that the component takes."""

DECIMALS, STEP = 3, Fraction(1, 1000)
"""Shown of a number that may have any decimals, and the step of one that is written."""

LAMBDA = "!lambda"
WRITTEN = frozenset({Kind.NUMBER, Kind.INTEGER, Kind.RAW})


def place(point: Point) -> Keys:
    """The keys of a number that say where it stands and as what."""
    return {"register_type": SPACES[point.wire.space], "address": point.address, **_type(point)}


def _type(point: Point) -> Keys:
    wire = point.wire
    if wire.type is WireType.UINT8:
        return {"value_type": "U_WORD", "bitmask": 0x00FF if wire.bytes is Order.BIG else 0xFF00}
    return {"value_type": TYPES[wire.type, (wire.words, wire.bytes)]}  # type: ignore[index]  # what fits is there


def sensor(device: Device, point: Point) -> Item:
    """A number that is read."""
    device.lose_version(point)
    lose_digits(device, point)
    lose_faults(device, point)
    faults: list[Keys] = [
        {"lambda": Tagged(f"return {_is_fault(one, 'x')} ? NAN : x;", LAMBDA)} for one in _seen(point)
    ]
    scale: list[Keys] = [{"multiply": Plain(decimal(point.slope))}] if point.slope != 1 else []
    offset: list[Keys] = [{"offset": Plain(decimal(point.offset))}] if point.offset else []
    filters: Keys = {"filters": found} if (found := [*faults, *scale, *offset]) else {}
    keys = place(point) | {"accuracy_decimals": _decimals(point)} | unit(point) | filters
    return Item(
        platform="sensor", point=point, label=point.register.name, address=point.address, count=point.words, keys=keys
    )


def _decimals(point: Point) -> int:
    return DECIMALS if point.decimals is None else point.decimals


def unit(point: Point) -> Keys:
    """The unit, and its class where it leaves no doubt."""
    return {"unit_of_measurement": point.unit, **classes(point)} if point.unit else {}


def lose_digits(device: Device, point: Point) -> None:
    """Tell what a float of 32 bits and a decimal scale do not keep."""
    if point.wire.type.is_integer and max(map(abs, point.wire.type.ends)) > EXACT_SINGLE:
        below = ", and from 2^63 on is shown below zero" if point.wire.type is WireType.UINT64 else ""
        done = f"what is beyond 2^24 on the wire loses its last digits{below}"
        device.lose(point.register, "precision-float32", Grade.WRONG, done)
    if not (is_exact(point.slope) and is_exact(point.offset)):
        device.lose(point.register, "scale-rounded", Grade.COSMETIC, "its scale is rounded to a decimal of 17 digits")


def _seen(point: Point) -> list[Fault]:
    """The fault words that are numbers: what is none shows as none by itself."""
    return [one for one in point.faults if one.low is not None]


def lose_faults(device: Device, point: Point) -> None:
    """Tell that a fault word becomes no number, without its label; and what else does where floats are too short."""
    for one in _seen(point):
        words = f"{span_words(show(one.low), show(one.high))} = {one_line(one.label)}"  # type: ignore[arg-type]  # numbers
        device.lose(point.register, "sentinel-label", Grade.LOST, f"no value, without its label: {words}")
        if point.wire.type.is_integer and max(abs(Fraction(one.low or 0)), abs(Fraction(one.high or 0))) > EXACT_SINGLE:
            done = f"no value, as are numbers that a float of 32 bits cannot tell from it: {words}"
            device.lose(point.register, "sentinel", Grade.WRONG, done)


def _is_fault(fault: Fault, raw: str) -> str:
    """The test in C++."""
    low, high = (_float(Fraction(end or 0)) for end in fault[:2])
    return f"{raw} == {low}" if low == high else f"{raw} >= {low} && {raw} <= {high}"


def _float(number: Fraction) -> str:
    text = decimal(number)
    return f"{text}f" if "." in text else f"{text}.0f"


def number(device: Device, point: Point) -> Item | None:
    """A number that is written; None, with the reason told, where it is only read."""
    limits = _limits(point)
    why = "" if point.wire.space is Space.HOLDING else "the component writes holding registers alone"
    why = why or obstacle(point, device.register_map.protocol)
    why = why or ("it is written at another address than it is read at" if point.write != point.address else "")
    why = why or ("" if limits else "its limits are not known as the device is stated")
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
        keys=place(point) | _written(device, point, *limits) | unit_alone(point) | _conversion(point),
    )


def unit_alone(point: Point) -> Keys:
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
    return (least, most) if least < most else None


def _written(device: Device, point: Point, low: Fraction, high: Fraction) -> Keys:
    least, most = max(low, Fraction(-LAST)), min(high, Fraction(LAST))
    if (least, most) != (low, high):
        done = f"written from {show(least)} to {show(most)} only, of {show(low)} to {show(high)}"
        device.lose(point.register, "range", Grade.LOST, done)
    done = "after a write the value that was asked for is shown, refused or not, until the next poll"
    device.lose(point.register, "write-echo", Grade.LOST, done)
    step = STEP if point.wire.type.is_float else abs(point.slope)
    several = writes_several(point, device.register_map.protocol)
    return {
        "min_value": Plain(decimal(least)),
        "max_value": Plain(decimal(most)),
        "step": Plain(decimal(step)),
        **({"use_write_multiple": True} if several and point.words == 1 else {}),
    }


def _conversion(point: Point) -> Keys:
    inverse = 1 / point.slope
    if not point.offset and is_exact(inverse) and not _seen(point):
        return {"multiply": Plain(decimal(inverse))} if inverse != 1 else {}
    faults = "".join(f"if ({_is_fault(one, 'x')}) return NAN; " for one in _seen(point))
    read = f"{faults}return x * {_float(point.slope)} + {_float(point.offset)};"
    write = f"return (x - {_float(point.offset)}) {_divided(point.slope)};"
    return {"lambda": Tagged(read, LAMBDA), "write_lambda": Tagged(write, LAMBDA)}


def _divided(slope: Fraction) -> str:
    return f"* {_float(1 / slope)}" if is_exact(1 / slope) else f"/ {_float(slope)}"


def each_part(device: Device, point: Point) -> Iterator[Item]:
    """Parts of a word that are wider than a bit, as sensors of their own with a mask."""
    for part in point.fields:
        if part.is_flag:
            continue
        said = "its codes have labels" if part.enum else "fault words" if part.sentinels else ""
        if said:
            device.lose(point.register, "fields", Grade.LOST, f"{part.id} is a number: {said}")
        shown = places(part.multiply, part.add)
        keys = place(point) | {"bitmask": ((1 << part.width) - 1) << part.low}
        keys |= {"accuracy_decimals": DECIMALS if shown is None else shown}
        filters = [
            *([{"multiply": Plain(decimal(part.multiply))}] if part.multiply != 1 else []),
            *([{"offset": Plain(decimal(part.add))}] if part.add else []),
        ]
        keys |= {"value_type": UNSIGNED.get(str(keys["value_type"]), keys["value_type"])}
        keys |= {"unit_of_measurement": part.unit} if part.unit else {}
        keys |= {"filters": filters} if filters else {}
        yield Item(
            platform="sensor",
            point=point,
            label=f"{point.register.name} {part.label}",
            address=point.address,
            count=point.words,
            part=part.id,
            keys=keys,
        )


UNSIGNED = {"S_WORD": "U_WORD", "S_DWORD": "U_DWORD", "S_DWORD_R": "U_DWORD_R"}
"""The types by which a mask takes bits without their sign."""
