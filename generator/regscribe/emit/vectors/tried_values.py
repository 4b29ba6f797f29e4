"""Values to try of the registers that a meaning depends on: ends of each code range, their neighbours, each order."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from regscribe.model import (
    Condition,
    Decimals,
    GivenKind,
    Is,
    Model,
    Number,
    OrderFrom,
    Register,
    RegisterMap,
    View,
)
from regscribe.reference.settled_scales import MOST_DECIMALS
from regscribe.reference.states import Stretch, domain, listed, representatives

GivenTry = frozenset[Fraction] | bool
Values = dict[str, tuple[Fraction, ...]]
Domain = tuple[Stretch, ...]


@dataclass(frozen=True, slots=True)
class TriedValues:
    """Values to try by `register` or `register.field`, and what the givens may be, by id.

    `parts` has the register and the lowest bit of each `register.field`.
    """

    values: Values
    givens: dict[str, tuple[GivenTry, ...]]
    parts: dict[str, tuple[str, int]]


@dataclass(frozen=True, slots=True)
class Dependencies:
    """Dependencies of the meaning of a register: conditions, numbers of decimals and perhaps the word order."""

    conditions: tuple[Condition, ...]
    decimals: tuple[Decimals, ...] = ()
    order: OrderFrom | None = None

    @property
    def tests(self) -> tuple[Is, ...]:
        """The tests of all conditions."""
        return tuple(test for condition in self.conditions for test in condition.tests)


def dependencies_of(register: Register, view: View) -> Dependencies:
    """Return the dependencies of reading `view`, and of writing it if it can be written."""
    conditions = [case.when for case in (*register.scale, *register.special_scale)]
    decimals = [case.then.decimals for case in (*register.scale, *register.special_scale)]
    if register.access.writable:
        conditions += [case.when for case in register.range]
        decimals += [case.then.decimals for case in register.range]
        decimals += [case.then.places for case in register.scale]
    order = view.order if isinstance(view.order, OrderFrom) and view.words > 1 else None
    return Dependencies(tuple(conditions), tuple(filter(None, decimals)), order)


def tried_values(register_map: RegisterMap, model: Model, dependencies: Dependencies) -> TriedValues:
    """Return the values to try of everything in `dependencies`."""
    sets = {given.id for given in register_map.givens if given.kind is GivenKind.CODES}
    values: dict[str, set[Fraction]] = {}
    for subject, found in _values(model, dependencies, sets):
        values.setdefault(subject, set()).update(found)
    return TriedValues(
        {subject: tuple(sorted(found)) for subject, found in values.items()},
        {test.given: _given(model, test, sets) for test in dependencies.tests if test.given},
        {test.subject: (test.register, test.bits[0]) for test in dependencies.tests if test.bits},
    )


def _values(model: Model, dependencies: Dependencies, sets: set[str]) -> Iterator[tuple[str, Iterable[Fraction]]]:
    codes: dict[str, list[tuple[Number, Number]]] = {}
    for test in dependencies.tests:
        codes.setdefault(test.subject, []).extend(test.codes)
    for test in dependencies.tests:
        if test.given in sets:
            yield test.subject, _first_two(_domain(model, test))
        elif not test.given and test.subject in codes:
            yield test.subject, representatives(_domain(model, test), codes.pop(test.subject))
    for decimals in dependencies.decimals:
        yield decimals.register, _places(decimals, domain(model.register(decimals.register)))
    if dependencies.order is not None:
        known = [Fraction(code) for code, _ in dependencies.order.codes]
        yield dependencies.order.register, (*known, max(known) + 1)


def _given(model: Model, test: Is, sets: set[str]) -> tuple[GivenTry, ...]:
    """Return the choices for a given: false and true, or a set of the second value of its register alone."""
    return (frozenset({_first_two(_domain(model, test))[1]}),) if test.given in sets else (False, True)


def _domain(model: Model, test: Is) -> Domain:
    return domain(model.register(test.register), test.field)


def _first_two(stretches: Domain) -> tuple[Fraction, Fraction]:
    found = listed(stretches)
    return (found[0], found[1]) if len(found) > 1 else (Fraction(0), Fraction(1))


def _places(decimals: Decimals, stretches: Domain) -> Iterable[Fraction]:
    most = MOST_DECIMALS if decimals.at_most is None else decimals.at_most + 1
    return listed(stretches) or map(Fraction, range(most + 1))
