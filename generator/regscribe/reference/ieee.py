"""IEEE 754 numbers in exact arithmetic: bits to fractions and back, and the shortest decimal that reads back."""

from decimal import ROUND_HALF_EVEN, ROUND_UP, Context, Decimal
from fractions import Fraction
from typing import NamedTuple

from regscribe_runtime.values.wire_types import WireType


class NotFiniteError(ValueError):
    """The bits spell infinity or no number at all."""


class Format(NamedTuple):
    """Bits of the fraction, bits of the exponent, and how many decimal digits always tell two numbers apart."""

    fraction: int
    exponent: int
    digits: int


FORMATS = {
    WireType.FLOAT16: Format(10, 5, 5),
    WireType.FLOAT32: Format(23, 8, 9),
    WireType.FLOAT64: Format(52, 11, 17),
}

CONTEXTS = tuple(
    Context(prec=digits, rounding=rounding, Emax=999999, Emin=-999999)
    for digits in range(1, FORMATS[WireType.FLOAT64].digits + 1)
    for rounding in (ROUND_HALF_EVEN, ROUND_UP)
)
"""From few digits to many, rounding to the nearest decimal first, then away from zero.

Below a power of two the numbers lie closer together: the nearest decimal may read back as another number, the next
one not.
"""


def ieee_number(bits: int, wire_type: WireType) -> Fraction:
    """Return the exact number that `bits` spell; raises NotFiniteError for infinity and not-a-number."""
    form = FORMATS[wire_type]
    fraction = bits % (1 << form.fraction)
    exponent = (bits >> form.fraction) % (1 << form.exponent)
    negative = bits >> (form.fraction + form.exponent)
    if exponent == (1 << form.exponent) - 1:
        message = f"{bits:#x} is no finite {wire_type}"
        raise NotFiniteError(message)
    bias = (1 << (form.exponent - 1)) - 1 + form.fraction
    if exponent == 0:
        size = fraction * Fraction(2) ** (1 - bias)
    else:
        size = (fraction + (1 << form.fraction)) * Fraction(2) ** (exponent - bias)
    return -size if negative else size


def is_infinity(bits: int, wire_type: WireType) -> bool:
    """Tell whether `bits` spell an infinity: all bits of the exponent, none of the fraction."""
    form = FORMATS[wire_type]
    size = bits % (1 << (form.fraction + form.exponent))
    return size == ((1 << form.exponent) - 1) << form.fraction


def not_a_number(wire_type: WireType) -> int:
    """Return the usual pattern of no number: the exponent and the first bit of the fraction set (0x7FC00000)."""
    form = FORMATS[wire_type]
    return ((1 << (form.exponent + 1)) - 1) << (form.fraction - 1)


def largest(wire_type: WireType, *, negative: bool) -> int:
    """Return the bits of the number furthest from zero."""
    form = FORMATS[wire_type]
    sign = negative << (form.fraction + form.exponent)
    return sign + (((1 << form.exponent) - 1) << form.fraction) - 1


def ieee_bits(number: Fraction, wire_type: WireType) -> int | None:
    """Return the bits of the nearest IEEE number, ties to the even one; None if that is infinity."""
    form = FORMATS[wire_type]
    above, below = abs(number.numerator), number.denominator
    bias = (1 << (form.exponent - 1)) - 1
    power = max(_power_of_two(above, below), 1 - bias) if above else 1 - bias
    steps = _nearest(above, below, power - form.fraction)
    exponent = power + bias if steps >= 1 << form.fraction else 0
    bits = (exponent << form.fraction) + steps - ((1 << form.fraction) if exponent else 0)
    if bits >= ((1 << form.exponent) - 1) << form.fraction:
        return None
    return bits + (1 << (form.fraction + form.exponent)) if number.numerator < 0 else bits


def _power_of_two(above: int, below: int) -> int:
    """Return the largest p with 2^p <= above/below."""
    power = above.bit_length() - below.bit_length()
    fits = below << power <= above if power >= 0 else below <= above << -power
    return power if fits else power - 1


def _nearest(above: int, below: int, power: int) -> int:
    """Return above/below in steps of 2^power, rounded to the nearest whole number, a half to the even one."""
    if power >= 0:
        below <<= power
    else:
        above <<= -power
    whole, rest = divmod(above, below)
    return whole + (2 * rest > below or (2 * rest == below and whole % 2))


def shortest(number: Fraction, wire_type: WireType) -> Fraction:
    """Return the decimal of fewest digits whose nearest IEEE number is `number`: 0x437A6666 is 250.4."""
    bits = ieee_bits(number, wire_type)
    above, below = Decimal(number.numerator), Decimal(number.denominator)
    for context in CONTEXTS[: 2 * FORMATS[wire_type].digits]:
        decimal = Fraction(context.divide(above, below))
        if ieee_bits(decimal, wire_type) == bits:
            return decimal
    message = f"{number} is no {wire_type}"
    raise ValueError(message)
