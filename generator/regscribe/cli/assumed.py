"""The state of a device that a command takes for granted: its defaults, and what `--with` and `--given` say."""

from collections.abc import Sequence
from fractions import Fraction

import click

from regscribe.checks.known import default_values, with_fields
from regscribe.cli.simulate import given_value
from regscribe.model import Model, RegisterMap, exact
from regscribe.model.reference import Surroundings


def surroundings(register_map: RegisterMap, model: Model, state: Sequence[str], givens: Sequence[str]) -> Surroundings:
    """Return what is known: each of `state` is PATH=VALUE (a number or a member's id), each of `givens` ID=VALUE.

    Raises click.UsageError for a register that the model has not, or a text that is no value of it.
    """
    said = dict(_said(model, text) for text in state)
    values = with_fields(model, default_values(model) | said)
    facts = dict(given_value(text, register_map) for text in givens)
    codes = {name: frozenset(map(Fraction, value)) for name, value in facts.items() if not isinstance(value, bool)}
    return Surroundings(values, codes, {name: value for name, value in facts.items() if isinstance(value, bool)})


def _said(model: Model, text: str) -> tuple[str, Fraction]:
    path, equals, value = text.partition("=")
    register = next((each for each in model.registers if each.path == path), None)
    if not equals or register is None:
        message = f"--with {text}: write PATH=VALUE, PATH being a register of {model.name}"
        raise click.UsageError(message)
    members = {member.id: Fraction(member.code) for member in register.enum.members} if register.enum else {}
    try:
        return path, members[value.upper()] if value.upper() in members else exact(value)
    except ValueError:
        known = f"a number or one of {', '.join(members)}" if members else "a number"
        message = f"--with {text}: the value of `{path}` is {known}"
        raise click.UsageError(message) from None
