"""Terms: numbers that a map writes as such or as a fraction, or takes from registers and givens."""

import re
from collections.abc import Callable, Iterable
from fractions import Fraction
from functools import partial
from math import prod

from regscribe.lower.conditions import cases_of
from regscribe.lower.node import ZERO, Value
from regscribe.lower.rules import UNKNOWN_GIVEN, WRONG_SORT
from regscribe.lower.scope import Scope
from regscribe.model import ByCase, GivenRef, Largest, Number, Power, Product, Ref, Smallest, Sum, Term
from regscribe_runtime.values.terms import MOST_POWER

ONE = Fraction(1)
_FRACTION = re.compile(r"\s*(-?[0-9]{1,30})\s*/\s*([0-9]{1,30})\s*")


def term_of(node: Value | None, scope: Scope, otherwise: Fraction = ZERO) -> Term:
    """The term at `node`, `otherwise` where there is none; one that no register or given decides is its number."""
    if node is None:
        return otherwise
    if node.is_list:
        cases = cases_of(node, scope, lambda case: term_of(case.child("is"), scope))
        return cases[0].then if cases and cases[0].when.always else ByCase(cases)
    if node.is_mapping:
        return _built(node, scope)
    if not node.is_text:
        return node.number()
    match = _FRACTION.fullmatch(node.text())
    return _fraction(node, match) if match else Ref(scope.path(node))


def _fraction(node: Value, match: re.Match[str]) -> Fraction:
    if int(match[2]):
        return Fraction(int(match[1]), int(match[2]))
    return _zero(node)


def _zero(node: Value) -> Fraction:
    node.report(WRONG_SORT, "nothing is divided by 0", remedy="give another divisor")
    return ONE


def _built(node: Value, scope: Scope) -> Term:
    """The term of a mapping of one key."""
    return next((_FORMS[key](inside, scope) for key, inside in node.items() if key in _FORMS), ZERO)


def _terms(node: Value, scope: Scope) -> list[Term]:
    return [term_of(each, scope) for each in node.elements()]


def _quotient(node: Value, scope: Scope) -> Term:
    first, *others = node.elements()
    return product([term_of(first, scope)], [_divisor(each, scope) for each in others])


def _extreme(
    kind: type[Largest | Smallest], choose: Callable[[Iterable[Fraction]], Fraction], node: Value, scope: Scope
) -> Term:
    """The largest or the smallest of terms; of numbers alone that number."""
    terms = _terms(node, scope)
    numbers = [Fraction(one) for one in terms if isinstance(one, Number)]
    return choose(numbers) if len(numbers) == len(terms) else kind(tuple(terms))


def _given(node: Value, scope: Scope) -> str:
    found = scope.named(node, "givens", rule=UNKNOWN_GIVEN, what="given")
    if found and found.text_of("type") != "number":
        message = f"the given `{node.text()}` is of type {found.text_of('type')}, number is needed here"
        node.report(UNKNOWN_GIVEN, message, remedy="refer to a given of type number")
    return node.text()


def power_of(node: Value, scope: Scope) -> Term:
    """10 to the power of the term at `node`."""
    exponent = term_of(node, scope)
    if not isinstance(exponent, Number):
        return Power(exponent)
    if exponent.denominator == 1 and -MOST_POWER <= exponent <= MOST_POWER:
        return Fraction(10) ** exponent.numerator
    message = f"10 cannot have the power of {node.text()} in a scale"
    node.report(WRONG_SORT, message, remedy=f"give a whole number from -{MOST_POWER} to {MOST_POWER}")
    return ONE


def divided(term: Term, node: Value | None, scope: Scope) -> Term:
    """A term divided by the term at `node`, if there is one."""
    if node is None:
        return term
    return product([term], [_divisor(node, scope)])


def _divisor(node: Value, scope: Scope) -> Term:
    divisor = term_of(node, scope)
    return _zero(node) if divisor == 0 else divisor


def product(factors: Iterable[Term], divisors: Iterable[Term] = ()) -> Term:
    """The product of terms over the product of others, in one, with its numbers multiplied."""
    over, under = [*factors], [*divisors]
    for each in [one for one in over if isinstance(one, Product)]:
        over += each.factors
        under += each.divisors
    over = [one for one in over if not isinstance(one, Product)]
    number = prod((Fraction(one) for one in over if isinstance(one, Number)), start=ONE)
    number /= prod((Fraction(one) for one in under if isinstance(one, Number)), start=ONE)
    terms, below = (tuple(one for one in part if not isinstance(one, Number)) for part in (over, under))
    if not terms and not below:
        return number
    found = terms if number == 1 and terms else (number, *terms)
    return found[0] if len(found) == 1 and not below else Product(found, below)


def summed(terms: Iterable[Term]) -> Term:
    """The sum of terms, with its numbers added."""
    every = list(terms)
    number = sum((Fraction(one) for one in every if isinstance(one, Number)), ZERO)
    found = tuple(one for one in every if not isinstance(one, Number))
    if not found:
        return number
    return found[0] if len(found) == 1 and not number else Sum((*found, number) if number else found)


_FORMS: dict[str, Callable[[Value, Scope], Term]] = {
    "given": lambda node, scope: GivenRef(_given(node, scope)),
    "power": power_of,
    "product": lambda node, scope: product(_terms(node, scope)),
    "quotient": _quotient,
    "sum": lambda node, scope: summed(_terms(node, scope)),
    "max": partial(_extreme, Largest, max),
    "min": partial(_extreme, Smallest, min),
}
"""The forms of a term that is built of others, by the key."""
