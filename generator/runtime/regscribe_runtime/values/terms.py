"""Terms: a number that stands in the map, in a register, in a given, or that follows from several of these; exact."""

from collections.abc import Iterator
from fractions import Fraction
from math import prod
from typing import Any, NamedTuple

from regscribe_runtime.values.conditions import Cases, Givens, State, choose
from regscribe_runtime.values.numbers import Number, exact, rough

MOST_POWER = 10
"""The largest power of ten, of either sign, that a scale of a device has; beyond it a register was misread."""


class Ref(NamedTuple):
    """The present value of a register."""

    register: str

    def number(self, state: State, _: Givens) -> Fraction:
        """The number that the register holds."""
        value = state[self.register]
        return exact(int(value) if isinstance(value, int) else value)


class GivenRef(NamedTuple):
    """The number that a given states."""

    given: str

    def number(self, _: State, givens: Givens) -> Fraction:
        """The number stated."""
        return exact(givens[self.given])


class Power(NamedTuple):
    """10 to the power of `exponent`, a whole number from -10 to 10."""

    exponent: "Term"

    def number(self, state: State, givens: Givens) -> Fraction:
        """The power of ten."""
        digits = resolve(self.exponent, state, givens)
        if digits.denominator == 1 and abs(digits) <= MOST_POWER:
            return Fraction(10) ** digits.numerator
        message = f"{rough(digits)} is no power of ten from -{MOST_POWER} to {MOST_POWER} ({_known(self, state)})"
        raise UnsettledError(message)


class Product(NamedTuple):
    """The product of `factors`, divided by all `divisors`."""

    factors: "tuple[Term, ...]"
    divisors: "tuple[Term, ...]" = ()

    def number(self, state: State, givens: Givens) -> Fraction:
        """The quotient of both products."""
        over, under = (
            prod((resolve(each, state, givens) for each in part), start=Fraction(1))
            for part in (self.factors, self.divisors)
        )
        if under:
            return over / under
        message = f"nothing is divided by 0 ({_known(self.divisors, state)})"
        raise UnsettledError(message)


class Sum(NamedTuple):
    """The sum of `terms`."""

    terms: "tuple[Term, ...]"

    def number(self, state: State, givens: Givens) -> Fraction:
        """The sum."""
        return sum((resolve(each, state, givens) for each in self.terms), Fraction(0))


class Largest(NamedTuple):
    """The largest of several terms."""

    largest_of: "tuple[Term, ...]"

    def number(self, state: State, givens: Givens) -> Fraction:
        """The largest number."""
        return max(resolve(each, state, givens) for each in self.largest_of)


class Smallest(NamedTuple):
    """The smallest of several terms."""

    smallest_of: "tuple[Term, ...]"

    def number(self, state: State, givens: Givens) -> Fraction:
        """The smallest number."""
        return min(resolve(each, state, givens) for each in self.smallest_of)


class ByCase(NamedTuple):
    """The term of the first case whose condition holds."""

    cases: "Cases[Term]"

    def number(self, state: State, givens: Givens) -> Fraction:
        """The number of that case."""
        found = choose(self.cases, state, givens)
        if found is None:
            message = f"no case holds ({_known(self, state)})"
            raise UnsettledError(message)
        return resolve(found, state, givens)


Term = Number | Ref | GivenRef | Power | Product | Sum | Largest | Smallest | ByCase


class UnsettledError(ValueError):
    """A term is no number as the device is set; the message names the registers at fault with their values."""


def resolve(term: Term, state: State, givens: Givens) -> Fraction:
    """The number of a term; UnsettledError where it has none, KeyError for a register that is not in `state`."""
    return Fraction(term) if isinstance(term, Number) else term.number(state, givens)


def _known(terms: Any, state: State) -> str:
    """The registers of terms with their values, as far as these are known, else the givens."""
    known = [f"{path} = {state[path]}" for path in registers_in(terms) if path in state]
    return ", ".join(known or [f"given {name}" for name in givens_in(terms)])


def parts_of(term: Any) -> Iterator[Any]:
    """A term, or a tuple of the vocabulary that holds terms, and all that it is made of."""
    waiting = [term]
    while waiting:
        part = waiting.pop()
        yield part
        if isinstance(part, tuple):
            waiting += part[::-1]


def registers_in(*terms: Any) -> tuple[str, ...]:
    """The registers that terms need, those of their conditions too, each once."""
    if not terms:
        return ()
    found = (part for term in terms for part in parts_of(term))
    return tuple(dict.fromkeys(path for part in found if (path := getattr(part, "register", ""))))


def givens_in(*terms: Any) -> tuple[str, ...]:
    """The givens that terms need, those of their conditions too, each once."""
    found = (part for term in terms for part in parts_of(term))
    return tuple(dict.fromkeys(name for part in found if (name := getattr(part, "given", ""))))
