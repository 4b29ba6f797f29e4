"""Which values of other registers are worth trying: both ends of each code range, what lies beside, each order."""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from regscribe.model import (
    BitField,
    Condition,
    Decimals,
    GivenKind,
    Model,
    Number,
    OrderFromRegister,
    Register,
    RegisterMap,
    Test,
    View,
)

GivenTry = frozenset[Fraction] | bool
Values = dict[str, tuple[Fraction, ...]]
WIDEST_DOMAIN = 32
"""A range of whole numbers up to this wide is taken as the list of a register's values."""
MOST_DECIMALS = 3
"""Decimals tried where the map sets no limit."""


@dataclass(frozen=True, slots=True)
class Tries:
    """Values to try by `register` or `register.field`, and what the givens may be, by id.

    `parts` tells of a `register.field` which register it is a part of and at which bit it begins.
    """

    values: Values
    givens: dict[str, tuple[GivenTry, ...]]
    parts: dict[str, tuple[str, int]]


@dataclass(frozen=True, slots=True)
class Questions:
    """What the meaning of a register depends on: conditions, numbers of decimals and perhaps the word order."""

    conditions: tuple[Condition, ...]
    decimals: tuple[Decimals, ...] = ()
    order: OrderFromRegister | None = None


def questions_of(register: Register, view: View) -> Questions:
    """Return what must be known to read `view`, and to write it if it can be written."""
    ranges = register.range if register.access.writable else ()
    scales = (*register.scale, *register.special_scale)
    places = register.scale if register.access.writable else ()
    decimals = [
        *(case.then.decimals for case in scales),
        *(case.then.decimals for case in ranges),
        *(case.then.places for case in places),
    ]
    return Questions(
        (*(case.when for case in scales), *(case.when for case in ranges)),
        tuple(one for one in decimals if one),
        view.word_order if isinstance(view.word_order, OrderFromRegister) and view.words > 1 else None,
    )


def tries_of(register_map: RegisterMap, model: Model, questions: Questions) -> Tries:
    """Collect the values to try for everything that `questions` ask."""
    found: dict[str, set[Fraction]] = {}
    givens: dict[str, tuple[GivenTry, ...]] = {}
    kinds = {given.id: given.kind for given in register_map.givens}
    parts: dict[str, tuple[str, int]] = {}
    for test in (test for condition in questions.conditions for test in condition.tests):
        domain = domain_of(model, test) if test.register else ()
        if test.field:
            parts[test.subject] = (test.register, _field(model, test).low)
        if test.given and kinds.get(test.given) is not GivenKind.CODES:
            givens[test.given] = (False, True)
        elif test.given:
            one, other = _two(domain)
            givens[test.given] = (frozenset({other}),)
            found.setdefault(test.subject, set()).update((one, other))
        else:
            found.setdefault(test.subject, set()).update(_around(test, domain, _lowest(model, test.register)))
    for decimals in questions.decimals:
        found.setdefault(decimals.register, set()).update(_places(decimals, domain_of(model, Test(decimals.register))))
    if questions.order is not None:
        found.setdefault(questions.order.register, set()).update(_orders(questions.order))
    return Tries({name: tuple(sorted(values)) for name, values in found.items()}, givens, parts)


def domain_of(model: Model, test: Test) -> tuple[Fraction, ...]:
    """Return the values that the subject of a test has, in order; empty where there are too many to list."""
    register = model.register(test.register)
    bits = _field(model, test) if test.field else None
    enum = bits.enum if bits else register.enum
    if enum is not None:
        return tuple(sorted(Fraction(member.code) for member in enum.members))
    if bits is not None:
        return tuple(Fraction(code) for code in range(min(1 << bits.width, WIDEST_DOMAIN)))
    ends = [(interval.low, interval.high) for case in register.range[:1] for interval in case.then.intervals]
    listed = [
        range(int(low.value), int(high.value) + 1)
        for low, high in ends
        if isinstance(low, Number) and isinstance(high, Number) and high.value - low.value <= WIDEST_DOMAIN
    ]
    whole = len(listed) == len(ends)
    return tuple(sorted({Fraction(code) for codes in listed for code in codes})) if whole else ()


def _field(model: Model, test: Test) -> BitField:
    return next(bits for bits in model.register(test.register).fields if bits.id == test.field)


def _two(domain: tuple[Fraction, ...]) -> tuple[Fraction, Fraction]:
    return (domain[0], domain[1]) if len(domain) > 1 else (Fraction(0), Fraction(1))


def _lowest(model: Model, path: str) -> Fraction:
    return Fraction(model.register(path).base.type.minimum)


def _around(test: Test, domain: tuple[Fraction, ...], lowest: Fraction) -> Iterable[Fraction]:
    if not domain:
        beside = {end for codes in test.codes for end in (codes.low, codes.high, codes.low - 1, codes.high + 1)}
        return {value for value in beside if value >= lowest}
    inside = [[value for value in domain if codes.holds(value)] for codes in test.codes]
    outside = [value for value in domain if not any(codes.holds(value) for codes in test.codes)]
    return {end for values in (*inside, outside) if values for end in (values[0], values[-1])}


def _places(decimals: Decimals, domain: tuple[Fraction, ...]) -> Iterable[Fraction]:
    if domain:
        return domain
    most = MOST_DECIMALS if decimals.at_most is None else decimals.at_most + 1
    return (Fraction(places) for places in range(most + 1))


def _orders(order: OrderFromRegister) -> Iterable[Fraction]:
    listed = [Fraction(code) for code, _ in order.codes]
    return (*listed, max(listed) + 1)
