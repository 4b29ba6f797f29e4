"""What is given, as conditions ask for it."""

from collections.abc import Mapping
from fractions import Fraction
from types import MappingProxyType

from regscribe.model import Given, GivenKind, RegisterMap
from regscribe.reference.surroundings import Surroundings

Stated = bool | str | Fraction | frozenset[Fraction]
"""A boolean, a choice, a number, or the codes of a register."""


def surroundings_of(
    register_map: RegisterMap, stated: Mapping[str, Stated], values: Mapping[str, Fraction] = MappingProxyType({})
) -> Surroundings:
    """What is given by id, or else its default, beside `values` of registers; ValueError for what cannot be given."""
    numbers: dict[str, Fraction] = {}
    codes: dict[str, frozenset[Fraction]] = {}
    facts: dict[str, bool] = {}
    texts: dict[str, str] = {}
    for given in register_map.givens:
        value = stated.get(given.id, given.default)
        if value is None:
            continue
        if given.kind is GivenKind.NUMBER:
            numbers[given.id] = _number(given, value)
        elif given.kind is GivenKind.CHOICE:
            texts[f"given.{given.id}"] = _choice(given, value)
        elif given.kind is GivenKind.CODES and isinstance(value, frozenset):
            codes[given.id] = value
        else:
            facts[given.id] = bool(value)
    return Surroundings(values, codes, facts, numbers, texts)


def _number(given: Given, value: Stated) -> Fraction:
    if isinstance(value, bool | str | frozenset):
        message = f"{given.id} is a number"
        raise ValueError(message)  # noqa: TRY004 (callers treat every refusal alike)
    if (given.low is not None and value < given.low) or (given.high is not None and value > given.high):
        message = f"{given.id}: {value} lies outside {given.low} to {given.high}"
        raise ValueError(message)
    return Fraction(value)


def _choice(given: Given, value: Stated) -> str:
    if not isinstance(value, str) or value not in given.choices:
        message = f"{given.id} is one of {', '.join(given.choices)}"
        raise ValueError(message)
    return value
