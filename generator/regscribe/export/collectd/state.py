"""The state of a device for which a poll is worked out: its defaults, and what `--with` and `--given` say."""

import re
from collections.abc import Sequence
from fractions import Fraction

from regscribe.checks.assumed_values import default_values, with_fields
from regscribe.model import GivenKind, Model, RegisterMap, parse
from regscribe.plugins import OptionError
from regscribe.reference import Surroundings

NUMBER = re.compile(r"-?[0-9]{1,20}(\.[0-9]{1,20})?")
"""A decimal of a sane length: an exponent may ask for more digits than there is memory."""

CODES = re.compile(r"\s*(-?[0-9]{1,6})(?:\.\.(-?[0-9]{1,6}))?\s*")
MOST_CODES = 0x10000
FACTS = {"true": True, "false": False}


def surroundings(register_map: RegisterMap, model: Model, state: Sequence[str], givens: Sequence[str]) -> Surroundings:
    """Return what is known: each of `state` is PATH=VALUE (a number or a member's id), each of `givens` ID=VALUE.

    Raises OptionError for a register that the model has not, or a text that is no value of it.
    """
    values = with_fields(model, default_values(model) | dict(_said(model, text) for text in state))
    codes: dict[str, frozenset[Fraction]] = {}
    facts: dict[str, bool] = {}
    kinds = {given.id: given.kind for given in register_map.givens}
    for text in givens:
        name, _, value = text.partition("=")
        if name not in kinds:
            message = f"--given {text}: write ID=VALUE; {register_map.id} has the givens {', '.join(kinds) or '(none)'}"
            raise OptionError(message)
        if kinds[name] is GivenKind.CODES:
            codes[name] = _codes(text, value)
        else:
            facts[name] = _fact(text, value)
    return Surroundings(values, codes, facts)


def _said(model: Model, text: str) -> tuple[str, Fraction]:
    path, equals, value = text.partition("=")
    register = next((each for each in model.registers if each.path == path), None)
    if not equals or register is None:
        message = f"--with {text}: write PATH=VALUE, PATH being a register of {model.name}"
        raise OptionError(message)
    members = {member.id: Fraction(member.code) for member in register.enum.members} if register.enum else {}
    if value.upper() in members:
        return path, members[value.upper()]
    if not NUMBER.fullmatch(value):
        known = f"a number or one of {', '.join(members)}" if members else "a number"
        message = f"--with {text}: the value of `{path}` is {known}"
        raise OptionError(message)
    return path, parse(value)


def _codes(text: str, value: str) -> frozenset[Fraction]:
    codes: set[Fraction] = set()
    for part in value.split(","):
        found = CODES.fullmatch(part)
        first, last = (int(found[1]), int(found[2] or found[1])) if found else (0, -1)
        if last - first not in range(MOST_CODES):
            message = f"--given {text}: `{part}` is neither a code nor a range of codes; for example 1,4..6"
            raise OptionError(message)
        codes.update(map(Fraction, range(first, last + 1)))
    return frozenset(codes)


def _fact(text: str, value: str) -> bool:
    if value not in FACTS:
        message = f"--given {text}: it is true or false"
        raise OptionError(message)
    return FACTS[value]
