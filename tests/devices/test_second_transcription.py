"""The maps against lists that were read apart from them: section 5 of the Athena manual and example 1 of the FDC one.

The Athena map was transcribed from the function tables (section 4), the list from the numeric tables (section 5).
"""

import csv
from fractions import Fraction
from pathlib import Path

import pytest

from regscribe.evidence.compare import compare_table
from regscribe.evidence.differences import Comparison
from regscribe.evidence.table import read
from regscribe.model import RegisterMap
from regscribe.reference import Surroundings, encode
from regscribe_runtime.values.numbers import parse

ON_NO_DISPLAY = {("1ZC", "35"), ("1ZC", "4071")}
"""Section 5 gives these to the 1ZC too; section 4 does not, and the 1ZC has no display (an erratum of the map)."""


@pytest.fixture(scope="module")
def numeric(athena: RegisterMap, maps: Path) -> Comparison:
    """Section 5, which refers to subsections by two numbers, against the map, which cites three."""
    path = maps / "athena/series-c.numeric-list.csv"
    columns = ("address", "aliases", "access", "section", "views")
    return compare_table(athena, read(path.read_bytes(), path.name), columns=columns, loose=True)


def test_the_list_has_every_register_of_the_family_once(maps: Path) -> None:
    with (maps / "athena/series-c.numeric-list.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [int(row["address"]) for row in rows] == [*range(65), *range(4000, 4096)]
    assert {row["section"].count(".") for row in rows} == {1}


def test_each_model_has_the_addresses_that_the_list_gives_it(numeric: Comparison) -> None:
    assert numeric.only_ours == ()
    assert {(place.model, place.address) for place in numeric.only_theirs} == ON_NO_DISPLAY


def test_access_views_and_sections_are_what_the_list_says(athena: RegisterMap, numeric: Comparison) -> None:
    assert numeric.differences == ()
    assert numeric.matched == sum(len(model.registers) for model in athena.models)


@pytest.fixture(scope="module")
def downloaded(maps: Path) -> list[dict[str, str]]:
    """The 52 values of example 1, each with the word that the frame sends for it."""
    with (maps / "fdc/series-100.example-1.csv").open(newline="") as file:
        return list(csv.DictReader(file))


def test_the_defaults_are_the_values_that_example_1_downloads(fdc: RegisterMap, maps: Path) -> None:
    path = maps / "fdc/series-100.example-1.csv"
    columns = ("address", "symbol=notation", "default=value")
    found = compare_table(fdc, read(path.read_bytes(), path.name), columns=columns, model="C21", partial=True)
    assert (found.matched, found.only_theirs, found.differences) == (52, (), ())


@pytest.mark.parametrize(
    "linear", [frozenset[Fraction](), frozenset({Fraction(1)})], ids=["non-linear", "linear, DP 1"]
)
def test_the_defaults_encode_to_the_words_of_example_1(
    fdc: RegisterMap, downloaded: list[dict[str, str]], linear: frozenset[Fraction]
) -> None:
    model = fdc.model("C21")
    values = {each.path: each.default for each in model.registers if isinstance(each.default, Fraction)}
    known = Surroundings(values=values, codes={"linear_inputs": linear})
    registers = {register.address: register for register in model.registers}
    words = [encode(registers[at], registers[at].base, parse(downloaded[at]["value"]), known) for at in range(52)]
    assert words == [(int(row["word"], 16),) for row in downloaded]
