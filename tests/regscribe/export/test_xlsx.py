"""Workbooks: typed cells, no formulas, the same bytes every time, and lists that can be imported again."""

import io
import re
import zipfile
from collections.abc import Callable
from decimal import Decimal
from typing import Any

import pytest
from openpyxl import load_workbook

from regscribe import plugins
from regscribe.export.xlsx.columns import number
from regscribe.losses import Exported
from regscribe.model import RegisterMap

Small = Callable[..., str]
Export = Callable[..., Exported]
Lines = Callable[..., list[dict[str, Any]]]


@pytest.fixture
def lines(export: Export, small: Small) -> Lines:
    """The rows of the sheet of a map of these registers, by heading."""

    def found(*registers: str, options: dict[str, str] | None = None, **more: str) -> list[dict[str, Any]]:
        data = export("xlsx", small(*registers, **more), **(options or {})).texts[""]
        assert isinstance(data, bytes)
        heads, *rows = load_workbook(io.BytesIO(data)).active.iter_rows(values_only=True)
        return [dict(zip(map(str, heads), row, strict=True)) for row in rows]

    return found


def test_a_register_is_a_row_with_typed_cells(lines: Lines) -> None:
    (row,) = lines(
        "at: 9, name: Level, symbol: LV, type: int32, word_order: little, decimals: 1, range: -5..40.5, unit: °C"
    )
    expected = {
        "Group": "control",
        "Name": "Level",
        "Symbol": "LV",
        "Space": "holding",
        "Address": 9,
        "Words": 2,
        "Data type": "int32",
        "Word order": "CDAB",
        "Access": "rw",
        "Multiplier": 0.1,
        "Unit": "°C",
        "Min": -5,
        "Max": 40.5,
        "Section": "3.1",
    }
    assert {heading: row[heading] for heading in expected} == expected


def test_codes_and_bits_are_readable(lines: Lines) -> None:
    mode, status = lines(
        "at: 0, name: Mode, enum: {0: off, 7: on}", "at: 1, name: Status, flags: {0: heating, 15: alarm}"
    )
    assert (mode["Values"], status["Bits"]) == ("0 = off; 7 = on", "0 = heating; 15 = alarm")


def test_what_no_list_has_a_column_for_stands_behind(lines: Lines) -> None:
    mode, level = lines(
        "at: 0, name: Mode, default: 0",
        "at: 1, name: Level, when: {mode: 1}, range: 1..9, special: {0: off}, "
        "sentinels: {-1: broken}, persistence: eeprom, endurance: 5",
    )
    assert (level["Exists while"], level["Specials"]) == ("mode is 1", "0 = off")
    assert (level["Fault words"], level["More"]) == ("-1 = broken", "endurance: 5")
    assert mode["Exists while"] is None


def test_a_column_that_no_row_needs_is_left_out(lines: Lines) -> None:
    (row,) = lines("at: 0, name: Level")
    assert "Default" in row
    assert not {"Block", "Queue", "Specials", "Exists while"} & set(row)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0.1", Decimal("0.1")),
        ("400", 400),
        ("-2.0", -2),
        ("123456789012345", 123456789012345),
        ("1234567890123456", "1234567890123456"),  # a spreadsheet keeps 15 digits
        ("1/3", "1/3"),
        ("9999/10^dp", "9999/10^dp"),
        ("1e5", "1e5"),
        ("NaN", "NaN"),
        ("", None),
    ],
)
def test_a_number_is_one_if_a_spreadsheet_keeps_its_digits(text: str, value: object) -> None:
    assert number(text) == value
    assert type(number(text)) is type(value)


@pytest.mark.parametrize("hostile", ["=1+1", "+cmd|calc!A1", "-2+3", "@SUM(A1)", "=HYPERLINK(1)"])
def test_a_text_that_looks_like_a_formula_stays_a_text(export: Export, small: Small, hostile: str) -> None:
    data = export("xlsx", small(f'id: level, at: 0, name: "{hostile}", description: "{hostile}"')).texts[""]
    assert isinstance(data, bytes)
    cells = [
        cell for row in load_workbook(io.BytesIO(data)).active.iter_rows() for cell in row if cell.value == hostile
    ]
    assert [(cell.data_type, cell.quotePrefix) for cell in cells] == [("s", True)] * 2
    assert b"<f>" not in zipfile.ZipFile(io.BytesIO(data)).read("xl/worksheets/sheet1.xml")


def test_the_header_is_frozen_and_filtered(export: Export, small: Small) -> None:
    data = export("xlsx", small("at: 0, name: A", "at: 1, name: B")).texts[""]
    assert isinstance(data, bytes)
    sheet = load_workbook(io.BytesIO(data)).active
    assert (sheet.title, sheet.freeze_panes) == ("A1", "C2")
    assert re.fullmatch(r"A1:[A-Z]+3", sheet.auto_filter.ref)


def test_the_same_map_gives_the_same_bytes(export: Export, small: Small) -> None:
    one, other = (export("xlsx", small("at: 0, name: A")).texts[""] for _ in range(2))
    assert one == other
    assert isinstance(one, bytes)
    archive = zipfile.ZipFile(io.BytesIO(one))
    assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    assert archive.read("docProps/core.xml").count(b"1980-01-01T00:00:00Z") == 2


def test_each_model_has_a_sheet(compiled: Callable[[str], RegisterMap]) -> None:
    options = {one.name: one.default for one in plugins.exporter("xlsx").options}
    made = plugins.export("xlsx", [compiled("athena/series-c"), compiled("fdc/series-100")], options)
    assert isinstance(made.texts[""], bytes)
    names = load_workbook(io.BytesIO(made.texts[""]), read_only=True).sheetnames
    assert names == ["1ZC", "16C", "18C", "25C", "BTC-9100", "BTC-8100", "BTC-4100", "BTC-7100", "C21", "C91"]


def test_registers_can_be_chosen(lines: Lines) -> None:
    rows = lines("at: 0, name: Level A", "at: 1, name: Level B", "at: 2, name: Mode", options={"register": "level_*"})
    assert [row["Name"] for row in rows] == ["Level A", "Level B"]


def test_commands_and_computed_values_stand_below(lines: Lines) -> None:
    tail = (
        "computed: {twice: {name: Twice, is: {sum: [a, a]}, unit: W}}\n"
        'commands: {reset: {name: Reset, source: "1", steps: [{at: 90, words: [85]}]}}\n'
    )
    rows = lines("at: 0, name: A", tail=tail)
    assert [(row["Path"], row["Kind"]) for row in rows] == [
        ("a", "integer"),
        ("reset", "command"),
        ("twice", "computed"),
    ]


def test_a_cell_that_is_too_long_is_cut_and_told(export: Export, small: Small) -> None:
    made = export("xlsx", small(f"at: 0, name: Level, description: {'x' * 40000}"))
    assert [(one.register, one.fact, one.done) for one in made.losses] == [
        ("level", "description", "cut after 32767 characters: a cell holds no more")
    ]
