"""Values and givens as users give them: numbers, names, faults, facts; and the bit fields of stored numbers."""

from collections.abc import Iterable, Iterator, Mapping
from decimal import Decimal
from enum import StrEnum
from fractions import Fraction
from types import MappingProxyType

from regscribe.model import (
    NAN,
    BitField,
    Enum,
    Given,
    GivenKind,
    GivenRef,
    Model,
    NotANumber,
    Register,
    RegisterMap,
    exact,
    parse,
)
from regscribe.reference import Surroundings, surroundings_of
from regscribe.simulate.errors import SimulatorError
from regscribe_runtime.values.terms import parts_of

Plain = str | float | Fraction | Decimal | NotANumber
"""A value that a user may give: a number or NaN, or a text that is a number or its name."""

GivenValue = bool | float | Fraction | str | Iterable[int]
"""A boolean given is True or False; a codes given is the register's codes, such as {8, 9} or range(13, 19)."""


class Fault(StrEnum):
    """A fault of a sensor without its name in the map: the sentinel with the lowest or the highest number."""

    LOW = "low"
    HIGH = "high"


LOW_FAULT, HIGH_FAULT = Fault.LOW, Fault.HIGH


def sentinel_of(register: Register, fault: Fault) -> Fraction | NotANumber:
    """Return the stored number of a fault; SimulatorError if the register has none."""
    if not register.sentinels:
        message = f"register {register.path!r} has no faults: the map gives it no sentinels"
        raise SimulatorError(message)
    if not register.faults:  # the only fault is what is no number
        return NAN
    return min(register.faults) if fault is Fault.LOW else max(register.faults)


def fault_named(register: Register, name: str) -> Fraction | NotANumber | None:
    """Return the stored number of the fault of this id, or of a `Fault`; None if it is none's."""
    if isinstance(name, Fault):
        return sentinel_of(register, name)
    found = next((each.stored for each in register.sentinels if each.id.lower() == name.lower()), None)
    return found if found is None or isinstance(found, NotANumber) else Fraction(found)


def field_value(word: Fraction, field: BitField) -> Fraction:
    """Return the number that the bits of `field` spell in `word`."""
    return Fraction(int(word) >> field.low & (1 << field.width) - 1)


def with_field(word: Fraction, field: BitField, value: Fraction) -> Fraction:
    """`word` with the bits of `field` set to `value`, which is cut to the field's width."""
    mask = (1 << field.width) - 1
    return Fraction(int(word) & ~(mask << field.low) | (int(value) & mask) << field.low)


def codes_of(enum: Enum | None) -> dict[str, Fraction]:
    """Return the codes of the members of an enum by their ids in small letters, of those that have one code."""
    return {name: Fraction(code) for name, code in enum.codes.items()} if enum else {}


def number_of(
    register: Register, field: BitField | None, value: Plain, names: Mapping[str, Fraction] = MappingProxyType({})
) -> Fraction:
    """Return the number that `value` is or names: an enum member or a special value by its id, else decimals.

    `names` are the special values as values of use, and the members that exist now, by id. The number that a special
    value stands for counts as the special value. Raises SimulatorError if `value` is neither.
    """
    if isinstance(value, str):
        known = codes_of(field.enum if field else register.enum)
        known |= {name.lower(): number for name, number in names.items()}
        by_case = register.enum is not None and register.enum.cases and not value[:1].isdigit()
        name = (value.rpartition(".")[2] if by_case else value).lower()  # backups say of which enum a member is
        if name in known:
            return known[name]
    try:
        number = parse(value) if isinstance(value, str) else exact(value)  # type: ignore[arg-type] # refuses NAN
    except ValueError:
        message = f"{value!r} is no value of {register.path!r}: give a number or the id of a value"
        raise SimulatorError(message) from None
    means = {each.means: names[each.id] for each in register.specials if each.means is not None and names}
    return means.get(number, number)


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
    inside = {register.block for register in model.registers}
    bases = {block.given for block in register_map.blocks if block.id in inside}
    used = {*_used_givens(model), *bases} - values.keys() if declared else set()
    missing = [given for given in register_map.givens if given.id in used and given.default is None]
    if missing:
        raise _missing(missing[0], model)
    try:
        return surroundings_of(register_map, {name: _stated(declared[name], value) for name, value in values.items()})
    except ValueError as error:
        raise SimulatorError(str(error)) from None


def _stated(given: Given, value: GivenValue) -> bool | str | Fraction | frozenset[Fraction]:
    if given.kind is GivenKind.CODES or not isinstance(value, bool | str | int | float | Fraction):
        return _codes(given.id, value)
    return value if isinstance(value, bool | str) else exact(value)


def _used_givens(model: Model) -> Iterator[str]:
    whens = [register.when for register in model.registers]
    whens += [one.when for command in model.commands for one in (command, *command.steps)]
    whens += [when for program in model.programs for when in program.conditions]
    yield from (test.given for when in whens for test in when.leaves if test.given)
    for register in model.registers:
        permission = (register.writable,) if register.writable else ()
        named = (*register.sentinels, *register.partial)
        for case in (*register.scale, *register.range, *register.valid, *named, *permission):
            yield from (test.given for test in case.when.leaves)
        for part in parts_of((register.scale, register.range, register.views)):
            yield from [part.given] if isinstance(part, GivenRef) else []


def _codes(name: str, value: GivenValue) -> frozenset[Fraction]:
    if isinstance(value, bool | str | int | float | Fraction):
        message = (
            f"given {name!r} is {value!r}, but the map asks for a collection of register codes: give e.g. {{1, 2}}"
        )
        raise SimulatorError(message)
    return frozenset(Fraction(code) for code in value)


def _missing(given: Given, model: Model) -> SimulatorError:
    form = {
        GivenKind.BOOLEAN: "True or False",
        GivenKind.CODES: f"the codes of {given.register}, e.g. {{1, 2}}",
        GivenKind.NUMBER: "a number",
        GivenKind.CHOICE: f"one of {', '.join(given.choices)}",
    }[given.kind]
    why = f" ({given.reason})" if given.reason else ""
    return SimulatorError(
        f"model {model.name} needs the given {given.id!r}: {given.description}{why}. Supply {form}: "
        f"givens={{{given.id!r}: ...}}"
    )
