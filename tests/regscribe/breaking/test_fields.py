"""No field of the model is forgotten: each is compared under a rule or part by part, or left out with a reason."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import pytest

from regscribe.breaking import arrays, codes, map_facts, parts, places, register_facts, things
from regscribe.breaking.facts import Fact
from regscribe.breaking.field_roles import IDS, PAIRS, PATHS, TEXTS, UNORDERED
from regscribe.breaking.plain import field_names
from regscribe.model import (
    Array,
    BitField,
    Command,
    Computed,
    Enum,
    Given,
    Group,
    Member,
    Model,
    ProgramNotes,
    Protocol,
    Register,
    RegisterBlock,
    RegisterMap,
    Sentinel,
    SerialDefaults,
    SetpointProgram,
    Special,
    View,
)

PAIRING = {"id"}
PLACE = {"span"}
TABLES: list[tuple[type, Sequence[Fact[Any]], Iterable[str]]] = [
    (Register, register_facts.FACTS, {*register_facts.ELSEWHERE, *register_facts.UNCOMPARED}),
    (View, places.FACTS, {"name", "space", "offset", "stride"}),
    (Array, arrays.FACTS, {*PAIRING, *PLACE, "members"}),
    (Enum, codes.ENUM_FACTS, {*PAIRING, *PLACE, "members", "cases"}),
    (Member, codes.MEMBER_FACTS, {"code", "id"}),
    (Special, codes.SPECIAL_FACTS, {"code"}),
    (Sentinel, codes.SENTINEL_FACTS, {"stored", "high", "when"}),
    (BitField, parts.FACTS, {*PAIRING, "enum", "sentinels"}),
    (Group, things.GROUP_FACTS, {*PAIRING, *PLACE, "members"}),
    (Command, things.COMMAND_FACTS, {*PAIRING, *PLACE}),
    (Computed, things.COMPUTED_FACTS, {*PAIRING, *PLACE}),
    (SetpointProgram, things.PROGRAM_FACTS, PAIRING),
    (ProgramNotes, things.NOTES_FACTS, PLACE),
    (RegisterBlock, things.BLOCK_FACTS, PAIRING),
    (Given, map_facts.GIVEN_FACTS, {*PAIRING, *PLACE}),
    (Protocol, map_facts.PROTOCOL_FACTS, {"serial", "absent"}),
    (SerialDefaults, map_facts.SERIAL_FACTS, ()),
    (Model, map_facts.MODEL_FACTS, {*map_facts.MODEL_ELSEWHERE, *PLACE, "by_path"}),
    (RegisterMap, map_facts.MAP_FACTS, {*map_facts.MAP_ELSEWHERE, *map_facts.MAP_UNCOMPARED}),
]


@pytest.mark.parametrize(("kind", "facts", "besides"), TABLES, ids=lambda one: getattr(one, "__name__", ""))
def test_each_field_is_in_one_table(kind: type, facts: Sequence[Fact[Any]], besides: Iterable[str]) -> None:
    compared = [name for fact in facts for name in fact.fields]
    assert sorted([*compared, *besides]) == sorted(field_names(kind))


@pytest.mark.parametrize("table", [TEXTS, PATHS, IDS, PAIRS, UNORDERED])
def test_tables_name_fields_that_there_are(table: Mapping[type, Iterable[str]]) -> None:
    strange = {(kind.__name__, name) for kind, names in table.items() for name in {*names} - {*field_names(kind)}}
    assert strange == set()
