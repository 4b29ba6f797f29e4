"""How a value stands on the wire: views."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe_runtime.values.wire_types import Order, Rounding, Space, WireType


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
        return self.allows(self.space.read_function)

    @property
    def writable(self) -> bool:
        """Whether a write function of its space may address it, all words of a value at once."""
        single, several = self.space.write_functions or (0, 0)
        return self.allows(several) or (self.words == 1 and self.allows(single))

    @property
    def last(self) -> int:
        """Wire address of the last word."""
        return self.address + self.words - 1
