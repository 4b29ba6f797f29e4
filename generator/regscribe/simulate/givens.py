"""Givens: facts that a map does not hold, supplied by the user."""

from collections.abc import Iterable, Iterator, Mapping
from fractions import Fraction

from regscribe.model import Condition, Given, GivenKind, Model, RegisterMap
from regscribe.reference import Surroundings
from regscribe.simulate.errors import SimulatorError

GivenValue = bool | Iterable[int]
"""A boolean given is True or False; a codes given is the register's codes, such as {8, 9} or range(13, 19)."""


def known_givens(register_map: RegisterMap, model: Model, values: Mapping[str, GivenValue]) -> Surroundings:
    """Check the givens of a model: exactly those that the map declares and the model's conditions use.

    Raises SimulatorError for one that is not declared, and with the map's own description for one that is missing.
    """
    declared = {given.id: given for given in register_map.givens}
    for name in values:
        if name not in declared:
            known = ", ".join(declared) or "none"
            message = f"given {name!r} is not declared by the map (it declares: {known}): remove it or correct the name"
            raise SimulatorError(message)
    used = {test.given for condition in _conditions(model) for test in condition.tests}
    for name in used & declared.keys() - values.keys():
        raise _missing(declared[name], model)
    facts = {name: bool(value) for name, value in values.items() if declared[name].kind is GivenKind.BOOLEAN}
    codes = {name: _codes(name, value) for name, value in values.items() if name not in facts}
    return Surroundings(codes=codes, facts=facts)


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


def _missing(given: Given, model: Model) -> SimulatorError:
    form = "True or False" if given.kind is GivenKind.BOOLEAN else f"the codes of {given.register}, e.g. {{1, 2}}"
    why = f" ({given.reason})" if given.reason else ""
    return SimulatorError(
        f"model {model.name} needs the given {given.id!r}: {given.description}{why}. Supply {form}: "
        f"givens={{{given.id!r}: ...}}"
    )
