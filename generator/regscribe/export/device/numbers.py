"""Exact numbers as text for formats that read a decimal number, most of them into a double."""

from decimal import Context, Decimal
from fractions import Fraction
from math import lcm

from regscribe.model import show

DIGITS = 17
"""Significant digits that tell every double from every other."""

EXACT_DOUBLE, EXACT_SINGLE = 1 << 53, 1 << 24
"""Up to there a float of 64 and of 32 bits tells every whole number from every other."""


def decimal(number: Fraction) -> str:
    """The number as decimal text without an exponent: exact where it has an end, else to 17 significant digits."""
    text = show(number)
    if "/" not in text:
        return text
    return format(Context(prec=DIGITS).divide(Decimal(number.numerator), Decimal(number.denominator)), "f")


def is_exact(number: Fraction) -> bool:
    """Whether `decimal` says it exactly."""
    return "/" not in show(number)


def places(*numbers: Fraction) -> int | None:
    """How many decimals whole multiples of these, and their sums, have at most; None where one has no end."""
    denominator, digits = lcm(*(one.denominator for one in numbers)), 0
    while denominator % 10 == 0 or denominator % 2 == 0 or denominator % 5 == 0:
        denominator //= 10 if denominator % 10 == 0 else 2 if denominator % 2 == 0 else 5
        digits += 1
    return digits if denominator == 1 else None


def json_number(number: Fraction) -> int | float:
    """The number for JSON that is read into doubles: a whole one as it is, else the nearest double."""
    return number.numerator if number.denominator == 1 else float(number)
