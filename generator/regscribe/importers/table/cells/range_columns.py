"""A column of ranges: whether they count stored numbers or values, told by what fits the types."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import NamedTuple

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.factors import PLAIN, Scale
from regscribe.importers.table.cells.limits import Limits
from regscribe.model import WireType, show

STORED, VALUE = "stored", "value"
"""What a range may count."""


class Ranged(NamedTuple):
    """The range of a row as it is printed, and the type and scale of the row."""

    limits: Limits
    wire: WireType
    scale: Scale


@dataclass(frozen=True, slots=True)
class Settled:
    """A range in the unit of the value, and a sentence that says how it was read, if that was not plain."""

    limits: Limits
    stated: str = ""


@dataclass(frozen=True, slots=True)
class RangeColumn:
    """The ranges of all rows (None: none stands), and, in a sentence, what those count that may count either."""

    evidence: str
    cells: tuple[Settled | Unclear | None, ...]


def settle_ranges(rows: Sequence[Ranged | None], *, counts: str = "") -> RangeColumn:
    """Turn printed ranges into those of values.

    A range may count what is stored or the value; rows in which only one of these fits the type decide for the others,
    if they agree. `counts` is what the user says: `stored` or `value`. What fits in no way is unclear.
    """
    scaled = [row for row in rows if row and row.scale != PLAIN]
    stored = [row for row in scaled if _fits(row, stored=True) and not _fits(row, stored=False)]
    values = [row for row in scaled if _fits(row, stored=False) and not _fits(row, stored=True)]
    rule, evidence = _rule(len(stored), len(values), counts)
    return RangeColumn(evidence, tuple(_settled(row, rule) if row else None for row in rows))


def settle_range(limits: Limits, wire: WireType, scale: Scale) -> Settled | Unclear:
    """A range alone, in the unit of the value: what it counts is told by what fits the type."""
    return _settled(Ranged(limits, wire, scale), "")


def _rule(stored: int, values: int, counts: str) -> tuple[str, str]:
    if counts:
        return counts, f"ranges count {'stored numbers' if counts == STORED else 'values'}, as the user says"
    if stored and not values:
        return STORED, f"ranges count stored numbers, as {_fitting(stored)} in no other way"
    if values and not stored:
        return VALUE, f"ranges count values, as {_fitting(values)} in no other way"
    return "", ""


def _fitting(count: int) -> str:
    return "1 of them fits its type" if count == 1 else f"{count} of them fit their types"


def _fits(row: Ranged, *, stored: bool) -> bool:
    """Whether the type carries the limits, read as stored numbers or as values."""
    if row.wire.is_octets or (stored and row.limits.has_point and not row.wire.is_float):
        return False
    numbers = row.limits.numbers if stored else tuple(map(row.scale.back, row.limits.numbers))
    if row.wire.is_float:
        return True
    low, high = row.wire.ends
    return all(low <= one <= high and (one - low) % _unit(row.wire) == 0 for one in numbers)


def _unit(wire: WireType) -> Fraction:
    return Fraction(1, 1 << wire.fraction)


def _settled(row: Ranged, rule: str) -> Settled | Unclear:
    as_stored, as_value = _fits(row, stored=True), _fits(row, stored=False)
    if not as_stored and not as_value:
        return _no_fit(row)
    value = _scaled(row.limits, row.scale)
    if row.scale == PLAIN or value == row.limits:
        return Settled(row.limits)
    if as_stored and as_value and not rule:
        return Unclear(f"{_what(row.limits)} may count values, or stored numbers: then it is {_shown(value)}")
    if (rule if as_stored and as_value else STORED if as_stored else VALUE) == VALUE:
        return Settled(row.limits)
    return Settled(value, f"{_what(row.limits)} counts stored numbers, {_shown(value)} in values")


def _no_fit(row: Ranged) -> Unclear:
    if row.wire.is_octets:
        return Unclear(f"a {row.wire} has no range such as {_shown(row.limits)}")
    low, high = row.wire.ends
    return Unclear(f"{_what(row.limits)} does not fit the type {row.wire}, which goes from {show(low)} to {show(high)}")


def _scaled(limits: Limits, scale: Scale) -> Limits:
    low, high = (None if one is None else scale.of(one) for one in (limits.low, limits.high))
    listed = tuple(map(scale.of, limits.listed))
    if scale.multiply < 0:
        low, high = high, low
    return replace(limits, low=low, high=high, listed=listed)


def _what(limits: Limits) -> str:
    return f"{'the number' if limits.low == limits.high else 'the range'} {_shown(limits)}"


def _shown(limits: Limits) -> str:
    if limits.low is not None and limits.low == limits.high:
        return show(limits.low)
    return f"{'' if limits.low is None else show(limits.low)}..{'' if limits.high is None else show(limits.high)}"
