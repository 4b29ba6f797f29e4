"""Conditions on the values of other registers, and things chosen by them."""

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Generic, TypeVar

T = TypeVar("T")

Lookup = Callable[[str], Fraction]
"""The present value of a register by its path, or of one bit field as `register.field`."""


@dataclass(frozen=True, slots=True)
class CodeRange:
    """Values from `low` to `high`, both included."""

    low: Fraction
    high: Fraction

    def holds(self, value: Fraction) -> bool:
        """Tell whether `value` lies inside."""
        return self.low <= value <= self.high


@dataclass(frozen=True, slots=True)
class Test:
    """One register (or one bit field of it) has one of some values.

    `given` names a constructor argument of kind `codes` that holds the values instead of `codes`; for a given of
    kind `boolean`, `register` is empty and the given itself is the test. `negated` turns the test round.
    """

    register: str
    field: str = ""
    codes: tuple[CodeRange, ...] = ()
    given: str = ""
    negated: bool = False

    @property
    def subject(self) -> str:
        """What is looked up: `register` or `register.field`."""
        return f"{self.register}.{self.field}" if self.field else self.register


@dataclass(frozen=True, slots=True)
class Condition:
    """All tests hold; no tests: always. `name` is the map's name for it, if it has one."""

    tests: tuple[Test, ...] = ()
    name: str = ""

    @property
    def always(self) -> bool:
        """Whether nothing is asked."""
        return not self.tests

    @property
    def registers(self) -> tuple[str, ...]:
        """The registers that must be known, each once, in the order of the tests."""
        return tuple(dict.fromkeys(test.register for test in self.tests if test.register))


ALWAYS = Condition()


@dataclass(frozen=True, slots=True)
class Case(Generic[T]):
    """`then` is true under `when`; of a tuple of cases the first that holds counts."""

    when: Condition
    then: T


Cases = tuple[Case[T], ...]


def always(then: T) -> Cases[T]:
    """The single case that holds under no condition."""
    return (Case(ALWAYS, then),)


def registers_of(cases: Cases[T]) -> tuple[str, ...]:
    """The registers that decide between the cases, each once."""
    return tuple(dict.fromkeys(name for case in cases for name in case.when.registers))
