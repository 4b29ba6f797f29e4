"""Conditions on the values of other registers, and things chosen by them."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any, Generic, NamedTuple, TypeVar

from regscribe_runtime.values.numbers import Number, exact

T = TypeVar("T")

State = Mapping[str, Any]
"""Known values of use by register path: numbers; an enum or a word of bits as its code."""

Givens = Mapping[str, Any]
"""The constructor's facts from other manuals: a set of codes or a bool by id."""


class Is(NamedTuple):
    """A test: the value of `register` (or of its bit field `field`, at `bits`) lies in one of `codes`.

    Codes are pairs of both ends, which are included. With `given`, the constructor's set of codes of that id is asked
    instead; with an empty `register`, the given itself is the answer. `negated` turns the test round.
    """

    register: str
    codes: tuple[tuple[Number, Number], ...] = ()
    field: str = ""
    bits: tuple[int, int] | None = None
    given: str = ""
    negated: bool = False

    @property
    def subject(self) -> str:
        """What is looked up: `register` or `register.field`."""
        return f"{self.register}.{self.field}" if self.field else self.register

    def lists(self, value: Number) -> bool:
        """Whether `value` lies in one of the codes."""
        return any(low <= value <= high for low, high in self.codes)

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
        return self.lists(Fraction(value) if isinstance(value, int) else exact(value))


class Condition(NamedTuple):
    """All tests hold; no tests: always. `name` is the map's name for it, if it has one."""

    tests: tuple[Is, ...] = ()
    name: str = ""

    @property
    def always(self) -> bool:
        """Whether nothing is asked."""
        return not self.tests

    @property
    def registers(self) -> tuple[str, ...]:
        """The registers that must be known, each once, in the order of the tests."""
        return tuple(dict.fromkeys(test.register for test in self.tests if test.register))

    def holds(self, state: State, givens: Givens) -> bool:
        """Tell whether all tests are true; KeyError if a value that counts is not in `state`."""
        return all(test.holds(state, givens) for test in self.tests)


ALWAYS = Condition()


class Case(NamedTuple, Generic[T]):
    """`then` is true under `when`; of a tuple of cases the first that holds counts."""

    when: Condition
    then: T


Cases = tuple[Case[T], ...]


def always(then: T) -> Cases[T]:
    """The single case that holds under no condition."""
    return (Case(ALWAYS, then),)


def choose(cases: Cases[T], state: State, givens: Givens) -> T | None:
    """What the first true case holds; None if none is true."""
    for when, then in cases:
        if when.holds(state, givens):
            return then
    return None


def registers_of(cases: Cases[Any]) -> tuple[str, ...]:
    """The registers whose values decide between the cases, each once."""
    return tuple(dict.fromkeys(name for case in cases for name in case.when.registers))
