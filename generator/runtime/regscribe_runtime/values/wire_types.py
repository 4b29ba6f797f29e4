"""Numbers on the wire: address spaces, types, orders and roundings."""

import math
import struct
from collections.abc import Sequence
from enum import StrEnum
from fractions import Fraction
from typing import Self

_BITS_32, _FLOAT_32 = struct.Struct(">I"), struct.Struct(">f")


class Space(StrEnum):
    """A Modbus address space; `STATUS` is the single byte that function 07 returns (address 0).

    Each has the function that reads it, those that write one address and several, the most addresses of one read,
    and the last address (V1.1b3, section 6). A space of many parts (files of records, FIFO queues) has the part's
    number in the high bits of an address, above `part_bits` lower ones. Of a queue 0 is the count, 1 to 31 are values.
    """

    read_function: int
    write_functions: tuple[int, ...]
    most: int
    part_bits: int
    last: int

    HOLDING = "holding", 3, (6, 16)
    INPUT = "input", 4
    COIL = "coil", 1, (5, 15), 2000
    DISCRETE = "discrete", 2, (), 2000
    STATUS = "status", 7, (), 1, 0, 0
    FILE = "file", 20, (21, 21), 121, 16, 9999
    QUEUE = "queue", 24, (), 32, 6, 31

    def __new__(
        cls,
        name: str,
        read_function: int = 0,
        write_functions: tuple[int, ...] = (),
        most: int = 125,
        part_bits: int = 0,
        last: int = 0xFFFF,
    ) -> Self:
        """The space of this name."""
        space = str.__new__(cls, name)
        space._value_ = name
        space.read_function, space.write_functions = read_function, write_functions
        space.most, space.part_bits, space.last = most, part_bits, last
        return space

    def spelled(self, address: int) -> str:
        """An address for people: `4:10` is record 10 of file 4."""
        return f"{address >> self.part_bits}:{address & (1 << self.part_bits) - 1}" if self.part_bits else str(address)

    @property
    def is_bits(self) -> bool:
        """Whether an address names one bit."""
        return self is Space.COIL or self is Space.DISCRETE

    @property
    def is_words(self) -> bool:
        """Whether an address names a word; the byte of function 07 comes as one number, as bits do."""
        return not self.is_bits and self is not Space.STATUS


def spelled_address(function: int, address: int) -> str:
    """The address of a request for people; see `Space.spelled`."""
    space = next((one for one in Space if function in {one.read_function, *one.write_functions}), Space.HOLDING)
    return space.spelled(address)


class WireType(StrEnum):
    """The type of the number in the words (or the bit) of a view.

    A type is one row: its name, the code by which `struct` packs it, and its bits where they do not fill the words.
    `words` are the registers that one value takes (a bit takes one address; of a string, one of them), `minimum` and
    `maximum` the limits of whole numbers.
    """

    code: str
    packer: struct.Struct
    words: int
    bits: int
    minimum: int
    maximum: int
    is_float: bool
    is_integer: bool

    BIT = "bit", "H", 1
    UINT8 = "uint8", "H", 8
    UINT16 = "uint16", "H"
    INT16 = "int16", "h"
    UINT32 = "uint32", "I"
    INT32 = "int32", "i"
    UINT64 = "uint64", "Q"
    INT64 = "int64", "q"
    FLOAT32 = "float32", "f"
    FLOAT64 = "float64", "d"
    STRING = "string", "H"

    def __new__(cls, name: str, code: str = "H", width: int = 0) -> Self:
        """The type of this row."""
        found = str.__new__(cls, name)
        found._value_ = name
        found.code, found.packer = code, struct.Struct(">" + code)
        found.words = found.packer.size // 2
        found.bits = width or 16 * found.words
        found.is_float = code in "fd"
        found.is_integer = not found.is_float and name != "string"
        sign = code in "hiq"
        found.minimum = -(1 << (found.bits - 1)) if sign else 0
        found.maximum = (1 << (found.bits - sign)) - 1
        return found

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
        if self is not WireType.FLOAT32 or not math.isfinite(there):  # Python rounds to a float64 correctly
            return float(there)
        # through a float64 it is rounded twice, which may lead to the neighbour
        pattern = _bits_of(there)
        near = [_FLOAT_32.unpack(_BITS_32.pack(each))[0] for each in (pattern - 1, pattern, pattern + 1) if each >= 0]
        finite = [each for each in near if math.isfinite(each)]
        return float(min(finite, key=lambda each: (abs(Fraction(each) - number), _bits_of(each) & 1)))

    def carries(self, number: float) -> bool:
        """Whether a float is exactly a number of this IEEE type."""
        try:
            return math.isfinite(number) and self.unpack(self.pack(number)) == number
        except OverflowError:
            return False


def _bits_of(float32: float) -> int:
    bits: int = _BITS_32.unpack(_FLOAT_32.pack(float32))[0]
    return bits


class Order(StrEnum):
    """Which end comes first: `BIG` the most significant word (or byte), `LITTLE` the least significant."""

    BIG = "big"
    LITTLE = "little"


class Rounding(StrEnum):
    """How the device rounds a fraction that the view cannot carry.

    `HALF_UP` rounds .5 upward (towards plus infinity), `HALF_AWAY` away from zero, `HALF_EVEN` to the even
    neighbour, `DOWN` drops it; `NONE`: the map does not say, so a value must be exact.
    """

    HALF_UP = "half_up"
    HALF_AWAY = "half_away"
    HALF_EVEN = "half_even"
    DOWN = "down"
    NONE = "none"
