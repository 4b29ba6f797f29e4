"""Numbers on the wire: address spaces, types, orders and roundings."""

import math
import re
import struct
from collections.abc import Sequence
from enum import StrEnum
from fractions import Fraction
from typing import Self

from regscribe_runtime.values.spellings import Spelling, bcd, modulo_10000, narrow, sign_and_magnitude

PAGE_BITS, WIRE = 16, 0xFFFF
"""Above the bits of a wire address an address has the number of its page, and of its page the wire address alone."""


WRITE_AND_READ = 23
"""The function that writes holding registers and then reads some, in one request (V1.1b3, section 6.17)."""


ENRON_BIT = 1 << 40
"""Above all other bits of an address: it is that of a word in one of Enron's registers of 32 bits, two words each."""


class Space(StrEnum):
    """A Modbus address space; `STATUS` is the single byte that function 07 returns (address 0).

    Each has the function that reads it, those that write one address and several, the most addresses of one read,
    and the last address (V1.1b3, section 6). A space of many parts (files of records, FIFO queues, objects) has the
    part's number in the high bits of an address, above `part_bits` lower ones. Of a queue 0 is the count. Enron's
    registers of 32 bits are read and written by the functions of holding registers, and `each` of them is two words:
    a part of a space of its own.
    """

    read_function: int
    write_functions: tuple[int, ...]
    most: int
    part_bits: int
    last: int
    each: int

    HOLDING = "holding", 3, (6, 16)
    INPUT = "input", 4
    COIL = "coil", 1, (5, 15), 2000
    DISCRETE = "discrete", 2, (), 2000
    STATUS = "status", 7, (), 1, 0, 0
    FILE = "file", 20, (21, 21), 121, 16, 9999
    QUEUE = "queue", 24, (), 32, 6, 31
    IDENTIFICATION = "identification", 43, (), 123, 8, 122
    ENRON = "enron", 3, (6, 16), 124, 1, 1, 2

    def __new__(
        cls,
        name: str,
        read_function: int = 0,
        write_functions: tuple[int, ...] = (),
        most: int = 125,
        part_bits: int = 0,
        last: int = 0xFFFF,
        each: int = 1,
    ) -> Self:
        """The space of this name."""
        space = str.__new__(cls, name)
        space._value_ = name
        space.read_function, space.write_functions = read_function, write_functions
        space.most, space.part_bits, space.last, space.each = most, part_bits, last, each
        return space

    def spelled(self, address: int, offset: int = 0) -> str:
        """An address for people: `4:10` is record 10 of file 4; of an object its number.

        `offset` is what a notation of the manual adds to it.
        """
        inside = self.inside(address)
        if self in PARTED:
            return f"{address >> self.part_bits}:{inside}"
        return f"{inside + offset} on page {page}" if (page := self.page(address)) else str(inside + offset)

    def inside(self, address: int) -> int:
        """An address in its page, its file or its queue; of an object of the identification its number."""
        if self is Space.IDENTIFICATION:
            return address >> self.part_bits
        if self is Space.ENRON:
            return self.plain(address)
        return address & (1 << (self.part_bits or PAGE_BITS)) - 1

    def facts(self, address: int) -> dict[str, int]:
        """An address for programs: that inside, and the file, the queue or the page that it is in, by name."""
        if self in PARTED:
            return {"address": self.inside(address), str(self): address >> self.part_bits}
        return {"address": self.inside(address)} | ({"page": page} if (page := self.page(address)) else {})

    def plain(self, address: int) -> int:
        """The address that stands in a request: of the 32-bit register that a word belongs to."""
        return (address & ~ENRON_BIT) // 2 if self is Space.ENRON else address

    def within(self, address: int, word: int = 0) -> int:
        """The address of a word of the register at an address that stands in a request."""
        return ENRON_BIT + 2 * address + word if self is Space.ENRON else address

    def page(self, address: int) -> int:
        """The number of the page that an address stands on; 0: on none."""
        return 0 if self.part_bits else address >> PAGE_BITS

    @property
    def is_whole(self) -> bool:
        """Whether a part of it comes as a whole, whatever the limits of the device."""
        return self is Space.QUEUE or self is Space.IDENTIFICATION

    @property
    def is_bits(self) -> bool:
        """Whether an address names one bit."""
        return self is Space.COIL or self is Space.DISCRETE

    @property
    def is_words(self) -> bool:
        """Whether an address names a word; the byte of function 07 comes as one number, as bits do."""
        return not self.is_bits and self is not Space.STATUS


def written_space(function: int, address: int = 0) -> Space:
    """The space that a function writes at an address; holding registers for a function that writes none."""
    if address >= ENRON_BIT:
        return Space.ENRON
    return next((space for space in Space if function in space.write_functions), Space.HOLDING)


PARTED = frozenset({Space.FILE, Space.QUEUE})
"""Spaces of which an address has the number of a part."""


def spelled_address(function: int, address: int) -> str:
    """The address of a request for people; see `Space.spelled`."""
    return _space_of(function, address).spelled(address)


def address_facts(function: int, address: int) -> dict[str, int]:
    """The address of a request for programs; see `Space.facts`."""
    return _space_of(function, address).facts(address)


def _space_of(function: int, address: int) -> Space:
    if address >= ENRON_BIT:
        return Space.ENRON
    return next((one for one in Space if function in {one.read_function, *one.write_functions}), Space.HOLDING)


_FLOATS, _SIGNED = frozenset("efd"), frozenset("hiq")
_BYTE = "one byte of the word; the other is not read, and is written as 0"
_BCD = "a decimal digit in each four bits"
_MODULO = "a number from 0 to 9999 in each word, four decimal digits"
_SIGN = "the highest bit is the sign, the others the size"
_WIDE = re.compile(r"uint([89][0-9]|[1-9][0-9]{2,3})")
_SHORTEST = "read as the shortest decimal of its bits"


class WireType(StrEnum):
    """The type of the number in the words (or the bit) of a view.

    A type is one row: its name, the code by which `struct` packs it or else how words spell it, and what the docs say
    of it beside its name. `words` are the registers that one value takes (a bit takes one address; of a string, one of
    them), `minimum` and `maximum` the limits of whole numbers, `bits` those of a pattern (0: its bits are none), and
    2 to the power of `fraction` what the number on the wire is divided by. Types that are `is_octets` have bytes and no
    number; where a map states their length, `words` is the least.
    """

    code: str
    packer: struct.Struct
    spelling: Spelling | None
    note: str
    words: int
    bits: int
    fraction: int
    minimum: int
    maximum: int
    is_float: bool
    is_integer: bool
    is_octets: bool

    BIT = "bit", "H", "", 0, 1
    UINT8 = "uint8", narrow(8, signed=False, extended=False), _BYTE
    INT8 = "int8", narrow(8, signed=True, extended=False), _BYTE
    UINT16 = "uint16", "H"
    INT16 = "int16", "h"
    UINT24 = "uint24", narrow(24, signed=False), "the upper byte is not read, and is written as 0"
    INT24 = "int24", narrow(24, signed=True), "the upper byte is not read, and is written as copies of the sign"
    UINT32 = "uint32", "I"
    INT32 = "int32", "i"
    UINT48 = "uint48", narrow(48, signed=False)
    INT48 = "int48", narrow(48, signed=True)
    UINT64 = "uint64", "Q"
    INT64 = "int64", "q"
    UINT128 = "uint128", narrow(128, signed=False)
    INT128 = "int128", narrow(128, signed=True)
    FLOAT16 = "float16", "e", _SHORTEST
    FLOAT32 = "float32", "f", _SHORTEST
    FLOAT64 = "float64", "d", _SHORTEST
    BCD16 = "bcd16", bcd(1), _BCD
    BCD32 = "bcd32", bcd(2), _BCD
    BCD48 = "bcd48", bcd(3), _BCD
    BCD64 = "bcd64", bcd(4), _BCD
    MOD10K_2 = "mod10k_2", modulo_10000(2), _MODULO
    MOD10K_3 = "mod10k_3", modulo_10000(3), _MODULO
    MOD10K_4 = "mod10k_4", modulo_10000(4), _MODULO
    SIGNMAG16 = "signmag16", sign_and_magnitude(1), _SIGN
    SIGNMAG32 = "signmag32", sign_and_magnitude(2), _SIGN
    Q15 = "q15", "h", "an int16 in units of 1/32768", 15
    Q31 = "q31", "i", "an int32 in units of 1/2147483648", 31
    Q4_12 = "q4.12", "h", "an int16 in units of 1/4096", 12
    Q8_8 = "q8.8", "h", "an int16 in units of 1/256", 8
    Q12_4 = "q12.4", "h", "an int16 in units of 1/16", 4
    Q8_24 = "q8.24", "i", "an int32 in units of 1/16777216", 24
    Q16_16 = "q16.16", "i", "an int32 in units of 1/65536", 16
    Q24_8 = "q24.8", "i", "an int32 in units of 1/256", 8
    UQ8_8 = "uq8.8", "H", "a uint16 in units of 1/256", 8
    UQ16_16 = "uq16.16", "I", "a uint32 in units of 1/65536", 16
    STRING = "string", 1
    BYTES = "bytes", 1
    IPV4 = "ipv4", 2
    IPV6 = "ipv6", 8
    EUI48 = "eui48", 3
    EUI64 = "eui64", 4
    DATETIME = "datetime", 1
    DATE = "date", 1
    TIME = "time", 1

    def __new__(
        cls, name: str, how: str | Spelling | int = "H", note: str = "", fraction: int = 0, width: int = 0
    ) -> Self:
        """The type of this row."""
        found = str.__new__(cls, name)
        found._value_ = name
        found.fill(how, note, fraction, width)
        return found

    def fill(self, how: str | Spelling | int, note: str = "", fraction: int = 0, width: int = 0) -> None:
        """Give the type what its row says."""
        self.note, self.fraction = note, fraction
        self.is_octets = isinstance(how, int)
        self.code = how if isinstance(how, str) else "H" if isinstance(how, int) else ""
        self.spelling = None if isinstance(how, str | int) else how
        self.is_float = self.code in _FLOATS
        self.is_integer = not self.is_float and not self.is_octets
        if self.spelling:
            self.words, self.bits, self.minimum, self.maximum, *_ = self.spelling
            self.packer = struct.Struct(f">{2 * self.words}s")
            return
        self.packer = struct.Struct(">" + self.code)
        self.words = how if isinstance(how, int) else self.packer.size // 2
        self.bits = width or 16 * self.words
        sign = self.code in _SIGNED
        self.minimum = -(1 << (self.bits - 1)) if sign else 0
        self.maximum = (1 << (self.bits - sign)) - 1

    @classmethod
    def _missing_(cls, value: object) -> "WireType | None":
        """The row of `uint80` and of more words, made when it is first asked for: of bits, few of many lengths."""
        name = str(value)
        width = int(name.removeprefix("uint")) if _WIDE.fullmatch(name) else 1
        if width % 16:
            return None
        made = str.__new__(cls, name)
        made._name_, made._value_ = name.upper(), name
        made.fill(narrow(width, signed=False))
        cls._value2member_map_[name] = made
        return made

    @classmethod
    def of_words(cls, words: int) -> "WireType":
        """The type of so many words of bits."""
        return cls(f"uint{16 * words}")

    @property
    def ends(self) -> tuple[Fraction, Fraction]:
        """The lowest and the highest number that whole numbers on the wire stand for."""
        return Fraction(self.minimum, 1 << self.fraction), Fraction(self.maximum, 1 << self.fraction)

    def unpack(self, words: Sequence[int]) -> float:
        """The number in `words`, most significant word first: int, or float for IEEE types.

        ValueError for words that spell none.
        """
        raw = struct.pack(f">{self.words}H", *words)
        if self.spelling:
            return self.spelling.read(raw)
        number: int | float = self.packer.unpack(raw)[0]
        return number

    def pack(self, number: float) -> tuple[int, ...]:
        """The words of `number`, most significant first; struct.error or OverflowError if it does not fit."""
        raw = self.spelling.spell(int(number)) if self.spelling else self.packer.pack(number)
        return struct.unpack(f">{self.words}H", raw)

    def nearest(self, number: Fraction) -> float:
        """The IEEE number of the type nearest to `number`, of two the even one; OverflowError beyond the largest."""
        there = self.packer.unpack(self.packer.pack(float(number)))[0]
        if self is WireType.FLOAT64 or there == number or not math.isfinite(there):  # Python rounds to a float64 well
            return float(there)
        # through a float64 it is rounded twice, which may lead to the neighbour
        pattern = self._pattern(there)
        near = [
            self.packer.unpack(each.to_bytes(self.packer.size))[0]
            for each in (pattern - 1, pattern, pattern + 1)
            if each >= 0
        ]
        finite = [each for each in near if math.isfinite(each)]
        return float(min(finite, key=lambda each: (abs(Fraction(each) - number), self._pattern(each) & 1)))

    def _pattern(self, number: float) -> int:
        return int.from_bytes(self.packer.pack(number))

    def carries(self, number: float) -> bool:
        """Whether a float is exactly a number of this IEEE type."""
        try:
            return math.isfinite(number) and self.unpack(self.pack(number)) == number
        except OverflowError:
            return False


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
