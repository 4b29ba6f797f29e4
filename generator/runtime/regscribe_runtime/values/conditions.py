"""Conditions on the values of other registers, and cases selected by them."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Generic, NamedTuple, TypeVar

from regscribe_runtime.values.numbers import Number, exact

T = TypeVar("T")

State = Mapping[str, Any]
"""Known values of use by register path: numbers; an enum or a word of bits as its code."""

Givens = Mapping[str, Any]
"""Facts from other manuals, given to the driver's constructor: a set of codes or a bool by id."""


class Is(NamedTuple):
    """A test: the value of `register` (or of its bit field `field`, at `bits`) lies in one of `codes`.

    Codes are pairs of both ends, which are included. With `given`, the codes are those of the given of that id; with an
    empty `register`, the given itself is the result. `negated` inverts the test.
    """

    register: str
    codes: tuple[tuple[Number, Number], ...] = ()
    field: str = ""
    bits: tuple[int, int] | None = None
    given: str = ""
    negated: bool = False

    @property
    def subject(self) -> str:
        """The path to look up: `register` or `register.field`."""
        return f"{self.register}.{self.field}" if self.field else self.register

    def lists(self, value: Number) -> bool:
        """Whether `value` lies in one of the codes."""
        return any(low <= value <= high for low, high in self.codes)

    def holds(self, state: State, givens: Givens) -> bool:
        """Tell whether the test is true; KeyError if the register's value is not in `state`."""
        return self._is_met(state, givens) is not self.negated

    def _is_met(self, state: State, givens: Givens) -> bool:
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
        return self.lists(Fraction(value) if isinstance(value, int) else exact(value))


class Condition(NamedTuple):
    """All tests hold; no tests: always. `name` is the map's name for it, if it has one."""

    tests: tuple[Is, ...] = ()
    name: str = ""

    @property
    def always(self) -> bool:
        """Whether it has no tests."""
        return not self.tests

    @property
    def registers(self) -> tuple[str, ...]:
        """The registers of the tests, each once, in order."""
        return tuple(dict.fromkeys(test.register for test in self.tests if test.register))

    def holds(self, state: State, givens: Givens) -> bool:
        """Tell whether all tests are true; KeyError if a value that counts is not in `state`."""
        return all(test.holds(state, givens) for test in self.tests)


ALWAYS = Condition()


class Case(NamedTuple, Generic[T]):
    """A value `then` under the condition `when`; of a tuple of cases the first whose condition holds counts."""

    when: Condition
    then: T


Cases = tuple[Case[T], ...]


def always(then: T) -> Cases[T]:
    """A single case without a condition."""
    return (Case(ALWAYS, then),)


def choose(cases: Cases[T], state: State, givens: Givens) -> T | None:
    """The value of the first case whose condition holds; None if none does."""
    for when, then in cases:
        if when.holds(state, givens):
            return then
    return None


def registers_of(cases: Cases[Any]) -> tuple[str, ...]:
    """The registers in the conditions of the cases, each once."""
    return tuple(dict.fromkeys(name for case in cases for name in case.when.registers))
