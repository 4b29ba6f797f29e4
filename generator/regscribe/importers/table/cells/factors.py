"""What a scale is: a factor and what is added, as keys of a register, and what a column of numbers does."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

from regscribe.model import exact, show

MOST_DECIMALS = 18
"""As the language has it."""


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
        """The keys of a register that say it: `decimals` for powers of ten, else `multiply` or `divide`; and `add`.

        What `add` adds would be divided by `decimals` as well, so beside it a power of ten is multiplied by.
        """
        if not self.add:
            return _factor_keys(self.multiply)
        factor = {} if self.multiply == 1 else {"multiply": plain_number(self.multiply)}
        return {**factor, "add": plain_number(self.add)}

    def of(self, stored: Fraction) -> Fraction:
        """The value of a stored number."""
        return stored * self.multiply + self.add

    def back(self, value: Fraction) -> Fraction:
        """The stored number of a value."""
        return (value - self.add) / self.multiply


PLAIN = Scale()


def plain_number(value: Fraction) -> Any:  # noqa: ANN401 - a number of YAML, or the text of a fraction
    """A number as YAML has it, so that it reads back exactly; a text `1/3` where no decimal is exact."""
    if value.denominator == 1:
        return value.numerator
    near = float(value)
    return near if exact(near) == value else f"{value.numerator}/{value.denominator}"


_DECIMALS = {Fraction(10) ** -digits: digits for digits in range(-MOST_DECIMALS, MOST_DECIMALS + 1)}
"""Digits behind the point by the factor that they are."""


def _factor_keys(factor: Fraction) -> dict[str, Any]:
    if factor == 1:
        return {}
    if (digits := _DECIMALS.get(factor)) is not None:
        return {"decimals": digits}
    if abs(factor.numerator) == 1 and "/" in show(factor):
        return {"divide": factor.denominator * factor.numerator}
    return {"multiply": plain_number(factor)}
