"""What a generated driver says about a register: views, conditions, scales and limits. Plain data, no I/O."""

from collections.abc import Callable, Mapping
from fractions import Fraction
from functools import cache
from typing import Any, NamedTuple

from regscribe_runtime.errors import NotDecodable
from regscribe_runtime.values.numbers import exact
from regscribe_runtime.values.wire_types import Order, Rounding, Space, WireType

State = Mapping[str, Any]
"""Known values of use by register path: numbers; an enum or a word of bits as its code."""

Givens = Mapping[str, Any]
"""The constructor's facts from other manuals: a set of codes or a bool by id."""

Text = str | int
"""An exact number as the generated module writes it: an int, or decimal text such as "0.1" or "1/3"."""


class Is(NamedTuple):
    """A test: the value of `register` (bits `bits` of it) lies in one of `codes`, pairs of both ends included.

    With `given`, the constructor's set of codes of that id is asked instead; with an empty `register`, the given
    itself is the answer. `negated` turns the test round.
    """

    register: str
    codes: tuple[tuple[Text, Text], ...] = ()
    bits: tuple[int, int] | None = None
    given: str = ""
    negated: bool = False

    def holds(self, state: State, givens: Givens) -> bool:
        """Tell whether the test is true; KeyError if the register's value is not in `state`."""
        return self._found(state, givens) is not self.negated

    def _found(self, state: State, givens: Givens) -> bool:
        if not self.register:
            return bool(givens[self.given])
        value = state[self.register]
        if isinstance(value, str):  # a version counts as the number that its digits pack
            value = int(value.replace(".", ""))
        if self.bits:
            low, high = self.bits
            value = (int(value) >> low) & ((1 << (high - low + 1)) - 1)
        if self.given:
            return value in givens[self.given]
        number = Fraction(value) if isinstance(value, int) else exact(value)
        return any(Fraction(low) <= number <= Fraction(high) for low, high in self.codes)


When = tuple[Is, ...]
"""Tests that must all hold; none: always."""


class Conversion(NamedTuple):
    """value = (`multiply` x stored + `add`) / 10^d with d from register `decimals`, at most `at_most`.

    `step`: the smallest increment of the stored value, if the device has one; with register `places`, that is divided
    by 10^d with d from it, at most `at_most`.
    """

    multiply: Text = 1
    add: Text = 0
    decimals: str = ""
    at_most: int | None = None
    step: Text | None = None
    places: str = ""


IDENTITY = Conversion()


class Interval(NamedTuple):
    """A stretch of allowed values, both ends included: a number, the path of a register as `Ref`, or None (open)."""

    low: "Text | Ref | None"
    high: "Text | Ref | None"


class Ref(NamedTuple):
    """A limit that is the present value of another register."""

    register: str


class Limits(NamedTuple):
    """A union of intervals; its numbers are divided by 10^d with d from register `decimals`, at most `at_most`."""

    intervals: tuple[Interval, ...]
    decimals: str = ""
    at_most: int | None = None


Cases = tuple[tuple[When, Any], ...]
"""Pairs of a condition and what holds under it; the first whose condition is true counts."""

SAME: Cases = (((), IDENTITY),)


@cache
def within(low: Text | Ref | None, high: Text | Ref | None) -> Cases:
    """Limits that hold under no condition."""
    return (((), Limits((Interval(low, high),))),)


def choose(cases: Cases, state: State, givens: Givens) -> Any:
    """What the first true case holds; None if none is true."""
    for when, then in cases:
        if all(test.holds(state, givens) for test in when):
            return then
    return None


def registers_of(cases: Cases) -> tuple[str, ...]:
    """The registers whose values decide between the cases."""
    return tuple(dict.fromkeys(test.register for when, _ in cases for test in when if test.register))


class OrderFrom(NamedTuple):
    """The word order stands in a register: `codes` maps its value to an order."""

    register: str
    codes: Mapping[int, Order]


class View(NamedTuple):
    """One way to transmit a value: wire address = `offset` + `stride` x at; wire number = stored x `factor`.

    `functions` limits the function codes (empty: no limit);
    addresses and counts of requests where the view stands must be multiples of `align`.
    """

    name: str
    type: WireType
    offset: int = 0
    stride: int = 1
    words: int = 1
    factor: Text = 1
    rounding: Rounding = Rounding.NONE
    saturates: bool = False
    order: Order | OrderFrom = Order.BIG
    byte_order: Order = Order.BIG
    functions: tuple[int, ...] = ()
    space: Space = Space.HOLDING
    preferred: bool = False
    align: int = 1

    def address(self, at: int) -> int:
        """The wire address of the first word for a register at `at`."""
        return self.offset + self.stride * at

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

    def needs(self) -> tuple[str, ...]:
        """The register that sets the word order, if one does."""
        return (self.order.register,) if isinstance(self.order, OrderFrom) else ()

    def word_order(self, register: str, state: State) -> Order:
        """The order of the words as things stand; NotDecodable for a code that the manual does not list."""
        if isinstance(self.order, Order):
            return self.order
        code = int(state[self.order.register])
        if code not in self.order.codes:
            raise NotDecodable(register, f"{self.order.register} is {code}, which sets no word order")
        return self.order.codes[code]


def word(view_type: WireType, **more: Any) -> tuple[View, ...]:
    """The single base view of a plain register."""
    return (View("base", view_type, words=view_type.words, **more),)


Converter = Callable[[Any], Any]
"""From a wire number to a value of use."""
