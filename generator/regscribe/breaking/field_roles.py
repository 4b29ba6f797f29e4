"""What fields of the model are: texts for readers, paths of registers, ids of other things, lists without an order."""

from collections.abc import Mapping

from regscribe.model import (
    Alarm,
    AnyOf,
    Array,
    BitField,
    Command,
    CommandStep,
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
    Largest,
    Member,
    Model,
    OnOff,
    Output,
    Page,
    Pid,
    Process,
    Product,
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
    Smallest,
    Special,
    Sum,
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
    Effect: frozenset({"defaults"}),
    Pid: frozenset({"band", "integral", "derivative", "bias", "ends"}),
    OnOff: frozenset({"hysteresis"}),
    Output: frozenset({"percent", "manual", "failsafe", "low", "high", "active"}),
    Trip: frozenset({"limit"}),
    Alarm: frozenset({"active", "hysteresis", "delay", "inhibit"}),
    Ramp: frozenset({"rises", "falls", "shows"}),
    Process: frozenset({"value", "setpoint", "highest", "lowest", "fault"}),
    SetpointProgram: frozenset(
        {"number_of_segments", "cycles", "holdback", "power_failure", "end", "setpoint_limits"}
        | {"segment_now", "program_now", "setpoint_now"}
    ),
    ProgramSegments: frozenset({"setpoint", "ramp", "soak", "idle"}),
    ProgramFinal: frozenset({"setpoint"}),
    ProgramTimeUnit: frozenset({"register"}),
    ProgramStates: frozenset({"register"}),
    Page: frozenset({"selectors"}),
    Register: frozenset({"shadows", "rereads", "follows"}),
    Array: frozenset({"counted"}),
    Command: frozenset({"step_registers"}),
    Given: frozenset({"register"}),
    ValueExample: frozenset({"register"}),
}
"""Fields that hold paths of registers and no other texts."""

PAIRS: Mapping[type, Mapping[str, int]] = {
    Effect: {"sets": 0},
    SetpointProgram: {"enable": 0},
    ProgramSegments: {"outputs": 1},
    ProgramFinal: {"outputs": 1},
    ProgramAction: {"writes": 0},
    Identity: {"texts": 0},
    ValueExample: {"state": 0},
    FrameExample: {"writes": 0, "state": 0},
}
"""Fields that hold pairs, and which half of each is the path of a register."""

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
    Is: frozenset({"codes"}),
    AnyOf: frozenset({"conditions"}),
    Sum: frozenset({"terms"}),
    Product: frozenset({"factors", "divisors"}),
    Largest: frozenset({"largest_of"}),
    Smallest: frozenset({"smallest_of"}),
}
"""Fields whose order says nothing: in a map they are mappings, lists of what is possible, or what is added up."""
