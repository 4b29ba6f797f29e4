"""Numbers that are read in ESPHome: sensors with filters, which work in their order. Each is a float of 32 bits."""

from fractions import Fraction

from regscribe.dialects.esphome import SPACES, TYPES
from regscribe.emit.words import one_line, sentinel_words, span_words
from regscribe.export.device import Device, Point
from regscribe.export.device.numbers import EXACT_SINGLE, decimal, is_exact, places
from regscribe.export.esphome.items import Item, Keys
from regscribe.export.home_assistant.units import classes
from regscribe.files import Plain, Tagged
from regscribe.losses import Grade
from regscribe.model import BitField, Number, Order, WireType, show

DECIMALS = 3
"""Shown of a number that may have any decimals."""

LAMBDA = "!lambda"

UNSIGNED = {"S_WORD": "U_WORD", "S_DWORD": "U_DWORD", "S_DWORD_R": "U_DWORD_R"}
"""The types by which a mask takes bits without their sign."""

Span = tuple[Number, Number]
"""The first and the last raw number that report a fault."""


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
    shown = {"accuracy_decimals": DECIMALS if point.decimals is None else point.decimals}
    keys = place(point) | shown | unit(point) | _filters(faults_of(point), point.slope, point.offset)
    label = point.register.name
    return Item(platform="sensor", point=point, label=label, address=point.address, count=point.words, keys=keys)


def _filters(faults: list[Span], multiply: Fraction, add: Fraction) -> Keys:
    """First what is no value, by the raw number, then the scale."""
    found: list[Keys] = [{"lambda": Tagged(f"return {is_fault(one)} ? NAN : x;", LAMBDA)} for one in faults]
    if multiply != 1:
        found.append({"multiply": Plain(decimal(multiply))})
    if add:
        found.append({"offset": Plain(decimal(add))})
    return {"filters": found} if found else {}


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


def faults_of(point: Point) -> list[Span]:
    """The fault words that are numbers: what is none shows as none by itself."""
    return [(one.low, one.high) for one in point.faults if one.low is not None and one.high is not None]


def lose_faults(device: Device, point: Point) -> None:
    """Tell that a fault word becomes no number, without its label; and what else does where floats are too short."""
    for one in point.faults:
        if one.low is None or one.high is None:
            continue
        words = f"{span_words(show(one.low), show(one.high))} = {one_line(one.label)}"
        device.lose(point.register, "sentinel-label", Grade.LOST, f"no value, without its label: {words}")
        if point.wire.type.is_integer and max(abs(Fraction(one.low)), abs(Fraction(one.high))) > EXACT_SINGLE:
            done = f"no value, as are numbers that a float of 32 bits cannot tell from it: {words}"
            device.lose(point.register, "sentinel", Grade.WRONG, done)


def is_fault(fault: Span, raw: str = "x") -> str:
    """The test in C++."""
    low, high = (float_text(Fraction(end)) for end in fault)
    return f"{raw} == {low}" if low == high else f"{raw} >= {low} && {raw} <= {high}"


def float_text(number: Fraction) -> str:
    """A number in C++."""
    text = decimal(number)
    return f"{text}f" if "." in text else f"{text}.0f"


def part_of(device: Device, point: Point, part: BitField) -> Item:
    """A part of a word that is wider than a bit, as a sensor of its own with a mask."""
    if part.enum:
        device.lose(point.register, "fields", Grade.LOST, f"{part.id} is a number: its codes have labels")
    for one in part.sentinels:
        done = f"{part.id} has no value, without a label: {one_line(sentinel_words(one))}"
        device.lose(point.register, "sentinel-label", Grade.LOST, done)
    shown = places(part.multiply, part.add)
    whole = place(point)
    keys: Keys = {
        **whole,
        "bitmask": ((1 << part.width) - 1) << part.low,
        "accuracy_decimals": DECIMALS if shown is None else shown,
        "value_type": UNSIGNED.get(str(whole["value_type"]), whole["value_type"]),
        **({"unit_of_measurement": part.unit} if part.unit else {}),
        **_filters([one.ends for one in part.sentinels if one.ends], part.multiply, part.add),
    }
    label, count = f"{point.register.name} {part.label}", point.words
    return Item(
        platform="sensor", point=point, label=label, address=point.address, count=count, part=part.id, keys=keys
    )
