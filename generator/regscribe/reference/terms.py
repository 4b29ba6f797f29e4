"""Terms and scales under present values: what a map gives by registers and givens, as exact numbers."""

from fractions import Fraction
from typing import NamedTuple

from regscribe.reference.outcome import UnknownValueError
from regscribe.reference.surroundings import Known, choose, decimal_factor
from regscribe_runtime.values.scales import Conversion
from regscribe_runtime.values.terms import ByCase, GivenRef, Largest, Power, Product, Ref, Smallest, Sum, Term
from regscribe_runtime.values.views import View

MOST_EXPONENT = 10
"""No device scales by more than ten to the power of it, nor by less than its inverse."""


class Straight(NamedTuple):
    """A scale as things stand: value = `slope` x stored + `offset`, `slope` not 0."""

    slope: Fraction
    offset: Fraction

    def value(self, stored: Fraction) -> Fraction:
        """Return the value of use of a stored number."""
        return self.slope * stored + self.offset

    def stored(self, value: Fraction) -> Fraction:
        """Return the stored number of a value of use."""
        return (value - self.offset) / self.slope


def amount(term: Term, known: Known) -> Fraction | None:
    """Return the number of a term; None if it has none as things stand. UnknownValueError for an unknown value."""
    found: Fraction | None
    if isinstance(term, Ref):
        found = known.look_up(term.register)
    elif isinstance(term, GivenRef):
        if term.given not in known.numbers:
            raise UnknownValueError(term.given)
        found = known.numbers[term.given]
    elif isinstance(term, ByCase):
        chosen = choose(term.cases, known)
        found = None if chosen is None else amount(chosen, known)
    elif isinstance(term, Power):
        found = _power_of_ten(amount(term.exponent, known))
    elif isinstance(term, Product):
        found = _quotient(_all(term.factors, known), _all(term.divisors, known))
    elif isinstance(term, Sum):
        summands = _all(term.terms, known)
        found = None if summands is None else sum(summands, Fraction(0))
    elif isinstance(term, Largest | Smallest):
        several = sorted(_all(term[0], known) or ())
        found = None if not several else several[-1] if isinstance(term, Largest) else several[0]
    else:
        found = Fraction(term)
    return found


def _power_of_ten(exponent: Fraction | None) -> Fraction | None:
    if exponent is None or exponent.denominator != 1 or not -MOST_EXPONENT <= exponent <= MOST_EXPONENT:
        return None
    shifted = Fraction(10 ** abs(int(exponent)))
    return shifted if exponent >= 0 else 1 / shifted


def _all(terms: tuple[Term, ...], known: Known) -> list[Fraction] | None:
    found = [amount(term, known) for term in terms]
    return None if None in found else [number for number in found if number is not None]


def _quotient(factors: list[Fraction] | None, divisors: list[Fraction] | None) -> Fraction | None:
    if factors is None or divisors is None or 0 in divisors:
        return None
    result = Fraction(1)
    for factor in factors:
        result *= factor
    for divisor in divisors:
        result /= divisor
    return result


def present_view(view: View, known: Known) -> View | None:
    """Return a view with the factor that it has now; None if that is no number above 0."""
    if view.times is None:
        return view
    times = amount(view.times, known)
    return None if times is None or times <= 0 else view._replace(factor=view.factor * times, times=None)


def straight(conversion: Conversion | None, known: Known) -> Straight | None:
    """Return a scale as things stand; None without one, or where one of its numbers has no value or makes none."""
    if conversion is None:
        return None
    factor = decimal_factor(conversion.decimals, known)
    if factor is None:
        return None
    multiply, add = amount(conversion.multiply, known), amount(conversion.add, known)
    return None if not multiply or add is None else Straight(multiply / factor, add / factor)
