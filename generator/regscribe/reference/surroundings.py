"""Conditions and decimals of a register, evaluated with the values of other registers and the givens."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Protocol

from regscribe.reference.outcome import UnknownValueError
from regscribe_runtime.values.conditions import Cases, Condition, Is, T
from regscribe_runtime.values.scales import Decimals

MOST_DECIMALS = 9
"""A decimals register above this is no decimal position of any device, and ten to the power of it may be endless."""


class Known(Protocol):
    """Values of use of other registers by path (or `register.field`), and codes and facts of the givens by id."""

    @property
    def codes(self) -> Mapping[str, frozenset[Fraction]]:
        """The codes of a register that a given lists."""
        raise NotImplementedError

    @property
    def facts(self) -> Mapping[str, bool]:
        """The givens that are true or false."""
        raise NotImplementedError

    @property
    def numbers(self) -> Mapping[str, Fraction]:
        """The givens that are a number."""
        raise NotImplementedError

    def look_up(self, subject: str) -> Fraction:
        """Return the present value of `subject`; raises UnknownValueError if it is not known."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Surroundings:
    """Known values in plain dicts."""

    values: Mapping[str, Fraction] = field(default_factory=dict)
    codes: Mapping[str, frozenset[Fraction]] = field(default_factory=dict)
    facts: Mapping[str, bool] = field(default_factory=dict)
    numbers: Mapping[str, Fraction] = field(default_factory=dict)

    def look_up(self, subject: str) -> Fraction:
        """Return the value of `subject`; raises UnknownValueError if there is none."""
        if subject not in self.values:
            raise UnknownValueError(subject)
        return self.values[subject]


NOTHING_KNOWN = Surroundings()


def _is_true(test: Is, known: Known) -> bool:
    if not test.register:
        if test.given not in known.facts:
            raise UnknownValueError(test.given)
        return known.facts[test.given] != test.negated
    value = known.look_up(test.subject)
    if test.given:
        if test.given not in known.codes:
            raise UnknownValueError(test.given)
        return (value in known.codes[test.given]) != test.negated
    return any(low <= value <= high for low, high in test.codes) != test.negated


def holds(condition: Condition, known: Known) -> bool:
    """Tell whether all tests of a condition are true."""
    return all(_is_true(test, known) for test in condition.tests)


def choose(cases: Cases[T], known: Known) -> T | None:
    """Return what the first case that holds says; None if none holds."""
    for case in cases:
        if holds(case.when, known):
            return case.then
    return None


def decimal_factor(decimals: Decimals | None, known: Known) -> Fraction | None:
    """Return 10 to the power of the decimals register; None if that is no number of decimals (0 to 9)."""
    if decimals is None:
        return Fraction(1)
    count = known.look_up(decimals.register)
    if count.denominator != 1 or not 0 <= count <= MOST_DECIMALS:
        return None
    most = int(count) if decimals.at_most is None else min(int(count), decimals.at_most)
    return Fraction(10**most)
