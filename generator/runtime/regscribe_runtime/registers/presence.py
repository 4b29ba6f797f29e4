"""Things that exist only under a condition: whether they do in a state of the device, and the error if they do not."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from regscribe_runtime.errors import NotDecodable, NotPresent, RegscribeError
from regscribe_runtime.registers.enums import Choice, SpecialNumber
from regscribe_runtime.values.conditions import Condition, Givens, Is, State

Unknown = Mapping[str, RegscribeError]
"""Registers without a known value: the error by path."""
NOTHING: Unknown = MappingProxyType({})


def absence(
    path: str, when: Condition, state: State, givens: Givens, unknown: Unknown = NOTHING
) -> RegscribeError | None:
    """Why the thing at `path` does not exist in `state`, or why that cannot be told; None if it exists.

    What depends on a register that does not exist does not exist either. KeyError for a register of which nothing is
    known.
    """
    if when.always:
        return None
    known = {name: state[name] for name in when.registers if name in state and name not in unknown}
    try:
        if when.holds(known, givens):
            return None
    except KeyError as error:
        name = next((each for each in when.registers if isinstance(unknown.get(each), NotPresent)), str(error.args[0]))
        if name not in unknown:
            raise
        if isinstance(unknown[name], NotPresent):
            return NotPresent(path, condition_text(when), {name: "not present"})
        return NotDecodable(path, f"whether it exists depends on {name}: {unknown[name]}")
    return NotPresent(path, condition_text(when), seen(when, known, givens))


def condition_text(when: Condition) -> str:
    """A condition in words, with its name if it has one."""
    return f"{when.name} ({when.words})" if when.name else when.words


def seen(when: Condition, state: State, givens: Givens) -> dict[str, str]:
    """The values that a condition tests, in words, by register (or bit field) or `given.id`."""
    known = [test for test in when.leaves if not test.register or test.register in state]
    return dict(_given(test, givens) if not test.register else _tested(test, state) for test in known)


def _given(test: Is, givens: Givens) -> tuple[str, str]:
    return test.subject, str(givens[test.given])


def _tested(test: Is, state: State) -> tuple[str, str]:
    value = state[test.register]
    for name in getattr(value, "parts", ()) if test.bits else ():
        part = vars(type(value))[name]
        if (part.low, part.high) == test.bits:
            return test.subject, value_text(getattr(value, name))
    if test.bits:
        low, high = test.bits
        value = int(value) >> low & ((1 << (high - low + 1)) - 1)
    return test.subject, value_text(value)


def value_text(value: Any) -> str:
    """A value in words: the name of an enum member, else its repr."""
    return str(value.name) if isinstance(value, Choice | SpecialNumber) else repr(value)
