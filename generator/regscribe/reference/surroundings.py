"""Conditions and decimals of a register, evaluated with the values of other registers and the givens."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Protocol

from regscribe.reference.outcome import UnknownValueError
from regscribe_runtime.values.conditions import AnyOf, Cases, Condition, Is, T
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

    def read(self, subject: str) -> str:
        """Return the present text of `subject` (`given.id`: a choice); raises UnknownValueError if it is not known."""
        raise NotImplementedError


@dataclass(frozen=True, slots=True)
class Surroundings:
    """Known values in plain dicts."""

    values: Mapping[str, Fraction] = field(default_factory=dict)
    codes: Mapping[str, frozenset[Fraction]] = field(default_factory=dict)
    facts: Mapping[str, bool] = field(default_factory=dict)
    numbers: Mapping[str, Fraction] = field(default_factory=dict)
    texts: Mapping[str, str] = field(default_factory=dict)

    def look_up(self, subject: str) -> Fraction:
        """Return the value of `subject`; raises UnknownValueError if there is none."""
        if subject not in self.values:
            raise UnknownValueError(subject)
        return self.values[subject]

    def read(self, subject: str) -> str:
        """Return the text of `subject`; raises UnknownValueError if there is none."""
        if subject not in self.texts:
            raise UnknownValueError(subject)
        return self.texts[subject]


NOTHING_KNOWN = Surroundings()


def _is_true(test: Is | AnyOf, known: Known) -> bool:
    if isinstance(test, AnyOf):
        return _any_holds(test.conditions, known) != test.negated
    if test.asks_given:
        return _of_given(test, known) != test.negated
    if test.version:
        found = _version(known.read(test.subject))
        return (found is not None and _lies_in(test, found)) != test.negated
    if not test.register and test.given in known.numbers:
        return _lies_in(test, known.numbers[test.given]) != test.negated
    texts = bool(test.codes) and isinstance(test.codes[0][0], str)
    value = known.read(test.subject) if texts else known.look_up(test.subject)
    return _lies_in(test, value) != test.negated


def _lies_in(test: Is, value: Fraction | str) -> bool:
    return any(low <= value <= high for low, high in test.codes)


def _of_given(test: Is, known: Known) -> bool:
    if test.register:
        value = known.look_up(test.subject)
        if test.given not in known.codes:
            raise UnknownValueError(test.given)
        return value in known.codes[test.given]
    if test.given not in known.facts:
        raise UnknownValueError(test.given)
    return known.facts[test.given]


def _version(text: str) -> Fraction | None:
    """The first dotted number of a text, behind letters and blanks only, as a number to base a million."""
    digits = text.lstrip("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ ")
    parts: list[str] = []
    for piece in digits.split(".")[:4]:
        number = piece[: next((place for place, sign in enumerate(piece) if sign not in "0123456789"), len(piece))]
        if not number:
            break
        parts.append(number[:6])
        if number != piece or len(number) > 6:  # noqa: PLR2004 (digits of a part)
            break
    if not parts:
        return None
    return Fraction(sum(int(part) * 1000000 ** (3 - place) for place, part in enumerate(parts)))


def holds(condition: Condition, known: Known) -> bool:
    """Tell whether all tests of a condition are true; one that is not settles it, whatever is not known."""
    unknown = None
    for test in condition.tests:
        try:
            if not _is_true(test, known):
                return False
        except UnknownValueError as error:
            unknown = error
    if unknown:
        raise unknown
    return True


def _any_holds(conditions: tuple[Condition, ...], known: Known) -> bool:
    """Tell whether one of the conditions is true; one that is settles it, whatever is not known."""
    unknown = None
    for condition in conditions:
        try:
            if holds(condition, known):
                return True
        except UnknownValueError as error:
            unknown = error
    if unknown:
        raise unknown
    return False


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
