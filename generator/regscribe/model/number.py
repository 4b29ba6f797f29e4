"""Exact numbers: read from decimal text, shown as decimal text; never through a float."""

from decimal import Decimal, InvalidOperation
from fractions import Fraction

MOST_DIGITS = 400
"""Beyond the largest and the smallest number of 64 bits; a few characters must not ask for gigabytes of digits."""


def exact(text: str | float | Fraction | Decimal) -> Fraction:
    """The exact number that `text` spells; a float counts as its shortest decimal (25.1 is 251/10).

    Raises ValueError for what is no finite number.
    """
    if isinstance(text, Fraction):
        return text
    try:
        number = Decimal(repr(text) if isinstance(text, float) else text)
    except InvalidOperation:
        message = f"{text!r} is not a number"
        raise ValueError(message) from None
    if not number.is_finite():
        message = f"{text!r} is not a finite number"
        raise ValueError(message)
    if abs(number.adjusted()) > MOST_DIGITS and number:
        message = f"{str(text)[:40]!r} has more than {MOST_DIGITS} digits before or behind the point"
        raise ValueError(message)
    return Fraction(number)


def show(number: Fraction) -> str:
    """The number as decimal text without exponent, or `a/b` where no decimal text is exact."""
    if number.denominator == 1:
        return str(number.numerator)
    twos_and_fives = number.denominator
    for prime in (2, 5):
        while twos_and_fives % prime == 0:
            twos_and_fives //= prime
    if twos_and_fives != 1:
        return f"{number.numerator}/{number.denominator}"
    digits = next(n for n in range(1, number.denominator.bit_length() + 1) if 10**n % number.denominator == 0)
    whole = abs(number.numerator) * 10**digits // number.denominator
    text = f"{whole:0{digits + 1}d}"
    return f"{'-' if number < 0 else ''}{text[:-digits]}.{text[-digits:]}"
