"""Things that exist only under a condition: whether they do in a state of the device, and the error if they do not."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from regscribe_runtime.errors import NotDecodable, NotPresent, RegscribeError
from regscribe_runtime.registers.enums import Choice, SpecialNumber
from regscribe_runtime.values.conditions import AnyOf, Cases, Condition, Givens, Is, State

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
            return NotPresent(path, condition_text(when, known), {name: "not present"})
        return NotDecodable(path, f"whether it exists depends on {name}: {unknown[name]}")
    return NotPresent(path, condition_text(when, known), seen(when, known, givens))


def missing(path: str, partial: Cases[str], state: State, givens: Givens) -> Mapping[str, NotPresent]:
    """What of the value of a register does not exist in `state`, by name, with the error of each.

    A name that stands in several cases exists in each of them.
    """
    whens: dict[str, list[Condition]] = {}
    for when, name in partial:
        whens.setdefault(name, []).append(when)
    found = {}
    for name, several in whens.items():
        when = several[0] if len(several) == 1 else Condition((AnyOf(tuple(several)),))
        if not when.holds(state, givens):
            found[name] = NotPresent(f"{path}.{name}", condition_text(when, state), seen(when, state, givens))
    return found


def condition_text(when: Condition, state: State) -> str:
    """A condition in words, with its name if it has one; codes with the names that they have in `state`."""
    words = when.told(lambda test, code: _end(test, code, state))
    return f"{when.name} ({words})" if when.name else words


def seen(when: Condition, state: State, givens: Givens) -> dict[str, str]:
    """The values that a condition tests, in words, by register (or bit field) or `given.id`."""
    known = [test for test in when.leaves if not test.register or test.register in state]
    return {test.subject: value_text(_tested(test, state)) if test.register else _given(test, givens) for test in known}


def _given(test: Is, givens: Givens) -> str:
    return str(givens[test.given])


def _end(test: Is, code: Any, state: State) -> str:
    """A code that a test compares: with its name, where the value that is tested has one, too."""
    value = _tested(test, state) if test.register in state else None
    members = type(value) if isinstance(value, Choice | SpecialNumber) else ()
    return next((value_text(member) for member in members if member.value == code), test.end(code))


def _tested(test: Is, state: State) -> Any:
    """What a test looks at: the value of a register, or of a part of it."""
    value = state[test.register]
    if not test.bits:
        return value
    for name in getattr(value, "parts", ()):
        part = vars(type(value))[name]
        if (part.low, part.high) == test.bits:
            return part.of(int(value))
    low, high = test.bits
    return int(value) >> low & ((1 << (high - low + 1)) - 1)


def value_text(value: Any) -> str:
    """A value in words: of a member its name and its code, else its repr."""
    return f"{value.name} ({value.value:g})" if isinstance(value, Choice | SpecialNumber) else repr(value)
