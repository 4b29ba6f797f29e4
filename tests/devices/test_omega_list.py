"""The Omega map against chapter 6 of its manual, which was read apart from it.

The map is built on Athena's, with chapter 5 as the measure; the list has the cross references and the empty cells of
chapter 6 as they are printed.
"""

import csv
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, TypeVar

import pytest

from regscribe.model import Register, RegisterMap
from regscribe.pipeline import compile_map

WITHOUT_ASTERISK = {1, 2, 3, 4, 24}
"""Chapter 6 does not mark these as stored without the decimal point, chapter 5 does (an erratum of the map)."""
WITHOUT_10X = {35}
"""Chapter 6 lost this address of the 10X region (an erratum of the map)."""
WITHOUT_MODEL = {63, 64}
"""Chapter 6 prints these two with an empty cell (they were the 1ZC's); the list leaves them out."""
WITHOUT_SECTION = {4005}
"""Chapter 6 lost this reference (an erratum of the map)."""

Fact = TypeVar("Fact")


class Row(NamedTuple):
    """One line of chapter 6; `section` is empty where the cell is."""

    address: int
    name: str
    access: str
    models: tuple[str, ...]
    section: str
    views: dict[str, int]


@pytest.fixture(scope="module")
def omega(maps: Path) -> RegisterMap:
    """Omega CN8200, CN8240 and CN8260."""
    compiled = compile_map(maps / "omega/cn8200.yaml")
    assert compiled.map is not None, [f"{each.span.line}: {each.message}" for each in compiled.diagnostics]
    return compiled.map


@pytest.fixture(scope="module")
def listed(maps: Path) -> list[Row]:
    """Chapter 6 with its ranges expanded."""
    with (maps / "omega/cn8200.numeric-list.csv").open(newline="") as file:
        return [_row(fields) for fields in csv.DictReader(file)]


def _row(fields: dict[str, str]) -> Row:
    views = (view.split(":") for view in fields["views"].split())
    return Row(
        address=int(fields["address"]),
        name=fields["name"],
        access=fields["access"],
        models=tuple(fields["models"].split()),
        section=fields["section"],
        views={name: int(address) for name, address in views},
    )


def _of_list(
    listed: list[Row], fact: Callable[[Row], Fact], but: frozenset[int] = frozenset()
) -> dict[tuple[str, int], Fact]:
    return {(model, row.address): fact(row) for row in listed for model in row.models if row.address not in but}


def _of_map(
    omega: RegisterMap, fact: Callable[[Register], Fact], but: frozenset[int] = frozenset()
) -> dict[tuple[str, int], Fact]:
    return {
        (model.name, register.address): fact(register)
        for model in omega.models
        for register in model.registers
        if register.address not in but
    }


def test_the_list_has_every_register_that_a_model_has_once(listed: list[Row]) -> None:
    assert [row.address for row in listed] == [*range(63), *range(4000, 4096)]


def test_the_two_registers_that_are_printed_without_a_model_are_on_no_model(omega: RegisterMap) -> None:
    addresses = {address for _, address in _of_map(omega, lambda register: register.path)}
    assert not addresses & set(WITHOUT_MODEL)


def test_each_model_has_the_addresses_that_the_list_gives_it(omega: RegisterMap, listed: list[Row]) -> None:
    assert set(_of_map(omega, lambda register: register.path)) == set(_of_list(listed, lambda row: row.address))


def test_access_is_what_the_list_says(omega: RegisterMap, listed: list[Row]) -> None:
    assert _of_map(omega, lambda register: register.access.value) == _of_list(listed, lambda row: row.access)


def test_views_stand_where_the_list_prints_them(omega: RegisterMap, listed: list[Row]) -> None:
    but = frozenset(WITHOUT_10X)
    views = _of_map(omega, lambda register: {view.name: view.address(register.at) for view in register.views}, but)
    assert views == _of_list(listed, lambda row: row.views, but)


def test_each_register_stands_one_chapter_after_the_one_that_the_list_refers_to(
    omega: RegisterMap, listed: list[Row]
) -> None:
    but = frozenset(WITHOUT_SECTION)
    sections = _of_map(omega, lambda register: ".".join(register.section.split(".")[:2]), but)
    assert sections == _of_list(listed, lambda row: _raised(row.section), but)


def _raised(section: str) -> str:
    chapter, _, rest = section.partition(".")
    return f"{int(chapter) + 1}.{rest}"


def test_what_the_list_marks_with_an_asterisk_is_stored_without_its_decimal_point(
    omega: RegisterMap, listed: list[Row]
) -> None:
    marked = {row.address for row in listed if row.name.endswith("*")} | WITHOUT_ASTERISK
    every = (register for model in omega.models for register in model.registers)
    shifted = {register.address for register in every if any(case.then.decimals for case in register.scale)}
    assert shifted == marked
