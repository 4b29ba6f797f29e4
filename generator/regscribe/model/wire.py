"""How a value stands on the wire: spaces, types, orders and views."""

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from functools import cached_property

FLOAT_BITS = {"float32": 32, "float64": 64}


class Space(StrEnum):
    """A Modbus address space; `STATUS` is the single byte that function 07 returns (address 0)."""

    HOLDING = "holding"
    INPUT = "input"
    COIL = "coil"
    DISCRETE = "discrete"
    STATUS = "status"

    @property
    def is_bits(self) -> bool:
        """Whether an address names one bit."""
        return self in {Space.COIL, Space.DISCRETE}


READ_FUNCTIONS = {Space.COIL: 1, Space.DISCRETE: 2, Space.HOLDING: 3, Space.INPUT: 4, Space.STATUS: 7}
WRITE_FUNCTIONS = {Space.COIL: (5, 15), Space.HOLDING: (6, 16)}
"""By space: the function that writes one address, and the one that writes several (V1.1b3, section 6)."""


class WireType(StrEnum):
    """The type of the number that the words (or the bit) of a view spell."""

    BIT = "bit"
    UINT8 = "uint8"
    UINT16 = "uint16"
    INT16 = "int16"
    UINT32 = "uint32"
    INT32 = "int32"
    UINT64 = "uint64"
    INT64 = "int64"
    FLOAT32 = "float32"
    FLOAT64 = "float64"
    STRING = "string"

    @cached_property
    def bits(self) -> int:
        """Width in bits; 16 for one word of a string."""
        if self is WireType.BIT:
            return 1
        if self is WireType.STRING:
            return 16
        return int(self.value.lstrip("uintfloa"))

    @cached_property
    def words(self) -> int:
        """Registers that one value takes (bits take one address)."""
        return max(1, self.bits // 16)

    @cached_property
    def is_float(self) -> bool:
        """Whether it is an IEEE 754 number."""
        return self.value in FLOAT_BITS

    @cached_property
    def is_integer(self) -> bool:
        """Whether it is a whole number (a bit is)."""
        return not self.is_float and self is not WireType.STRING

    @cached_property
    def minimum(self) -> int:
        """Smallest whole number of the type; 0 for types that are not whole numbers."""
        return -(1 << (self.bits - 1)) if self.value.startswith("int") else 0

    @cached_property
    def maximum(self) -> int:
        """Largest whole number of the type."""
        return (1 << (self.bits - (1 if self.value.startswith("int") else 0))) - 1


class Order(StrEnum):
    """Which end comes first: `BIG` the most significant word (or byte), `LITTLE` the least significant."""

    BIG = "big"
    LITTLE = "little"


class Rounding(StrEnum):
    """What the device does with a fraction that the view cannot carry.

    `HALF_UP` sends .5 upward (towards plus infinity), `HALF_AWAY` away from zero, `HALF_EVEN` to the even
    neighbour, `DOWN` drops it; `NONE`: the map does not say, so a value must be exact.
    """

    HALF_UP = "half_up"
    HALF_AWAY = "half_away"
    HALF_EVEN = "half_even"
    DOWN = "down"
    NONE = "none"


@dataclass(frozen=True, slots=True)
class OrderFromRegister:
    """The word order is set by a register: `codes` maps its value to an order."""

    register: str
    codes: tuple[tuple[int, Order], ...]


@dataclass(frozen=True, slots=True)
class View:
    """One way to transmit a value.

    wire number = stored value x `factor`, rounded by `rounding`; with `saturates`, clipped to the limits of `type`.
    `address` is the wire address of the first word, `words` their number. `functions` are the function codes that
    may address the view (empty: whatever the device supports); `align` is what an address and a count in this
    view's region must be multiples of; `region` the first and last address that the view set gives to this view.
    """

    name: str
    space: Space
    address: int
    type: WireType
    words: int = 1
    factor: Fraction = Fraction(1)
    rounding: Rounding = Rounding.NONE
    saturates: bool = False
    word_order: Order | OrderFromRegister = Order.BIG
    byte_order: Order = Order.BIG
    functions: tuple[int, ...] = ()
    align: int = 1
    region: tuple[int, int] | None = None
    preferred: bool = False
    stride: int = 1

    def allows(self, function: int) -> bool:
        """Whether a function code may address it."""
        return not self.functions or function in self.functions

    @property
    def readable(self) -> bool:
        """Whether the read function of its space may address it."""
        return self.allows(READ_FUNCTIONS[self.space])

    @property
    def writable(self) -> bool:
        """Whether a write function of its space may address it, all words of a value at once."""
        single, several = WRITE_FUNCTIONS.get(self.space, (0, 0))
        return self.allows(several) or (self.words == 1 and self.allows(single))

    @property
    def last(self) -> int:
        """Wire address of the last word."""
        return self.address + self.words - 1
