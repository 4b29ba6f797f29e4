"""Values to try of the registers that a meaning depends on: ends of each code range, their neighbours, each order."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from regscribe.model import (
    ByCase,
    Cases,
    Condition,
    Decimals,
    GivenKind,
    GivenRef,
    Is,
    Model,
    Number,
    Open,
    Order,
    OrderCases,
    Power,
    Range,
    Ref,
    Register,
    RegisterMap,
    Term,
    View,
)
from regscribe.reference.settled_scales import MOST_DECIMALS
from regscribe.reference.states import Stretch, domain, domain_of_given, listed, representatives
from regscribe_runtime.values.terms import parts_of, registers_in
from regscribe_runtime.values.versions import version_key

EXPONENTS = tuple(map(Fraction, (-3, -1, 0, 2, 11)))
"""Numbers to try of an exponent, the last beyond those of any device."""
AMOUNTS = tuple(map(Fraction, (0, 1, 40)))
"""Numbers to try of a factor, a divisor, a summand, a limit."""

GivenTry = frozenset[Fraction] | bool | str
Values = dict[str, tuple[Fraction, ...]]
Domain = tuple[Stretch, ...]
VERSIONS = (Stretch(Fraction(0), Fraction(version_key("99.99.99") or 0)),)
"""Keys of the versions that are tried."""


@dataclass(frozen=True, slots=True)
class TriedValues:
    """Values to try by `register` or `register.field`, and what the givens may be, by id.

    `parts` has the register and the lowest bit of each `register.field`; `versions` are texts: their values are keys.
    """

    values: Values
    givens: dict[str, tuple[GivenTry, ...]]
    parts: dict[str, tuple[str, int]]
    versions: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Dependencies:
    """Dependencies of the meaning of a register: conditions, numbers of decimals, terms."""

    conditions: tuple[Condition, ...]
    decimals: tuple[Decimals, ...] = ()
    terms: tuple[Term, ...] = ()
    orders: tuple[OrderCases, ...] = ()

    @property
    def tests(self) -> tuple[Is, ...]:
        """The tests of all conditions, those in terms too."""
        within = (case.when for part in parts_of(self.terms) if isinstance(part, ByCase) for case in part.cases)
        return tuple(test for condition in (*self.conditions, *within) for test in condition.leaves)


def dependencies_of(register: Register, view: View) -> Dependencies:
    """Return the dependencies of reading `view`, and of writing it if it can be written."""
    conditions = [register.when] if not register.when.always else []
    conditions += [case.when for case in (*register.scale, *register.special_scale)]
    conditions += [sentinel.when for sentinel in register.sentinels]
    conditions += [case.when for case in register.partial]
    decimals = [case.then.decimals for case in (*register.scale, *register.special_scale)]
    terms = [term for case in register.scale for term in (case.then.multiply, case.then.add)]
    ranges = (*register.valid, *(register.range if register.access.writable else ()))
    conditions += [case.when for case in ranges]
    decimals += [case.then.decimals for case in ranges]
    terms += [end for end in _ends(ranges) if not isinstance(end, Ref)]  # those have values of their own
    terms += [view.times] if view.times is not None else []
    if register.access.writable:
        decimals += [case.then.places for case in register.scale]
    several = (view.order if view.words > 1 else Order.BIG, view.byte_order)
    orders = tuple(order for order in several if isinstance(order, OrderCases))
    conditions += [case.when for order in orders for case in order.cases]
    unsettled = tuple(term for term in terms if not isinstance(term, Number))
    return Dependencies(tuple(conditions), tuple(filter(None, decimals)), unsettled, orders)


def _ends(cases: Cases[Range]) -> Iterator[Term]:
    """The limits that are not open."""
    for case in cases:
        yield from (end for interval in case.then.intervals for end in interval if not isinstance(end, Open))


def tried_values(register_map: RegisterMap, model: Model, dependencies: Dependencies) -> TriedValues:
    """Return the values to try of everything in `dependencies`."""
    sets = {given.id for given in register_map.givens if given.kind is GivenKind.CODES}
    values: dict[str, set[Fraction]] = {}
    chosen = {test.given for test in dependencies.tests if not test.asks_given}
    givens: dict[str, tuple[GivenTry, ...]] = {
        given.id: given.choices for given in register_map.givens if given.choices and given.id in chosen
    }
    for subject, found in _values(register_map, model, dependencies, sets):
        values.setdefault(subject, set()).update(found)
    return TriedValues(
        {subject: tuple(sorted(found)) for subject, found in values.items()},
        givens | {test.given: _given(model, test, sets) for test in dependencies.tests if test.asks_given},
        {test.subject: (test.register, test.bits[0]) for test in dependencies.tests if test.bits},
        tuple(dict.fromkeys(test.register for test in dependencies.tests if test.version)),
    )


def _values(
    register_map: RegisterMap, model: Model, dependencies: Dependencies, sets: set[str]
) -> Iterator[tuple[str, Iterable[Fraction]]]:
    codes: dict[str, list[tuple[Number, Number]]] = {}
    choices = {given.id for given in register_map.givens if given.choices}
    for test in dependencies.tests:
        codes.setdefault(test.subject, []).extend(test.codes)
    for test in dependencies.tests:
        if test.register and test.given in sets:
            yield test.subject, _first_two(_domain(model, test))
        elif not test.asks_given and test.given not in choices and test.subject in codes:
            domain_now = _domain_in(register_map, model, test)
            yield test.subject, representatives(domain_now, codes.pop(test.subject))
    for decimals in dependencies.decimals:
        yield decimals.register, _places(decimals, domain(model.register(decimals.register)))
    yield from _amounts(register_map, model, dependencies.terms)
    for by_code in filter(None, (order.by_code() for order in dependencies.orders)):
        yield by_code[0], (Fraction(max(code for code, _ in by_code[1]) + 1),)  # one without an order


def _amounts(
    register_map: RegisterMap, model: Model, terms: tuple[Term, ...]
) -> Iterator[tuple[str, Iterable[Fraction]]]:
    """The registers of terms with numbers that make a difference to them, as far as these are of the register."""
    exponents = {part.exponent for part in parts_of(terms) if isinstance(part, Power)}
    powers = {path for exponent in exponents for path in registers_in(exponent)}
    for path in dict.fromkeys(part.register for part in parts_of(terms) if isinstance(part, Ref)):
        stretches = domain(model.register(path))
        tried = EXPONENTS if path in powers else AMOUNTS
        found = [number for number in tried if any(stretch.holds(number) for stretch in stretches)]
        yield path, found or [stretches[0].low]
    asked = {part.given for part in parts_of(terms) if isinstance(part, GivenRef)}
    for given in register_map.givens:
        if given.id in asked:
            low, high = domain_of_given(given)[0]
            yield f"given.{given.id}", [number for number in AMOUNTS if low <= number <= high] or [low]


def _given(model: Model, test: Is, sets: set[str]) -> tuple[GivenTry, ...]:
    """Return the choices for a given: false and true, or a set of the second value of its register alone."""
    return (frozenset({_first_two(_domain(model, test))[1]}),) if test.given in sets else (False, True)


def _domain_in(register_map: RegisterMap, model: Model, test: Is) -> Domain:
    """The domain of what a test of codes asks for."""
    if test.version:
        return VERSIONS
    if not test.register:
        return next(domain_of_given(given) for given in register_map.givens if given.id == test.given)
    return _domain(model, test)


def _domain(model: Model, test: Is) -> Domain:
    return domain(model.register(test.register), test.field)


def _first_two(stretches: Domain) -> tuple[Fraction, Fraction]:
    found = listed(stretches)
    return (found[0], found[1]) if len(found) > 1 else (Fraction(0), Fraction(1))


def _places(decimals: Decimals, stretches: Domain) -> Iterable[Fraction]:
    most = MOST_DECIMALS if decimals.at_most is None else decimals.at_most + 1
    return listed(stretches) or map(Fraction, range(most + 1))
