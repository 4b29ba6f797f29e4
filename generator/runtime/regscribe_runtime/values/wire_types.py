"""Wire types: words to numbers and back (two's complement, IEEE 754, word and byte order)."""

import math
import struct
from collections.abc import Callable, Sequence
from decimal import MAX_EMAX, MIN_EMIN, Context, Decimal
from fractions import Fraction

BIG, LITTLE = "big", "little"
FLOAT32_DIGITS, FEWER_DIGITS = range(6, 10), range(1, 10)
"""Significant digits tried for a float32: 6 are always exact, 9 always suffice (IEEE 754 binary32); of subnormal
numbers, which have fewer bits, fewer may do."""
SMALLEST_NORMAL = 2.0**-126
ABOVE = {2.0**-96: "1.2621775E-29", 2.0**87: "1.5474251E+26", 2.0**90: "1.2379401E+27"}
"""The float32 whose shortest decimal is not the nearest one of its length: below a power of two they lie closer."""


class WireType:
    """How a number stands in words: its struct code, its length in words and, for whole numbers, its limits.

    `bits` is given where the number takes less than its word: one bit of a coil, the byte of function 07.
    """

    __slots__ = ("code", "is_float", "maximum", "minimum", "name", "packer", "words")

    def __init__(self, name: str, code: str, bits: int = 0) -> None:
        self.name, self.code = name, code
        self.packer = struct.Struct(">" + code)
        self.words = self.packer.size // 2
        self.is_float = code in "fd"
        bits = bits or 16 * self.words
        self.minimum = -(1 << (bits - 1)) if code.islower() else 0
        self.maximum = (1 << (bits - 1 if code.islower() else bits)) - 1

    def __repr__(self) -> str:
        return self.name.upper()

    def unpack(self, words: Sequence[int]) -> float:
        """The number in `words`, most significant word first: int, or float for IEEE types."""
        number: int | float = self.packer.unpack(struct.pack(f">{self.words}H", *words))[0]
        return number

    def pack(self, number: float) -> tuple[int, ...]:
        """The words of `number`, most significant first; struct.error or OverflowError if it does not fit."""
        return struct.unpack(f">{self.words}H", self.packer.pack(number))

    def nearest(self, number: Fraction) -> float:
        """The IEEE number of the type nearest to `number`, of two the even one; OverflowError beyond the largest."""
        there = self.packer.unpack(self.packer.pack(float(number)))[0]
        if self is not FLOAT32 or not math.isfinite(there):  # Python rounds to a float64 correctly
            return float(there)
        # through a float64 it is rounded twice, which may lead to the neighbour
        bits: int = UINT32.packer.unpack(self.packer.pack(there))[0]
        near = [FLOAT32.packer.unpack(UINT32.packer.pack(each))[0] for each in (bits - 1, bits, bits + 1) if each >= 0]
        finite = [each for each in near if math.isfinite(each)]
        return float(min(finite, key=lambda each: (abs(Fraction(each) - number), _is_odd(each))))


def _is_odd(number: float) -> int:
    odd: int = UINT32.packer.unpack(FLOAT32.packer.pack(number))[0] & 1
    return odd


BIT, UINT8 = WireType("bit", "H", 1), WireType("uint8", "H", 8)
UINT16, INT16 = WireType("uint16", "H"), WireType("int16", "h")
UINT32, INT32 = WireType("uint32", "I"), WireType("int32", "i")
UINT64, INT64 = WireType("uint64", "Q"), WireType("int64", "q")
FLOAT32, FLOAT64 = WireType("float32", "f"), WireType("float64", "d")


def carries(wire_type: WireType, number: float) -> bool:
    """Whether a float of a program is a number that the IEEE type has too."""
    try:
        return math.isfinite(number) and wire_type.unpack(wire_type.pack(number)) == number
    except OverflowError:
        return False


def shortest(number: float, wire_type: WireType) -> Decimal:
    """The decimal with the fewest digits that reads back as the same IEEE number.

    0x437A6666 is 250.39999389648438 as a float64 but 250.4 to everyone who wrote it as a float32.
    """
    if wire_type is FLOAT64:
        return Decimal(repr(number))
    if abs(number) in ABOVE:
        return Decimal(ABOVE[abs(number)]).copy_sign(Decimal(number))
    packed = FLOAT32.packer.pack(number)
    tried = FLOAT32_DIGITS if abs(number) >= SMALLEST_NORMAL else FEWER_DIGITS
    texts = (f"{number:.{digits}g}" for digits in tried)
    return Decimal(next((text for text in texts if _packs_to(text, packed)), repr(number)))


def _packs_to(text: str, packed: bytes) -> bool:
    try:
        return FLOAT32.packer.pack(float(text)) == packed
    except OverflowError:  # rounded beyond the largest float32: one digit more is needed
        return False


MOST_DIGITS = 400
"""Beyond the largest and the smallest number of 64 bits; what has more digits would only cost time."""


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


_MOST_BITS = (10**MOST_DIGITS).bit_length()
_LONGEST_SHOWN = 60


def brief(value: object) -> str:
    """`value` for an error message, cut where it is long."""
    try:
        text = repr(value)
    except ValueError:  # Python does not spell whole numbers of thousands of digits
        text = f"a number of {int.bit_length(value)} bits" if isinstance(value, int) else type(value).__name__
    return text if len(text) <= _LONGEST_SHOWN else f"{text[:_LONGEST_SHOWN]}..."


def show(number: Fraction) -> str:
    """`number` for an error message: decimal text, of very large and very small ones twelve digits."""
    if number.denominator == 1 and abs(number) < 1 << 64:
        return f"{number.numerator}"
    quotient = Context(prec=12, Emin=MIN_EMIN, Emax=MAX_EMAX).divide(number.numerator, number.denominator)
    return f"{quotient:.12g}"


def _half_up(number: Fraction) -> int:
    return math.floor(number + Fraction(1, 2))


def _half_away(number: Fraction) -> int:
    return _half_up(number) if number >= 0 else -_half_up(-number)


ROUNDINGS: dict[str, Callable[[Fraction], int]] = {
    "none": _half_up,
    "half_up": _half_up,
    "half_away": _half_away,
    "half_even": round,
    "down": math.trunc,
}
"""How a device turns a fraction into a whole number; where a map does not say, .5 goes up (asked for explicitly)."""
