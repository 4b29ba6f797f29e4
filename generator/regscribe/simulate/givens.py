"""Conditions on the present state, with the facts that the map does not hold (givens) supplied from outside."""

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction
from typing import TypeVar

from regscribe.model import Case, Condition, Given, GivenKind, Is, Lookup, Model, RegisterMap
from regscribe.simulate.errors import SimulatorError

T = TypeVar("T")

GivenValue = bool | Iterable[int]
"""A boolean given is True or False; a codes given is the register's codes, such as {8, 9} or range(13, 19)."""


class Givens:
    """The givens of one model, checked once: every one that its conditions ask about is there, and no other.

    Raises SimulatorError with the map's own description of what is missing.
    """

    __slots__ = ("_codes", "_flags")

    def __init__(self, register_map: RegisterMap, model: Model, values: Mapping[str, GivenValue]) -> None:
        declared = {given.id: given for given in register_map.givens}
        _refuse_unknown(declared, values)
        _demand_used(declared, values, model)
        kinds = {name: declared[name].kind for name in values}
        self._flags = {name: bool(value) for name, value in values.items() if kinds[name] is GivenKind.BOOLEAN}
        self._codes = {name: _codes(name, value) for name, value in values.items() if name not in self._flags}

    def holds(self, condition: Condition, lookup: Lookup) -> bool:
        """Tell whether all tests of `condition` hold for the values that `lookup` finds."""
        return all(self._passes(test, lookup) for test in condition.tests)

    def choose(self, cases: Iterable[Case[T]], lookup: Lookup) -> T | None:
        """Return what the first case that holds says; None if none holds."""
        return next((case.then for case in cases if self.holds(case.when, lookup)), None)

    def _passes(self, test: Is, lookup: Lookup) -> bool:
        if not test.register:
            return self._flags[test.given] != test.negated
        value = lookup(test.subject)
        if test.given:
            return (value in self._codes[test.given]) != test.negated
        return test.lists(value) != test.negated


def _conditions(model: Model) -> Iterator[Condition]:
    for register in model.registers:
        yield from (case.when for case in register.scale)
        yield from (case.when for case in register.range)
        if register.writable is not None:
            yield register.writable.when


def _codes(name: str, value: GivenValue) -> frozenset[Fraction]:
    if isinstance(value, bool | str):
        message = (
            f"given {name!r} is {value!r}, but the map asks for a collection of register codes: give e.g. {{1, 2}}"
        )
        raise SimulatorError(message)
    return frozenset(Fraction(code) for code in value)


def _refuse_unknown(declared: Mapping[str, Given], values: Mapping[str, GivenValue]) -> None:
    for name in values:
        if name not in declared:
            known = ", ".join(declared) or "none"
            message = f"given {name!r} is not declared by the map (it declares: {known}): remove it or correct the name"
            raise SimulatorError(message)


def _demand_used(declared: Mapping[str, Given], values: Mapping[str, GivenValue], model: Model) -> None:
    used = {test.given for condition in _conditions(model) for test in condition.tests}
    for name in used & declared.keys() - values.keys():
        raise _missing(declared[name], model)


def _missing(given: Given, model: Model) -> SimulatorError:
    form = "True or False" if given.kind is GivenKind.BOOLEAN else f"the codes of {given.register}, e.g. {{1, 2}}"
    why = f" ({given.reason})" if given.reason else ""
    return SimulatorError(
        f"model {model.name} needs the given {given.id!r}: {given.description}{why}. Supply {form}: "
        f"givens={{{given.id!r}: ...}}"
    )
