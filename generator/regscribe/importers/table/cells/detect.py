"""Faults of a table that no single cell shows: doubles, overlaps, widths, ranges and defaults that do not fit."""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise

from regscribe.importers.table.cells.factors import PLAIN, Scale
from regscribe.importers.table.cells.limits import Limits
from regscribe.model import Diagnostic, Related, Severity, Space, Span, WireType, show

RULE = "table"
"""The rule of the findings, as those of sources are called."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """What is known of one row after its cells were read.

    `words` are the addresses that it takes; limits and default are in the unit of the value. `codes` are values with
    names, which are allowed beside the range.
    """

    name: str
    place: Span
    where: str
    space: Space
    at: int
    words: int
    wire: WireType | None = None
    bits: tuple[int, int] | None = None
    limits: Limits | None = None
    default: Fraction | None = None
    scale: Scale = PLAIN
    codes: frozenset[Fraction] = field(default_factory=frozenset)

    @property
    def end(self) -> int:
        """The address behind it."""
        return self.at + self.words

    @property
    def shown(self) -> str:
        """The row for a message: its name and address."""
        return f"`{self.name}` at {self.at}" + (f".{self.bits[0]}" if self.bits else "")


def detect(rows: Sequence[Row]) -> tuple[Diagnostic, ...]:
    """Return the findings, warnings with both places, in the order of the rows."""
    found = [*_doubles(rows), *_overlaps(rows), *_gaps(rows), *(one for row in rows for one in _alone(row))]
    return tuple(sorted(found, key=lambda one: one.span))


def _finding(row: Row, message: str, other: Row | None = None) -> Diagnostic:
    said = f"{row.where}: {message}" if row.where else message
    related: tuple[Related, ...] = ()
    if other:
        related = (Related(f"{other.shown}" + (f", {other.where}" if other.where else ""), other.place),)
    return Diagnostic(RULE, said, row.place, severity=Severity.WARNING, related=related)


def _share_bits(one: Row, two: Row) -> bool:
    """Whether two rows at one address are about the same bits; a whole word beside its bits is not a double."""
    if one.bits and two.bits:
        return one.bits[0] <= two.bits[1] and two.bits[0] <= one.bits[1]
    return not one.bits and not two.bits


def _doubles(rows: Sequence[Row]) -> Iterator[Diagnostic]:
    """Two rows for one address."""
    at: dict[tuple[Space, int], list[Row]] = defaultdict(list)
    for row in rows:
        here = at[row.space, row.at]
        if first := next((one for one in here if _share_bits(one, row)), None):
            yield _finding(row, f"{row.shown} is there twice, the first is {first.shown}", first)
        here.append(row)


def _in_order(rows: Sequence[Row]) -> Iterator[list[Row]]:
    """The whole registers of each space, by address, one of each address."""
    spaces: dict[Space, dict[int, Row]] = defaultdict(dict)
    for row in rows:
        if not row.bits:
            spaces[row.space].setdefault(row.at, row)
    for here in spaces.values():
        yield [here[at] for at in sorted(here)]


def _overlaps(rows: Sequence[Row]) -> Iterator[Diagnostic]:
    """A register of several words that reaches into a later one."""
    for ordered in _in_order(rows):
        longest: Row | None = None
        for row in ordered:
            if longest and row.at < longest.end:
                message = f"{row.shown} lies inside {longest.shown}, which takes {longest.at}..{longest.end - 1}"
                yield _finding(row, message, longest)
            longest = row if longest is None or row.end > longest.end else longest


MOST_WORDS = 4
"""The words of the widest number; a gap beyond it says nothing of widths."""

ENOUGH = 3


def _gaps(rows: Sequence[Row]) -> Iterator[Diagnostic]:
    """A number narrower than the distance to the next row, where all others of its type stand as close as they can."""
    gaps: dict[WireType, list[tuple[Row, Row]]] = defaultdict(list)
    for ordered in _in_order(rows):
        for row, after in pairwise(ordered):
            if row.wire and not row.wire.is_octets and not row.space.is_bits:
                gaps[row.wire].append((row, after))
    for wire, pairs in gaps.items():
        wide = [(row, after) for row, after in pairs if after.at - row.at == 2 * wire.words <= MOST_WORDS]
        if len(pairs) >= ENOUGH and len(wide) == len(pairs):
            row, after = wide[0]
            yield _finding(
                row,
                f"each of the {len(pairs)} {wire} has {2 * wire.words} addresses up to the next row, twice what it "
                "takes: perhaps the type is wider than it is called",
                after,
            )


def _alone(row: Row) -> Iterator[Diagnostic]:
    """What a row says against itself."""
    if row.bits and row.bits[1] >= BITS:
        yield _finding(row, f"{row.shown} names bit {row.bits[1]}, and a register has bits 0 to {BITS - 1}")
    if row.limits and row.limits.low is not None and row.limits.high is not None and row.limits.low > row.limits.high:
        yield _finding(row, f"the minimum {show(row.limits.low)} of {row.shown} is above {show(row.limits.high)}")
    if row.limits and row.default is not None and row.default not in row.codes and not _inside(row.default, row.limits):
        yield _finding(row, f"the default {show(row.default)} of {row.shown} is outside its range {_range(row.limits)}")
    yield from _unfit(row)


def _unfit(row: Row) -> Iterator[Diagnostic]:
    """Limits and a default that the type cannot carry."""
    if row.wire is None or not row.wire.is_integer:
        return
    low, high = row.wire.ends
    named = [("the minimum", row.limits.low), ("the maximum", row.limits.high)] if row.limits else []
    for what, value in [*named, ("the default", row.default)]:
        if value is not None and not low <= row.scale.back(value) <= high:
            ends = sorted((row.scale.of(low), row.scale.of(high)))
            yield _finding(
                row,
                f"{what} {show(value)} of {row.shown} does not fit its {row.wire}: {show(ends[0])}..{show(ends[1])}",
            )


BITS = 16


def _inside(value: Fraction, limits: Limits) -> bool:
    return (limits.low is None or value >= limits.low) and (limits.high is None or value <= limits.high)


def _range(limits: Limits) -> str:
    low, high = ("" if one is None else show(one) for one in (limits.low, limits.high))
    return f"{low}..{high}"
