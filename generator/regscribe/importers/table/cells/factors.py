"""What a scale is: a factor and what is added, as keys of a register, and what a column of numbers does."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

from regscribe.draft.numbers import MOST_DECIMALS, scaling

__all__ = ["MOST_DECIMALS", "PLAIN", "Scale", "Way"]


class Way(StrEnum):
    """What a bare number in the column does: it multiplies or divides the stored number, or is a number of digits.

    `exponent`: the stored number is multiplied by ten to the power of it.
    """

    MULTIPLY = "multiply"
    DIVIDE = "divide"
    DECIMALS = "decimals"
    EXPONENT = "exponent"


@dataclass(frozen=True, slots=True)
class Scale:
    """The value is the stored number times `multiply`, plus `add`; `unit` stands beside it (`1 = 0.1 A`)."""

    multiply: Fraction = Fraction(1)
    add: Fraction = Fraction(0)
    unit: str = ""

    @property
    def keys(self) -> Mapping[str, Any]:
        """The keys of a register that say it."""
        return scaling(self.multiply, self.add)

    def of(self, stored: Fraction) -> Fraction:
        """The value of a stored number."""
        return stored * self.multiply + self.add

    def back(self, value: Fraction) -> Fraction:
        """The stored number of a value."""
        return (value - self.add) / self.multiply


PLAIN = Scale()
