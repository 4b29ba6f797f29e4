"""Whole numbers in the bits of their words: two's complement, decimal digits, sign and magnitude; and back."""

from fractions import Fraction

from regscribe_runtime.values.wire_types import WireType

PLACES = {
    WireType.BCD16: (16, 10, 4),
    WireType.BCD32: (16, 10, 8),
    WireType.BCD48: (16, 10, 12),
    WireType.BCD64: (16, 10, 16),
    WireType.MOD10K_2: (1 << 16, 10**4, 2),
    WireType.MOD10K_3: (1 << 16, 10**4, 3),
    WireType.MOD10K_4: (1 << 16, 10**4, 4),
}
"""Numbers of places: how many bit patterns a place has, how many of them are digits, and how many places there are."""

WITH_SIGN = {WireType.SIGNMAG16: 1 << 15, WireType.SIGNMAG32: 1 << 31}
"""The weight of the bit that is a sign."""

ONE_BYTE = frozenset({WireType.INT8, WireType.UINT8})
"""The other byte of the word may be somebody else's: it is sent as 0, whatever the sign."""


def whole_number(bits: int, wire_type: WireType) -> Fraction | None:
    """Return the number that the bits of all words spell; None if they are no number of the type."""
    if wire_type in PLACES:
        return _of_places(bits, *PLACES[wire_type])
    if wire_type in WITH_SIGN:
        negative, size = divmod(bits, WITH_SIGN[wire_type])
        return Fraction(-size if negative else size)
    number = bits % (1 << wire_type.bits)
    return Fraction(number if number <= wire_type.maximum else number - (1 << wire_type.bits))


def _of_places(bits: int, patterns: int, base: int, places: int) -> Fraction | None:
    digits = [bits // patterns**place % patterns for place in range(places)]
    fits = all(digit < base for digit in digits)
    return Fraction(sum(digit * base**place for place, digit in enumerate(digits))) if fits else None


def whole_bits(number: int, wire_type: WireType) -> int:
    """Return the bits of all words that spell a number within the limits of the type."""
    if wire_type in PLACES:
        patterns, base, places = PLACES[wire_type]
        return sum(number // base**place % base * patterns**place for place in range(places))
    if wire_type in WITH_SIGN:
        return WITH_SIGN[wire_type] - number if number < 0 else number
    return number % (1 << (wire_type.bits if wire_type in ONE_BYTE else 16 * wire_type.words))
