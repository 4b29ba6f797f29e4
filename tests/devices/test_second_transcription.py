"""The maps against lists that were read apart from them: section 5 of the Athena manual and example 1 of the FDC one.

The Athena map was transcribed from the function tables (section 4), the list from the numeric tables (section 5).
"""

import csv
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple, TypeVar

import pytest

from regscribe.model import Register, RegisterMap
from regscribe.model.number import exact
from regscribe.model.reference import Surroundings, encode

ON_NO_DISPLAY = {35, 4071}
"""Section 5 gives these to the 1ZC too; section 4 does not, and the 1ZC has no display (an erratum of the map)."""

Fact = TypeVar("Fact")


class Row(NamedTuple):
    """One line of section 5."""

    address: int
    access: str
    models: tuple[str, ...]
    section: str
    views: dict[str, int]


@pytest.fixture(scope="module")
def listed(maps: Path) -> list[Row]:
    """Section 5 with its ranges expanded."""
    with (maps / "athena/series-c.numeric-list.csv").open(newline="") as file:
        return [_row(fields) for fields in csv.DictReader(file)]


def _row(fields: dict[str, str]) -> Row:
    views = (view.split(":") for view in fields["views"].split())
    return Row(
        address=int(fields["address"]),
        access=fields["access"],
        models=tuple(fields["models"].split()),
        section=fields["section"],
        views={name: int(address) for name, address in views},
    )


def _of_list(listed: list[Row], fact: Callable[[Row], Fact]) -> dict[tuple[str, int], Fact]:
    return {
        (model, row.address): fact(row)
        for row in listed
        for model in row.models
        if not (model == "1ZC" and row.address in ON_NO_DISPLAY)
    }


def _of_map(athena: RegisterMap, fact: Callable[[Register], Fact]) -> dict[tuple[str, int], Fact]:
    return {
        (model.name, register.base.address): fact(register) for model in athena.models for register in model.registers
    }


def test_the_list_has_every_register_of_the_family_once(listed: list[Row]) -> None:
    assert [row.address for row in listed] == [*range(65), *range(4000, 4096)]


def test_each_model_has_the_addresses_that_the_list_gives_it(athena: RegisterMap, listed: list[Row]) -> None:
    assert set(_of_map(athena, lambda register: register.path)) == set(_of_list(listed, lambda row: row.address))


def test_access_is_what_the_list_says(athena: RegisterMap, listed: list[Row]) -> None:
    assert _of_map(athena, lambda register: register.access.value) == _of_list(listed, lambda row: row.access)


def test_views_stand_where_the_list_prints_them(athena: RegisterMap, listed: list[Row]) -> None:
    views = _of_map(athena, lambda register: {view.name: view.address for view in register.views})
    assert views == _of_list(listed, lambda row: row.views)


def test_each_register_cites_the_subsection_that_the_list_refers_to(athena: RegisterMap, listed: list[Row]) -> None:
    sections = _of_map(athena, lambda register: ".".join(register.section.split(".")[:2]))
    assert sections == _of_list(listed, lambda row: row.section)


@pytest.fixture(scope="module")
def downloaded(maps: Path) -> list[dict[str, str]]:
    """The 52 values of example 1, each with the word that the frame sends for it."""
    with (maps / "fdc/series-100.example-1.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def test_the_defaults_are_the_values_that_example_1_downloads(
    fdc: RegisterMap, downloaded: list[dict[str, str]]
) -> None:
    stated = [(int(row["address"]), row["notation"], exact(row["value"])) for row in downloaded]
    registers = {register.base.address: register for register in fdc.model("C21").registers}
    assert [(at, registers[at].symbol, registers[at].default) for at in range(52)] == stated


@pytest.mark.parametrize(
    "linear", [frozenset[Fraction](), frozenset({Fraction(1)})], ids=["non-linear", "linear, DP 1"]
)
def test_the_defaults_encode_to_the_words_of_example_1(
    fdc: RegisterMap, downloaded: list[dict[str, str]], linear: frozenset[Fraction]
) -> None:
    model = fdc.model("C21")
    values = {each.path: each.default for each in model.registers if isinstance(each.default, Fraction)}
    known = Surroundings(values=values, codes={"linear_inputs": linear})
    registers = {register.base.address: register for register in model.registers}
    words = [encode(registers[at], registers[at].base, exact(downloaded[at]["value"]), known) for at in range(52)]
    assert words == [(int(row["word"], 16),) for row in downloaded]
