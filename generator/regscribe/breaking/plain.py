"""Values of the model as plain values that compare: without places in files, without names of conditions.

The old version is said in the words of the new one: what was renamed has its new name.
"""

import re
from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum as PythonEnum
from fractions import Fraction
from types import NoneType
from typing import Any

from regscribe.emit.words import one_line
from regscribe.model import (
    Alarm,
    Array,
    BitField,
    Command,
    CommandStep,
    Condition,
    Decimals,
    Effect,
    Enum,
    ExceptionCode,
    FrameExample,
    Given,
    GivenRef,
    Governs,
    Identity,
    IdentityRule,
    Is,
    Member,
    Model,
    OnOff,
    Open,
    OrderCases,
    Output,
    Page,
    Pid,
    Process,
    ProgramAction,
    ProgramFinal,
    ProgramSegments,
    ProgramStates,
    ProgramTimeUnit,
    Protocol,
    ProtocolNotes,
    Ramp,
    Ref,
    Register,
    RegisterBlock,
    RegisterMap,
    Sentinel,
    SerialDefaults,
    SetpointProgram,
    Special,
    Trip,
    ValueExample,
    View,
    WriteCondition,
)

UNCOMPARED = frozenset({"span", "by_path", "content_hash", "rules", "stated"})
"""Fields that say where something stands in a file, or whether it does, name a rule of it, or only speed a look-up."""

TEXTS: Mapping[type, frozenset[str]] = {
    Member: frozenset({"label", "description", "cells"}),
    Enum: frozenset({"description", "columns", "other", "id"}),
    BitField: frozenset({"label", "description"}),
    Is: frozenset({"field"}),  # its bits say the same
    Special: frozenset({"label"}),
    Sentinel: frozenset({"label"}),
    WriteCondition: frozenset({"reason"}),
    ExceptionCode: frozenset({"name", "meaning"}),
    SetpointProgram: frozenset({"name", "section"}),
    Process: frozenset({"assumed", "section"}),
    ProtocolNotes: frozenset({"section", "serial", "latencies"}),
    Register: frozenset({"name", "symbol", "printed", "description", "section", "inferred", "none"}),
}
"""Fields of parts of things that only readers see."""

PATHS: Mapping[type, frozenset[str]] = {
    Is: frozenset({"register"}),
    Ref: frozenset({"register"}),
    Decimals: frozenset({"register"}),
    Effect: frozenset({"sets", "defaults"}),
    Pid: frozenset({"band", "integral", "derivative", "bias", "ends"}),
    OnOff: frozenset({"hysteresis"}),
    Output: frozenset({"percent", "manual", "failsafe", "low", "high", "active"}),
    Trip: frozenset({"limit"}),
    Alarm: frozenset({"active", "hysteresis", "delay", "inhibit"}),
    Ramp: frozenset({"rises", "falls", "shows"}),
    Process: frozenset({"value", "setpoint", "highest", "lowest", "fault"}),
    SetpointProgram: frozenset(
        {"number_of_segments", "cycles", "holdback", "power_failure", "end", "setpoint_limits", "enable"}
        | {"segment_now", "program_now", "setpoint_now"}
    ),
    ProgramSegments: frozenset({"setpoint", "ramp", "soak", "outputs", "idle"}),
    ProgramFinal: frozenset({"setpoint", "outputs"}),
    ProgramTimeUnit: frozenset({"register"}),
    ProgramStates: frozenset({"register"}),
    ProgramAction: frozenset({"writes"}),
    Identity: frozenset({"texts"}),
    Page: frozenset({"selectors"}),
    Register: frozenset({"shadows", "rereads", "follows"}),
    Array: frozenset({"counted"}),
    Command: frozenset({"step_registers"}),
    Given: frozenset({"register"}),
    ValueExample: frozenset({"register", "state"}),
    FrameExample: frozenset({"writes", "state"}),
}
"""Fields that hold paths of registers, alone or beside numbers and names of outputs."""

IDS: Mapping[type, Mapping[str, str]] = {
    ProgramAction: {"command": "commands"},
    Register: {"unlock": "commands", "apply": "commands"},
    FrameExample: {"command": "commands"},
    Command: {"group": "groups"},
    CommandStep: {"block": "blocks"},
    Is: {"given": "givens"},
    GivenRef: {"given": "givens"},
    RegisterBlock: {"given": "givens"},
}
"""Fields that hold ids of other things, and of which sort these are."""

UNORDERED: Mapping[type, frozenset[str]] = {
    Governs: frozenset({"codes"}),
    ProgramTimeUnit: frozenset({"codes"}),
    ProgramSegments: frozenset({"outputs", "idle"}),
    ProgramFinal: frozenset({"outputs"}),
    Enum: frozenset({"invalid"}),
    Effect: frozenset({"sets", "defaults"}),
    Identity: frozenset({"texts"}),
    IdentityRule: frozenset({"models"}),
    Given: frozenset({"choices"}),
    View: frozenset({"functions"}),
    Protocol: frozenset({"functions", "spaces", "broadcast", "exceptions", "latencies"}),
    ProtocolNotes: frozenset({"latencies"}),
    SerialDefaults: frozenset({"modes", "bauds", "formats"}),
    Model: frozenset({"unused"}),
    RegisterMap: frozenset({"alike", "accepts", "reserved", "notations", "unit_notes"}),
    ValueExample: frozenset({"state"}),
    FrameExample: frozenset({"state"}),
}
"""Fields whose order says nothing: in a map they are mappings, or lists of what is possible."""

INDEX = re.compile(r"\[[^\]]*\]")


@dataclass(frozen=True, slots=True)
class Renames:
    """What is called otherwise now, by its old name: paths of registers, ids of commands, groups, blocks and givens.

    `conditions` are names of conditions that are a change of their own; they count as equal wherever they stand.
    `patterns` are paths without their indices.
    """

    paths: Mapping[str, str] = field(default_factory=dict)
    commands: Mapping[str, str] = field(default_factory=dict)
    groups: Mapping[str, str] = field(default_factory=dict)
    blocks: Mapping[str, str] = field(default_factory=dict)
    givens: Mapping[str, str] = field(default_factory=dict)
    conditions: frozenset[str] = frozenset()
    patterns: Mapping[str, str] = field(default_factory=dict)

    def with_paths(self, paths: Mapping[str, str]) -> "Renames":
        """The same with paths."""
        alike = [(old, new) for old, new in paths.items() if INDEX.findall(old) == INDEX.findall(new) != []]
        patterns = {INDEX.sub("[]", old): INDEX.sub("[]", new) for old, new in alike}
        return replace(self, paths=paths, patterns=patterns)

    @property
    def now(self) -> "Renames":
        """For the new version, which has all its names already."""
        return Renames(conditions=self.conditions)

    def path(self, path: str) -> str:
        """A path, perhaps with a bit field behind it or open indices in it, as it is now."""
        if not self.paths or not path:
            return path
        if path in self.paths:
            return self.paths[path]
        pattern = INDEX.sub("[]", path)
        if pattern in self.patterns:
            indices = iter(INDEX.findall(path))
            return INDEX.sub(lambda _: next(indices, "[]"), self.patterns[pattern])
        owner, dot, part = path.rpartition(".")
        return f"{self.path(owner)}.{part}" if dot and self.path(owner) != owner else path


SAME_NAMES = Renames()


def plain(value: Any, renames: Renames = SAME_NAMES, *, texts: bool = False) -> Hashable:  # noqa: ANN401 (any value of the model)
    """A value of the model as nested tuples; without `texts`, what only readers see is left out."""
    if isinstance(value, Open):
        return ("open", one_line(value) if texts else "")
    if isinstance(value, str | int | Fraction | bytes | NoneType | PythonEnum):
        return _scalar(value)
    if isinstance(value, Condition):
        if value.name in renames.conditions:
            return ("condition", value.name)
        return ("when", frozenset(plain(test, renames, texts=texts) for test in value.tests))
    names = field_names(value)
    if names:
        kept = [name for name in names if name not in UNCOMPARED and (texts or name not in TEXTS.get(type(value), ()))]
        return (type(value).__name__, *(plain_field(value, name, renames, texts=texts) for name in kept))
    return tuple(plain(each, renames, texts=texts) for each in value)


def _scalar(value: str | int | Fraction | bytes | PythonEnum | None) -> Hashable:
    """A text on one line, a number as a fraction, anything else as it is."""
    if isinstance(value, PythonEnum | bool | bytes) or value is None:
        return value
    return one_line(value) if isinstance(value, str) else Fraction(value)


def field_names(value: object) -> tuple[str, ...]:
    """The names of the fields of a record of the model; none for what is no record."""
    return tuple(getattr(value, "_fields", None) or getattr(value, "__dataclass_fields__", None) or ())


def plain_field(thing: Any, name: str, renames: Renames = SAME_NAMES, *, texts: bool = False) -> Hashable:  # noqa: ANN401 (as above)
    """One field of a thing as `plain` has it."""
    value = renamed_field(thing, name, renames)
    if name in UNORDERED.get(type(thing), ()) or (isinstance(thing, OrderCases) and thing.by_code()):
        return frozenset(plain(each, renames, texts=texts) for each in value)
    return plain(value, renames, texts=texts)


def renamed_field(thing: Any, name: str, renames: Renames) -> Any:  # noqa: ANN401 (as above)
    """A field of a thing, with what was renamed by its new name."""
    value = getattr(thing, name)
    if name in PATHS.get(type(thing), ()):
        value = _replaced(value, renames.path)
    elif sort := IDS.get(type(thing), {}).get(name):
        value = getattr(renames, sort).get(value, value)
    return value


def _replaced(value: Any, path: Any) -> Any:  # noqa: ANN401 (nested tuples with paths in them)
    """Each text in nested tuples as `path` has it; conditions stay, as they know their own."""
    if isinstance(value, str) and not isinstance(value, PythonEnum):
        return path(value)
    if isinstance(value, Condition):
        return value
    if hasattr(value, "_fields"):
        return type(value)(*(_replaced(each, path) for each in value))
    return tuple(_replaced(each, path) for each in value) if isinstance(value, tuple) else value


def conditions_in(value: Any) -> Iterator[Condition]:  # noqa: ANN401 (any value of the model)
    """The conditions with names in a value of the model, those within others too."""
    if isinstance(value, Condition) and value.name:
        yield value
    for name in field_names(value):
        if name not in UNCOMPARED:
            yield from conditions_in(getattr(value, name))
    if type(value) is tuple:
        for each in value:
            yield from conditions_in(each)
