"""`regscribe compare` and `regscribe coverage` as a user types them."""

import csv
import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

Cli = Callable[..., Any]


@pytest.fixture
def table(cli: Cli, oven: Path) -> Path:
    """The export of the oven."""
    path = oven.parents[2] / "oven.csv"
    path.write_text(cli("export", "--format", "csv").out)
    return path


def test_a_table_that_says_the_same_ends_with_0(cli: Cli, table: Path) -> None:
    result = cli("compare", "acme/oven", table)
    assert (result.code, result.err) == (0, "")
    assert "acme/oven against" in result.out
    assert result.out.endswith("\nnothing differs\n")


def test_what_differs_is_listed_by_register_and_counted_by_column(cli: Cli, table: Path) -> None:
    table.write_text(table.read_text().replace("0,400,20", "0,450,25").replace("stop", "halt"))
    result = cli("compare", "acme/oven", table)
    assert result.code == 1
    assert result.out.endswith(
        "\n3 cells differ:\n"
        "  M1: holding 1 setpoint “Setpoint” (line 2)\n"
        "    maximum: `400` against `450`\n"
        "    default: `20` against `25`\n"
        "  M1: holding 2 mode “Mode” (line 3)\n"
        '    values: `{"0": "stop"}` against `{"0": "halt"}`\n'
        f"\n0 rows only in acme/oven, 0 only in {table}; 3 cells differ: maximum 1, default 1, values 1\n"
    )


def test_rows_of_one_side_are_listed(cli: Cli, table: Path) -> None:
    table.write_text("address,name\n1,Setpoint\n7,Lamp\n")
    result = cli("compare", "acme/oven", table)
    assert result.code == 1
    assert "1 row only in acme/oven:\n  M1: holding 2 mode “Mode”\n" in result.out
    assert f"1 row only in {table}:\n  M1: 7 “Lamp” (line 3)\n" in result.out


def test_the_result_is_json_or_csv_too(cli: Cli, table: Path) -> None:
    table.write_text("address,name,default\n1,Setpoint,21\n7,Lamp,\n")
    result = cli("compare", "acme/oven", table, "--format", "json")
    found = json.loads(result.out)
    assert (result.code, found["equal"], found["counts"], found["matched"]) == (1, False, {"default": 1}, 1)
    place = {"model": "M1", "space": "holding", "address": "1", "id": "setpoint", "name": "Setpoint", "line": 2}
    assert found["differences"] == [{**place, "column": "default", "ours": "20", "theirs": "21"}]
    assert found["only_ours"][0]["line"] is None
    rows = list(csv.DictReader(io.StringIO(cli("compare", "acme/oven", table, "--format", "csv").out)))
    assert [(row["what"], row["address"], row["column"], row["line"]) for row in rows] == [
        ("only_ours", "2", "", ""),
        ("only_theirs", "7", "", "3"),
        ("differs", "1", "default", "2"),
    ]


def test_two_maps_are_compared_in_the_columns_asked_for(cli: Cli, oven: Path) -> None:
    kiln = oven.with_name("kiln.yaml")
    kiln.write_text(oven.read_text().replace("acme/oven", "acme/kiln").replace("M1", "N1").replace("400", "500"))
    result = cli("compare", "acme/oven", "acme/kiln")
    assert (result.code, "M1 = N1: holding 1 setpoint" in result.out) == (1, True)
    assert cli("compare", oven, kiln, "--columns", "name,default").code == 0
    assert cli("compare", oven, kiln, "--columns", "maximum", "--pair", "M1=N1").code == 1


BAD = {
    "folder": (["."], "is a folder: name one table (CSV) or one map"),
    "absent": (["no.csv"], "cannot read no.csv: No such file or directory"),
    "unknown map": (["acme/ofen"], "there is no map `acme/ofen`"),
    "utf-16": (["utf16.csv"], "is encoded as UTF-16"),
    "no such column": (["good.csv", "--columns", "nme"], "there is no column `nme`; did you mean `name`?"),
    "no column at all": (["good.csv", "--columns", ","], "--columns names no column"),
    "no such model": (["good.csv", "--model", "M2"], "has no model `M2`; did you mean `M1`?"),
    "pair of a table": (["good.csv", "--pair", "M1=M1"], "--pair is for two maps"),
    "model of two maps": (["acme/oven", "--model", "M1"], "--model is for a table"),
    "half a pair": (["acme/oven", "--pair", "M1"], "--pair M1: write one model of each map"),
    "pair of a stranger": (["acme/oven", "--pair", "M1=M2"], "acme/oven has no model `M2`: it has M1"),
    "pair given twice": (["acme/oven", "--pair", "M1=M1", "--pair", "M1=M1"], "has its partner already"),
}


@pytest.mark.parametrize("name", BAD)
@pytest.mark.usefixtures("oven")
def test_wrong_use_ends_with_2_and_says_why(cli: Cli, name: str) -> None:
    Path("good.csv").write_text("address,name\n1,Setpoint\n")
    Path("utf16.csv").write_text("address,name\n1,Setpoint\n", encoding="utf-16")
    arguments, reason = BAD[name]
    result = cli("compare", "acme/oven", *arguments)
    assert (result.code, result.out) == (2, "")
    assert reason in result.err


def test_nothing_is_compared_with_a_map_that_is_wrong(cli: Cli, oven: Path, table: Path) -> None:
    oven.write_text(oven.read_text().replace("at: 2", "at: 1"))
    result = cli("compare", oven, table)
    assert (result.code, result.out) == (1, "")
    assert "nothing was compared: " in result.err


def test_coverage_is_a_table_for_people(cli: Cli, oven: Path) -> None:
    result = cli("coverage", oven)
    assert (result.code, result.err) == (0, "")
    lines = result.out.splitlines()
    assert lines[:2] == ["acme/oven: Oven", "0 worked examples, 0 errata, 0 waivers, 0 overrides, 0 givens"]
    assert lines[4].split() == ["M1", "2", "1", "1", "2", "1", "2", "0", "0", "0", "0"]
    assert lines[7].split() == ["M1", "holding", "2", "2", "0", "0", "0", "0"]


def test_coverage_is_json_and_markdown_too(cli: Cli, oven: Path) -> None:
    found = json.loads(cli("coverage", "--format", "json").out)
    assert found["maps"][0]["models"][0]["registers"] == 2
    text = cli("coverage", oven, "--format", "markdown").out
    assert "| [Oven](acme/oven.md) | M1 | 2 | 1 | 1 | 2 | 1 | 2 | 0 | 0 | 0 | 0 |\n" in text


def test_nothing_is_counted_of_a_map_that_is_wrong(cli: Cli, oven: Path) -> None:
    oven.write_text(oven.read_text().replace("at: 2", "at: 1"))
    result = cli("coverage")
    assert (result.code, result.out) == (1, "")
    assert "nothing was counted" in result.err
