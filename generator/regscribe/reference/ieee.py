"""IEEE 754 numbers in exact arithmetic: bits to fractions and back, and the shortest decimal that reads back."""

from decimal import ROUND_HALF_EVEN, ROUND_UP, Context, Decimal
from fractions import Fraction
from typing import NamedTuple

from regscribe.model.wire import WireType


class NotFiniteError(ValueError):
    """The bits spell infinity or no number at all."""


class Format(NamedTuple):
    """Bits of the fraction, bits of the exponent, and how many decimal digits always tell two numbers apart."""

    fraction: int
    exponent: int
    digits: int


FORMATS = {WireType.FLOAT32: Format(23, 8, 9), WireType.FLOAT64: Format(52, 11, 17)}


NEAREST_FIRST = (ROUND_HALF_EVEN, ROUND_UP)
"""Below a power of two the numbers lie closer together: the nearest decimal may be another's, the next one not."""


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


def ieee_bits(number: Fraction, wire_type: WireType) -> int | None:
    """Return the bits of the nearest IEEE number, ties to the even one; None if that is infinity."""
    form = FORMATS[wire_type]
    size = abs(number)
    bias = (1 << (form.exponent - 1)) - 1
    power = max(_power_of_two(size), 1 - bias) if size else 1 - bias
    steps = round(size / Fraction(2) ** (power - form.fraction))  # Python rounds a half to the even neighbour
    exponent = power + bias if steps >= 1 << form.fraction else 0
    bits = (exponent << form.fraction) + steps - ((1 << form.fraction) if exponent else 0)
    if bits >= ((1 << form.exponent) - 1) << form.fraction:
        return None
    return bits + (1 << (form.fraction + form.exponent)) if number < 0 else bits


def _power_of_two(size: Fraction) -> int:
    """Return the largest p with 2^p <= size."""
    power = size.numerator.bit_length() - size.denominator.bit_length()
    return power if Fraction(2) ** power <= size else power - 1


def shortest(number: Fraction, wire_type: WireType) -> Fraction:
    """Return the decimal of fewest digits whose nearest IEEE number is `number`: 0x437A6666 is 250.4."""
    bits = ieee_bits(number, wire_type)
    for digits in range(1, FORMATS[wire_type].digits + 1):
        for rounding in NEAREST_FIRST:
            context = Context(prec=digits, rounding=rounding, Emax=999999, Emin=-999999)
            text = context.divide(Decimal(number.numerator), Decimal(number.denominator))
            if ieee_bits(Fraction(text), wire_type) == bits:
                return Fraction(text)
    message = f"{number} is no {wire_type}"
    raise ValueError(message)
