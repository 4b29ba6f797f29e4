"""One point of a configuration as it was understood, and the keys of the register that it becomes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from regscribe.dialects import ABCD, Orders
from regscribe.draft import Entry, Remark
from regscribe.draft.numbers import plain, scaling, unscaled
from regscribe.files import OneLine
from regscribe.model import Order, Space, Span, WireType
from regscribe.model.units import meant_unit

MOST_NAME = 120
MOST_ADDRESSES = 0x10000
ONE_WORD = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """A number, text or bit somewhere in a device.

    `words` is the length of a text or of bits in several words; `bits` are the first and last bit of the part that is
    meant, of a word that is `type`. `multiply` None: the scale is unclear. `more` are further keys of the register, in
    the words of the language. `count` above 1: so many one behind the other.
    """

    name: str
    place: Span
    at: int
    space: Space = Space.HOLDING
    type: WireType = WireType.UINT16
    orders: Orders = ABCD
    words: int = 0
    bits: tuple[int, int] | None = None
    multiply: Fraction | None = Fraction(1)
    add: Fraction = Fraction(0)
    unit: str = ""
    access: str = "r"
    more: Mapping[str, Any] = field(default_factory=dict)
    remarks: tuple[Remark, ...] = ()
    group: str = "Registers"
    count: int = 1

    @property
    def length(self) -> int:
        """How many addresses one of it takes."""
        return self.words or self.type.words

    @property
    def stretch(self) -> tuple[Space, int, int]:
        """The space, the first address, and the one behind the last."""
        return self.space, self.at, self.at + self.length * self.count

    @property
    def addresses(self) -> tuple[int, ...]:
        """Every address that it takes; those of words apart stand in `more`."""
        apart = self.more.get("at")
        if isinstance(apart, list):
            return tuple(sorted(apart))
        _, first, end = self.stretch
        return tuple(range(first, min(end, first + MOST_ADDRESSES)))

    @property
    def symbol(self) -> str:
        """The unit as the language writes it; as it is, where it is not known."""
        text = " ".join(self.unit.split())
        return meant_unit(text) or text

    @property
    def facts(self) -> tuple[object, ...]:
        """Where and how its number stands, and what it means."""
        return self.addresses, self.type, self.orders, self.more.get("byte"), self.bits, self.multiply, self.add


def keys_of(point: Point) -> dict[str, Any]:
    """Return the keys of the register that a point becomes, without its part of a word."""
    keys: dict[str, Any] = {"at": point.at, "name": named(point.name), "access": point.access}
    if point.space is not Space.HOLDING:
        keys["space"] = point.space.value
    if not point.space.is_bits:
        keys |= _form(point)
    keys |= scaling(point.multiply or Fraction(1), point.add)
    keys |= {"unit": point.symbol} if point.symbol else {}
    keys |= point.more
    return unscaled(keys) if point.multiply is None else keys


def _form(point: Point) -> dict[str, Any]:
    keys: dict[str, Any] = {} if point.type is WireType.UINT16 else {"type": point.type.value}
    if point.words and (point.type.is_octets or point.words != point.type.words):
        keys["length"] = point.words
    word, byte = point.orders
    if word is Order.LITTLE and point.length > ONE_WORD:
        keys["word_order"] = word.value
    if byte is Order.LITTLE:
        keys["byte_order"] = byte.value
    return keys


def named(name: str) -> str:
    """A name as a map can have it: on one line, not endless, never empty."""
    return " ".join(name.split())[:MOST_NAME] or "unnamed"


def entry_of(point: Point) -> Entry:
    """Return the entry of a point; an array where there are several of it."""
    keys = keys_of(point)
    if point.count == 1:
        return Entry(name=point.name, place=point.place, keys=keys, remarks=point.remarks, group=point.group)
    member = Entry(name=point.name, place=point.place, keys={**keys, "name": "Value"}, group=point.group)
    array = {"name": keys["name"], "repeat": f"1..{point.count}", "stride": point.length}
    return Entry(
        name=point.name, place=point.place, keys=array, remarks=point.remarks, group=point.group, members=(member,)
    )


def field_of(point: Point) -> OneLine:
    """Return the bit field that a point with `bits` becomes."""
    low, high = point.bits or (0, 0)
    keys: dict[str, Any] = {"bit": low} if low == high else {"bits": f"{low}..{high}"}
    keys["label"] = named(point.name)
    if point.multiply not in {None, 1}:
        keys["multiply"] = plain(point.multiply or Fraction(1))
    if point.add:
        keys["add"] = plain(point.add)
    if point.multiply is None:  # a raw number, which has neither unit nor limits in one
        return OneLine(keys | {key: value for key, value in point.more.items() if key in {"description", "when"}})
    keys |= {"unit": point.symbol} if point.symbol else {}
    return OneLine(keys | {key: value for key, value in point.more.items() if key in OF_FIELDS})


OF_FIELDS = frozenset({"enum", "range", "valid", "sentinels", "description", "when"})
"""Further keys of a register that a bit field has as well."""


def lost_in_fields(points: Sequence[Point]) -> list[tuple[Remark, ...]]:
    """Return for each point with `bits` the remarks on keys that no bit field has."""
    return [
        tuple(
            Remark(f"{key.replace('_', '-')}-dropped", f"{key} `{value}`: a part of a word cannot have it")
            for key, value in point.more.items()
            if key not in OF_FIELDS
        )
        for point in points
    ]
