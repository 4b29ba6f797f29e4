"""The Platinum maps against the JBUS columns of the manual's tables, which a script read apart from the maps.

The maps were transcribed from the Modbus column, which is one lower. A row with a hyphen is an unused address, but for
the second words of the product and the release code, whose rows have no name either.
"""

import csv
import re
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest

from regscribe.model import Model, Register, RegisterMap, Space
from regscribe.pipeline import compile_map

ATHENA = Path(__file__).parents[2] / "maps" / "athena"
TABLES = sorted(path.name.removesuffix(".jbus.csv") for path in ATHENA.glob("platinum-*.jbus.csv"))
NAMED = ["platinum-c10-m10", "platinum-m300", "platinum-m400"]
"""Maps whose names, codes and states are compared, too."""

MENDED = {("platinum-m400", 39), ("platinum-m400", 47)}
"""Names whose letters the map mends (errata): "one shoot tuning" and "high milit"."""

CONDITIONAL = "r(w)"
"""Printed R(W) or R/(W): by one code only (a command), or under a condition."""


class Row(NamedTuple):
    """One row of a table; several unused addresses may share one."""

    space: Space
    addresses: range
    name: str
    access: str
    code: str


@cache
def _map(name: str) -> RegisterMap:
    compiled = compile_map(ATHENA / f"{name}.yaml")
    assert compiled.map is not None, [f"{each.span.line}: {each.message}" for each in compiled.diagnostics]
    return compiled.map


@cache
def _rows(name: str) -> tuple[Row, ...]:
    with (ATHENA / f"{name}.jbus.csv").open(newline="", encoding="utf-8") as file:
        return tuple(_row(fields) for fields in csv.DictReader(file) if fields["space"] != Space.STATUS)


def _row(fields: dict[str, str]) -> Row:
    first, _, last = fields["jbus_address"].partition("..")
    addresses = range(int(first), int(last or first) + 1)
    return Row(Space(fields["space"]), addresses, fields["name"], fields["access"], fields["code"])


def _registers(model: Model) -> dict[tuple[Space, int], Register]:
    """Registers by the JBUS number of their first word."""
    return {(register.base.space, register.address + 1): register for register in model.registers}


def _continued(model: Model) -> set[tuple[Space, int]]:
    """JBUS numbers of the words after the first of a value."""
    return {
        (each.base.space, each.address + 1 + word) for each in model.registers for word in range(1, each.base.words)
    }


def _unused(model: Model) -> set[tuple[Space, int]]:
    return {(space, at + 1) for space, first, last in model.unused for at in range(first, last + 1)}


def _named(name: str) -> list[tuple[Row, Register]]:
    model = _map(name).models[0]
    known, further = _registers(model), _continued(model)
    named = [row for row in _rows(name) if row.name != "-" and (row.space, row.addresses[0]) not in further]
    return [(row, known[row.space, row.addresses[0]]) for row in named]


def _normalised(text: str) -> str:
    return re.sub(r"[^a-z0-9]", "", text.lower())


@pytest.mark.parametrize("name", TABLES)
def test_every_address_of_the_tables_is_a_register_or_unused_and_no_other_is(name: str) -> None:
    listed = {(row.space, at) for row in _rows(name) for at in row.addresses}
    for model in _map(name).models:
        mapped = {place for place in _registers(model) if place[0] is not Space.STATUS}
        assert mapped | _continued(model) | _unused(model) == listed


@pytest.mark.parametrize("name", TABLES)
def test_unused_are_the_rows_without_a_name(name: str) -> None:
    nameless = {(row.space, at) for row in _rows(name) if row.name == "-" for at in row.addresses}
    for model in _map(name).models:
        assert _unused(model) == nameless - _continued(model)


@pytest.mark.parametrize("name", TABLES)
def test_access_is_what_the_tables_print(name: str) -> None:
    for row, register in _named(name):
        if row.access != CONDITIONAL:
            assert (register.path, register.access) == (register.path, row.access)


@pytest.mark.parametrize("name", TABLES)
def test_what_is_printed_as_conditional_is_written_by_a_command_or_under_a_condition(name: str) -> None:
    commanded = {step.address + 1 for command in _map(name).models[0].commands for step in command.steps}
    for row, register in _named(name):
        if row.access == CONDITIONAL:
            assert register.writable is not None or commanded >= set(row.addresses), register.path


@pytest.mark.parametrize("name", NAMED)
def test_names_begin_as_the_tables_print_them(name: str) -> None:
    for row, register in _named(name):
        if (name, row.addresses[0]) not in MENDED:
            assert _normalised(row.name).startswith(_normalised(register.name)), register.path


@pytest.mark.parametrize("name", NAMED)
def test_codes_are_what_the_tables_print(name: str) -> None:
    codes = [(register.path, register.printed or register.symbol) for _, register in _named(name)]
    assert codes == [(register.path, row.code) for row, register in _named(name)]


@pytest.mark.parametrize("name", NAMED)
def test_states_are_what_the_tables_print_beside_the_name(name: str) -> None:
    for row, register in _named(name):
        states = re.findall(r"(\d) ?= ?([A-Za-z]+(?: [a-z]+)?)", row.name)
        if states:
            assert register.enum is not None, register.path
            assert [(str(member.code), member.label) for member in register.enum.members] == states


@pytest.mark.parametrize("name", NAMED)
def test_bits_of_the_status_are_those_that_its_table_names(name: str) -> None:
    with (ATHENA / f"{name}.jbus.csv").open(newline="", encoding="utf-8") as file:
        rows = [each for each in csv.DictReader(file) if each["space"] == Space.STATUS and each["name"] != "-"]
    for model in _map(name).models:
        status = next(each for each in model.registers if each.base.space is Space.STATUS)
        assert [(bit.low + 1, bit.label) for bit in status.fields] == [
            (int(row["jbus_address"]), row["name"].partition(" (")[0]) for row in rows
        ]
