"""The lowest and the highest number of a range."""

from dataclasses import dataclass, field
from fractions import Fraction

from regscribe.model import show


@dataclass(frozen=True, slots=True)
class Limits:
    """The lowest and the highest number (None: open), and, where the cell lists single numbers (`0/1`), all of them.

    `has_point`: digits stand behind a point (`50.0`), so it does not count what is stored in whole numbers.
    """

    low: Fraction | None
    high: Fraction | None
    listed: tuple[Fraction, ...] = ()
    has_point: bool = field(default=False, compare=False)

    @property
    def numbers(self) -> tuple[Fraction, ...]:
        """The limits that are not open."""
        return tuple(one for one in (self.low, self.high) if one is not None)

    @property
    def text(self) -> str:
        """The range as a map has it; empty where a side is open."""
        return "" if self.low is None or self.high is None else f"{show(self.low)}..{show(self.high)}"
