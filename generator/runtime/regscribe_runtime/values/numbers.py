"""Exact numbers: parsed from decimal text, rounded as a device rounds, shown as decimal text; never through a float."""

import math
from collections.abc import Callable
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal, InvalidOperation
from fractions import Fraction

from regscribe_runtime.values.wire_types import Rounding, WireType

Number = int | Fraction
"""An exact number."""

MOST_DIGITS = 400
"""More than the largest and the smallest number of 64 bits have; longer numbers would only cost time."""
_MOST_BITS = (10**MOST_DIGITS).bit_length()
_LONGEST_SHOWN = 60
_DIGITS = {
    WireType.FLOAT16: (range(3, 6), range(1, 6), 2.0**-14),
    WireType.FLOAT32: (range(6, 10), range(1, 10), 2.0**-126),
}
"""Significant digits tried: so many are always exact, so many always suffice (IEEE 754). Subnormal numbers, below the
smallest normal one, have fewer bits and may need fewer."""
_ABOVE = {
    WireType.FLOAT16: {2.0**-6: "0.01563"},
    WireType.FLOAT32: {2.0**-96: "1.2621775E-29", 2.0**87: "1.5474251E+26", 2.0**90: "1.2379401E+27"},
}
"""The powers of two whose shortest decimal is not the nearest of its length, as the numbers lie closer below them."""


def exact(value: float | Decimal | Fraction) -> Fraction:
    """`value` as an exact number; a float counts as its shortest decimal, so 25.1 is 251/10.

    Raises ValueError for what is not a finite number, or has more than MOST_DIGITS digits before or behind the point.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float, Decimal, Fraction)):
        message = f"{brief(value)} is not a number"
        raise ValueError(message)  # noqa: TRY004 (callers treat every refusal alike)
    if isinstance(value, (float, Decimal)):
        value = Decimal(float.__repr__(value)) if isinstance(value, float) else value
        if not value.is_finite():
            message = f"{value} is not a finite number"
            raise ValueError(message)
        far = bool(value) and (abs(value.adjusted()) > MOST_DIGITS or len(value.as_tuple().digits) > MOST_DIGITS)
    else:
        far = max(value.numerator.bit_length(), value.denominator.bit_length()) > _MOST_BITS
    if far:
        message = f"{brief(value)} has more than {MOST_DIGITS} digits before or behind the point"
        raise ValueError(message)
    return Fraction(value)


def parse(text: str) -> Fraction:
    """The exact number that a decimal text spells; ValueError for what `exact` refuses, and for any other text."""
    try:
        return exact(Decimal(text))
    except InvalidOperation:
        message = f"{brief(text)} is not a number"
        raise ValueError(message) from None


def show(number: Number) -> str:
    """The number as decimal text without exponent, or `a/b` where no decimal text is exact."""
    if number.denominator == 1:
        return str(number.numerator)
    digits = next((n for n in range(1, number.denominator.bit_length()) if 10**n % number.denominator == 0), 0)
    if not digits:
        return f"{number.numerator}/{number.denominator}"
    whole = abs(number.numerator) * 10**digits // number.denominator
    text = f"{whole:0{digits + 1}d}"
    return f"{'-' if number < 0 else ''}{text[:-digits]}.{text[-digits:]}"


def rough(number: Fraction) -> str:
    """`number` for an error message: decimal text, of fractions and of very large numbers twelve digits."""
    if number.denominator == 1 and abs(number) < 1 << 64:
        return f"{number.numerator}"
    quotient = Context(prec=12, Emin=MIN_EMIN, Emax=MAX_EMAX).divide(number.numerator, number.denominator)
    return f"{quotient:.12g}"


def brief(value: object) -> str:
    """`value` for an error message, cut where it is long."""
    try:
        text = repr(value)
    except ValueError:  # Python does not spell whole numbers of thousands of digits
        text = f"a number of {int.bit_length(value)} bits" if isinstance(value, int) else type(value).__name__
    return text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}..."


def shortest(number: float, wire_type: WireType) -> Decimal:
    """The decimal with the fewest digits that reads back as the same IEEE number.

    0x437A6666 is 250.39999389648438 as a float64 but 250.4 to everyone who wrote it as a float32.
    """
    if wire_type is WireType.FLOAT64:
        return Decimal(repr(number))
    above = _ABOVE[wire_type].get(abs(number))
    if above:
        return Decimal(above).copy_sign(Decimal(number))
    packed = wire_type.packer.pack(number)
    usual, fewer, normal = _DIGITS[wire_type]
    texts = (f"{number:.{digits}g}" for digits in (usual if abs(number) >= normal else fewer))
    return Decimal(next((text for text in texts if _packs_to(text, packed, wire_type)), repr(number)))


def _packs_to(text: str, packed: bytes, wire_type: WireType) -> bool:
    try:
        return wire_type.packer.pack(float(text)) == packed
    except OverflowError:  # rounded beyond the largest number: one digit more is needed
        return False


def half_up(number: Fraction) -> int:
    """The nearest whole number, of two the one towards plus infinity."""
    return math.floor(number + Fraction(1, 2))


def _half_away(number: Fraction) -> int:
    return half_up(number) if number >= 0 else -half_up(-number)


ROUNDINGS: dict[Rounding, Callable[[Fraction], int]] = {
    Rounding.NONE: half_up,
    Rounding.HALF_UP: half_up,
    Rounding.HALF_AWAY: _half_away,
    Rounding.HALF_EVEN: round,
    Rounding.DOWN: math.trunc,
}
"""How a device turns a fraction into a whole number; where a map does not say, .5 goes up (asked for explicitly)."""
