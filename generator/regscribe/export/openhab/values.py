"""What the binding reads and writes of a register: places of data, types, gains, and why something is read only."""

from fractions import Fraction
from typing import NamedTuple

from regscribe.export.device import Point, Wire
from regscribe.export.device.places import places_of
from regscribe.export.device.writes import obstacle
from regscribe.model import Kind, Order, Space, WireType
from regscribe_runtime.values.protocol import Protocol

SPACES = {Space.HOLDING: "holding", Space.INPUT: "input", Space.COIL: "coil", Space.DISCRETE: "discrete"}
BYTES = {WireType.UINT8: "uint8", WireType.INT8: "int8"}
SWAPPED = 2
"""The least words of a type that also comes with the least significant word first."""

FLAGGED = frozenset({Kind.FLAGS, Kind.FIELDS})
SWITCHED = frozenset({Kind.BOOLEAN})
WRITTEN = frozenset({Kind.NUMBER, Kind.INTEGER, Kind.RAW, Kind.ENUM, Kind.BOOLEAN})


class Datum(NamedTuple):
    """What one data thing reads: the text of its place, its type, and the channel of its value.

    `suffix` is the id of a bit, which has a thing of its own, and `label` its label.
    """

    start: str
    type: str
    channel: str
    suffix: str = ""
    label: str = ""


def fits(wire: Wire) -> bool:
    """Whether the binding reads what stands on the wire so."""
    if wire.apart or wire.space not in SPACES:
        return False
    return wire.space.is_bits or wire.type in BYTES or bool(_type(wire))


def _type(wire: Wire) -> str:
    """The value type of registers; empty where the binding has none."""
    if wire.bytes is not Order.BIG or not isinstance(wire.words, Order):
        return ""
    turned = "_swap" if wire.words is Order.LITTLE and wire.type.words >= SWAPPED else ""
    if wire.type is WireType.FLOAT32:
        return f"float32{turned}"
    if not (wire.type.is_integer and wire.type.code) or wire.type is WireType.BIT:
        return ""
    return f"{'int' if wire.type.minimum < 0 else 'uint'}{wire.type.bits}{turned}"


def data_of(point: Point) -> list[Datum]:
    """Return what is read of a register: its value, or each of its named bits."""
    wire, kind = point.wire, point.register.kind
    if wire.space.is_bits:
        return [Datum(str(point.address), "bit", "switch" if kind in SWITCHED else "number")]
    bits = [
        Datum(_bit(point, field.low), "bit", "switch", field.id, field.label)
        for field in point.fields
        if kind in FLAGGED and field.is_flag
    ]
    if kind is Kind.FLAGS and bits:
        return bits
    channel = "switch" if kind in SWITCHED else "number"
    if wire.type in BYTES:
        return [Datum(f"{point.address}.{int(wire.bytes is Order.LITTLE)}", BYTES[wire.type], channel), *bits]
    return [Datum(str(point.address), _type(wire), channel), *bits]


def _bit(point: Point, bit: int) -> str:
    """A bit of a value as register and bit of the register, the least significant being 0."""
    places = places_of(point)
    place = places[len(places) - 1 - bit // 8]
    return f"{point.address + place // 2}.{bit % 8 + (0 if place % 2 else 8)}"


def write_type(point: Point) -> str:
    """Return the type by which a value is written; the binding has no unsigned ones, and their bits are the same."""
    return _type(point.wire).replace("uint", "int")


def is_finite(number: Fraction) -> bool:
    """Whether a number has a finite decimal."""
    rest = number.denominator
    for prime in (2, 5):
        while rest % prime == 0:
            rest //= prime
    return rest == 1


def before_gain(point: Point) -> Fraction:
    """Return what is added to the number on the wire before it is multiplied."""
    return point.offset / point.slope


def why_read_only(protocol: Protocol, point: Point) -> str:
    """Return why a register that can be written is read only here; empty if it is not."""
    register = point.register
    reasons = {
        f"the items do not write a value of the kind {register.kind}": register.kind not in WRITTEN,
        (why := obstacle(point, protocol)): bool(why),
        "the binding does not write single bytes": point.wire.type in BYTES,
        "its scale has no finite decimal": not is_finite(point.slope) or not is_finite(before_gain(point)),
        "dividing by its scale has no finite decimal, at which the profile fails": not is_finite(1 / point.slope),
    }
    return next((why for why, holds in reasons.items() if holds), "")
