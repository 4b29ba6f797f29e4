"""Ranges and defaults, and whether they count in stored numbers or in values."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.scales import Scale
from regscribe.model import WireType


@dataclass(frozen=True, slots=True)
class Limits:
    """The lowest and the highest number (None: open), and, where the cell lists single numbers (`0/1`), all of them."""

    low: Fraction | None
    high: Fraction | None
    listed: tuple[Fraction, ...] = ()


@dataclass(frozen=True, slots=True)
class Settled:
    """A range in the unit of the value, and a sentence that says how it was read, if that was not plain."""

    limits: Limits
    stated: str = ""

    @property
    def text(self) -> str:
        """The range as a map has it; empty where a side is open."""
        return ""


def parse_range(text: str, *, comma: bool | None = None) -> Limits | Unclear | None:
    """Read `0..100`, `0 to 100`, `-50~150`, `-10--5`, `[0,100]`, `0/1`, `≥0`; no matter in what it counts."""
    return Unclear(f"{text} {comma}") if text else None


def parse_limits(low: str, high: str, *, comma: bool | None = None) -> Limits | Unclear | None:
    """Read two cells, of the minimum and of the maximum."""
    return Unclear(f"{low} {high} {comma}") if low or high else None


def settle_range(limits: Limits, wire: WireType, scale: Scale) -> Settled | Unclear:
    """The range in the unit of the value: whether it counts stored numbers or values is told by what fits the type."""
    return Settled(limits, f"{wire} {scale}")


def stated_limits(pairs: Sequence[tuple[str, str]]) -> tuple[bool, str]:
    """Whether equal limits (min = max = 0) in a table mean that no range is stated, with the evidence."""
    return False, f"{len(pairs)}"


def parse_number(text: str, *, comma: bool | None = None) -> Fraction | Unclear | None:
    """Read one number, of a default for example."""
    return Unclear(f"{text} {comma}") if text else None
