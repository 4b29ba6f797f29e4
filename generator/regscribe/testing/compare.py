"""Compare what a driver decodes and encodes with a vector, and report the differences."""

from collections.abc import Iterable, Iterator
from fractions import Fraction
from typing import Any

from regscribe.testing.vectors import Json, Trial, number
from regscribe_runtime import (
    Flags,
    NotDecodable,
    OutOfRange,
    Saturated,
    SensorFault,
    ValueNotDecodable,
    ValueRefused,
    Word,
)
from regscribe_runtime.registers.octets import OctetType
from regscribe_runtime.registers.register import Register

MOST_SHOWN = 12
"""Differences listed in a failure; more would hide the pattern."""


def differs(where: str, what: str, found: object, expected: object) -> Iterator[str]:
    """Yield a line if the two are not equal."""
    if found != expected:
        yield f"{where}: {what} {found!r}, expected {expected!r}"


def expect_none(differences: Iterable[str]) -> None:
    """Raise AssertionError if there are differences: how many, and the first of them."""
    if listed := list(differences):
        rest = f"\n  ... and {len(listed) - MOST_SHOWN} more" if len(listed) > MOST_SHOWN else ""
        raise AssertionError(f"{len(listed)} differences:\n  " + "\n  ".join(listed[:MOST_SHOWN]) + rest)


def same(found: object, text: str) -> bool:
    """Tell whether a decoded value is the text or number of a vector; a float must be the nearest one."""
    if isinstance(found, str):
        return found == text
    if isinstance(found, float):
        return found == float(Fraction(text))
    return isinstance(found, (int, Fraction)) and found == Fraction(text)


def decoded(trial: Trial, vector: Json) -> Iterator[str]:
    """Yield a line if the words of a vector decode to anything but its value, fault or outcome."""
    where = f"{trial}: words {vector['words']}"
    expected = vector.get("value") or vector.get("fault") or vector.get("outcome")
    try:
        found = spelled(trial.register, trial.decode(vector["words"]))
    except SensorFault as fault:
        yield from differs(where, "fault", fault.fault, vector.get("fault", expected))
    except Saturated:
        yield from differs(where, "outcome", "saturated", vector.get("outcome", expected))
    except OutOfRange:
        yield from differs(where, "outcome", "out_of_range", vector.get("outcome", expected))
    except NotDecodable as error:
        yield from differs(where, "outcome", "not_decodable", vector.get("outcome", f"{expected} ({error})"))
    else:
        yield from _value(where, trial, found, vector, expected)


def _value(where: str, trial: Trial, found: Any, vector: Json, expected: object) -> Iterator[str]:  # noqa: ANN401 (any value)
    named = "special" in vector and not isinstance(found, str)  # its number counts as the range does: by name
    if "value" not in vector or not (named or same(found, vector["value"])):
        yield f"{where}: value {found!r}, expected {expected!r}"
        return
    for key in vector.keys() & {"member", "special"}:  # it has one of them
        yield from _named(where, key, found, vector[key], trial.entry.get(f"{key}s", ()))
    if "unknown" in vector:
        yield from differs(where, "known", getattr(found, "known", None), not vector["unknown"])
        other = trial.entry.get("other", f"unknown code {vector['value']}")
        yield from differs(where, "label", getattr(found, "label", None), other)
    if "flags" in vector:
        yield from differs(where, "flags", _flags(found), {name.lower() for name in vector["flags"]})
    for name, part in vector.get("fields", {}).items():
        value = getattr(found, name, None)
        if not same(value, part):
            yield from differs(where, name, value, part)
    for name, fault in vector.get("part_faults", {}).items():
        yield from differs(where, name, _fault_of(found, name), fault)
    for name in vector.get("parts_out_of_range", ()):
        yield from differs(where, name, _fault_of(found, name), OutOfRange.__name__)
    if isinstance(found, Word):
        yield from differs(where, "absent", sorted(found.absent), sorted(vector.get("absent", ())))


def _fault_of(found: object, name: str) -> str:
    """The fault that a part of a word reports, or that its number is out of range."""
    try:
        return f"the value {getattr(found, name, None)!r}"
    except SensorFault as fault:
        return fault.fault
    except OutOfRange:
        return OutOfRange.__name__


def _named(where: str, key: str, found: object, name: str, members: Iterable[Json]) -> Iterator[str]:
    yield from differs(where, key, getattr(found, "name", None), name)
    label = next((one["label"] for one in members if one["id"] == name), None)
    if label is not None:
        yield from differs(where, "label", getattr(found, "label", None), label)


def _flags(found: object) -> set[str]:
    """The names of the flags that are set."""
    if not isinstance(found, Flags):
        return set()
    return {str(member.name).lower() for member in type(found) if member in found}


def written(trial: Trial, text: str) -> Any:  # noqa: ANN401 (a text or a number)
    """Return the value of a vector as a program hands it over."""
    if isinstance(trial.register.value_type, OctetType):
        return trial.register.value_type.parse(text)
    return text if trial.entry["kind"] == "version" else number(text)


def spelled(register: Register[Any], value: object) -> object:
    """Return a value as vectors have it: texts for whatever bytes spell."""
    return register.value_type.spell(value) if isinstance(register.value_type, OctetType) else value


def encoded(trial: Trial, vector: Json) -> Iterator[str]:
    """Yield a line if the value of a vector encodes to anything but its words."""
    where = f"{trial}: value {vector['value']}"
    try:
        words = trial.encode(written(trial, vector["value"]), rounded=vector.get("rounded", False))
    except (ValueRefused, ValueNotDecodable) as error:
        yield f"{where}: refused ({error}), expected words {vector['words']}"
    else:
        yield from differs(where, "words", list(words), vector["words"])


def refused(trial: Trial, vector: Json) -> Iterator[str]:
    """Yield a line if the value of a vector is not refused."""
    try:
        value = written(trial, vector["value"])
    except ValueError:  # the type of the value has no such one
        return
    try:
        words = trial.encode(value)
    except ValueRefused:
        return
    except ValueNotDecodable as error:
        if vector["reason"] != "condition":
            yield f"{trial}: value {vector['value']}: {error}, expected a refusal ({vector['reason']})"
    else:
        yield f"{trial}: value {vector['value']}: words {list(words)}, expected a refusal ({vector['reason']})"
