"""Files of all kinds become rows with places; what is no table, or too large, gets one clear message."""

import io
import zipfile
from collections.abc import Callable
from typing import Any

import openpyxl
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe.importers import table
from regscribe.importers.table import archive, grid, sheet_structure, sources, workbooks
from regscribe.importers.table.choices import choices
from regscribe.importers.table.grid import Grid, TableError
from regscribe.importers.table.pdf_tables import read as read_pdf
from regscribe.plugins import Likeness

HEAD = "Address,Name,Type,Access\n"


def grids(data: bytes, name: str = "list.csv", **options: str) -> list[Grid]:
    return sources.grids_of(data, name, choices({key.replace("_", "-"): text for key, text in options.items()}))[0]


def cells(data: bytes, **options: str) -> list[tuple[str, ...]]:
    (found,) = grids(data, **options)
    return [row.cells for row in found.rows]


def refusal(data: bytes, name: str = "list.csv", **options: str) -> str:
    with pytest.raises(TableError) as error:
        grids(data, name, **options)
    return str(error.value)


@pytest.mark.parametrize("separator", [",", ";", "\t", "|"])
def test_cells_are_separated_by_what_separates_most_lines_evenly(separator: str) -> None:
    text = "a;b,c|d\n" if separator == "\t" else ""
    rows = [
        ["Address", "Name", "Factor"],
        ["1", "Speed, fast" if separator == ";" else "Speed", "0.1"],
        ["2", "Flow", "1"],
    ]
    data = text + "\n".join(separator.join(row) for row in rows)
    assert cells(data.encode())[-3:] == [tuple(row) for row in rows]


def test_a_decimal_comma_does_not_separate_cells_where_semicolons_do() -> None:
    assert cells(b"Address;Name;Factor\n1;Speed;0,1\n2;Flow;0,01\n")[1] == ("1", "Speed", "0,1")


def test_a_first_line_may_say_what_separates_cells_and_lines_are_counted_with_it() -> None:
    (found,) = grids(b"sep=|\nAddress|Name\n1|a,b,c\n")
    assert [(row.line, row.cells) for row in found.rows] == [(2, ("Address", "Name")), (3, ("1", "a,b,c"))]


def test_a_cell_in_quotes_may_hold_separators_and_line_ends_and_its_row_has_the_first_line() -> None:
    (found,) = grids(b'Address,Name\n1,"Mode, of\noperation"\n2,Flow\n')
    assert [(row.line, row.where) for row in found.rows] == [(1, "line 1"), (2, "line 2"), (4, "line 4")]
    assert found.rows[1].cells == ("1", "Mode, of\noperation")


def test_text_of_a_clipboard_is_split_at_two_blanks_and_keeps_empty_cells_where_they_are() -> None:
    text = b"Register  Name          Unit  Access\n40001     Flow rate     l/h   R\n40002     Mode                R/W\n"
    assert cells(text) == [
        ("Register", "Name", "Unit", "Access"),
        ("40001", "Flow rate", "l/h", "R"),
        ("40002", "Mode", "", "R/W"),
    ]


@pytest.mark.parametrize(
    ("data", "said"),
    [
        ("Adresse;Größe\n1;°C\n".encode(), "UTF-8"),
        ("Adresse;Größe\n1;°C\n".encode("utf-8-sig"), "UTF-8 by its byte order mark"),
        ("Adresse;Größe\n1;°C\n".encode("utf-16"), "UTF-16-LE by its byte order mark"),
        ("Adresse;Größe\n1;°C\n".encode("utf-16-le"), "UTF-16-LE by its zero bytes"),
        ("Adresse;Größe\n1;°C\n".encode("cp1252"), "no UTF-8 (byte 0xF6 in line 1): it is read as Windows-1252"),
    ],
)
def test_the_encoding_is_found_and_stated(data: bytes, said: str) -> None:
    (found,) = grids(data)
    assert found.rows[0].cells == ("Adresse", "Größe")
    assert found.rows[1].cells == ("1", "°C")
    assert said in found.stated[0]


def test_an_encoding_can_be_chosen_and_one_that_is_none_is_refused() -> None:
    assert cells("地址,名称\n1,电压\n".encode("gbk"), encoding="gbk")[0] == ("地址", "名称")
    assert "there is no such encoding" in refusal(b"\xff\n", encoding="klingon")
    assert "list.csv:2: the byte 0xE9 is no ASCII" in refusal(b"a,b\n\xe9,1\n", encoding="ascii")


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b'Address,Name\n1,"Speed\n2,Flow\n', "list.csv:2: the quotes of this row are broken up to line 3"),
        (b'Address,Name\n1,"Speed"x\n', "list.csv:2: the quotes of this row are broken"),
        (b"Address,Name\n1,Sp\0eed\n2,Flow\n", "list.csv:2: this line holds a NUL byte"),
        (b"", "list.csv has no rows"),
        (b" \n,,\n", "list.csv has no rows"),
        (HEAD.encode() + b"1," + b"x" * 5_000_000 + b",U16,R\n", "list.csv:2: a cell of this row has more than"),
        (HEAD.encode() + b"1," + b"x" * 40_000 + b",U16,R\n", "line 2, column 2 has 40000 characters"),
        (b"Address" + b",x" * 600 + b"\n", "line 1 has 601 cells"),
    ],
)
def test_a_text_that_is_no_table_is_refused_with_its_line(data: bytes, said: str) -> None:
    assert said in refusal(data)


def test_more_rows_than_any_device_has_are_refused_with_the_number_and_what_to_do() -> None:
    data = HEAD + "".join(f"{number},x,U16,R\n" for number in range(200_000))
    assert refusal(data.encode()) == (
        "list.csv has more than 20000 rows with content, up to line 20001: no device has so many registers; choose a "
        "part with --range, or split the list"
    )


def test_of_a_list_that_is_too_long_a_part_can_be_read(
    workbook: Callable[..., bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(grid, "MOST_ROWS", 3)
    monkeypatch.setattr(sheet_structure, "MOST_ROWS", 3)
    rows = [["Address", "Name"], *([number, "x"] for number in range(5))]
    text = "\n".join(f"{address},{name}" for address, name in rows).encode()
    for data, name in ((text, "list.csv"), (workbook(Registers=rows), "list.xlsx")):
        assert "more than 3 rows with content, up to " in refusal(data, name)
        (found,) = grids(data, name, range="4:6")
        assert [row.cells[0] for row in found.rows] == ["2", "3", "4"]


def test_a_wide_table_that_is_aligned_by_blanks_is_refused_where_cells_are_empty() -> None:
    text = "  ".join(f"c{number}" for number in range(70)) + "\na  b  c\n"
    assert "line 2 has 3 cells aligned by blanks and another line 70: use tabs" in refusal(text.encode())


def test_a_range_of_lines_and_columns_is_read_alone() -> None:
    data = b"note\nx,Address,Name\ny,1,Speed\nz,2,Flow\n"
    assert cells(data, range="B2:C3") == [("Address", "Name"), ("1", "Speed")]
    assert cells(data, range="3:4") == [("y", "1", "Speed"), ("z", "2", "Flow")]


ROWS = [
    ["Address", "Name", "Range", None],
    [None, None, "Min", "Max"],
    [40001, "Speed", 0, 0.1],
    [40002, True, None, 1.0],
]


def test_cells_of_a_workbook_are_read_as_they_are_stored_with_their_places(workbook: Callable[..., bytes]) -> None:
    (found,) = grids(workbook(Registers=ROWS), "list.xlsx")
    assert [row.cells for row in found.rows] == [
        ("Address", "Name", "Range"),
        ("", "", "Min", "Max"),
        ("40001", "Speed", "0", "0.1"),
        ("40002", "yes", "", "1"),
    ]
    assert found.rows[2].where == "sheet Registers, row 3"
    assert found.rows[2].place(3) == "sheet Registers, cell D3"


def test_a_number_that_is_shown_as_percents_is_read_as_it_is_shown(workbook: Callable[..., bytes]) -> None:
    def percents(book: Any) -> None:
        for cell in ("A2", "B2"):
            book["Registers"][cell].number_format = "0.0%"

    (found,) = grids(workbook(percents, Registers=[["Default", "Max"], [0.505, 1], [0.505, 10**14 + 1]]), "list.xlsx")
    assert [row.cells for row in found.rows[1:]] == [("50.5 %", "100 %"), ("0.505", "100000000000001")]


def test_places_count_from_the_sheet_where_a_part_of_it_is_read(workbook: Callable[..., bytes]) -> None:
    (found,) = grids(workbook(Registers=ROWS), "list.xlsx", range="B3:D4")
    assert (found.rows[0].place(0), found.rows[0].cells) == ("sheet Registers, cell B3", ("Speed", "0", "0.1"))


def test_every_cell_of_a_merged_area_says_what_the_first_one_says(workbook: Callable[..., bytes]) -> None:
    def merge(book: Any) -> None:
        book["Registers"].merge_cells("C1:D1")
        book["Registers"].merge_cells("A3:A4")

    (found,) = grids(workbook(merge, Registers=ROWS), "list.xlsx")
    assert found.rows[0].cells == ("Address", "Name", "Range", "Range")
    assert (found.rows[3].cells[0], found.rows[3].repeated) == ("40001", {0})


def test_hidden_sheets_are_passed_over_and_told_and_hidden_rows_and_columns_are_told(
    workbook: Callable[..., bytes],
) -> None:
    def hide(book: Any) -> None:
        book["old list"].sheet_state = "hidden"
        book["Registers"].row_dimensions[4].hidden = True
        book["Registers"].column_dimensions["B"].hidden = True

    found, stated = workbooks.read(workbook(hide, Registers=ROWS, old_list=ROWS), "list.xlsx")
    assert stated == ["sheet old list is hidden and was not read; --sheet reads it"]
    assert [one.message for one in found[0].findings] == [
        "sheet Registers: rows 4 are hidden in the sheet and are read like all others",
        "sheet Registers: columns B are hidden in the sheet and are read too",
    ]
    (chosen,) = grids(workbook(hide, Registers=ROWS, old_list=ROWS), "list.xlsx", sheet="Old List")
    assert chosen.rows[0].where == "sheet old list, row 1"


def test_a_formula_without_a_result_is_never_calculated_and_never_an_empty_cell(workbook: Callable[..., bytes]) -> None:
    (found,) = grids(workbook(Registers=[["Address", "Name"], ["=1+1", "Speed"]]), "list.xlsx")
    assert found.rows[1].cells == ("=?", "Speed")
    assert "cells A2 hold a formula without a result" in found.findings[0].message


def test_a_date_that_a_spreadsheet_made_of_a_range_is_told(workbook: Callable[..., bytes]) -> None:
    import datetime as dt  # noqa: PLC0415 - one test

    (found,) = grids(workbook(Registers=[["Address", "Range"], [1, dt.datetime(2026, 10, 1)]]), "list.xlsx")  # noqa: DTZ001
    assert "cells B2 hold dates" in found.findings[0].message


def test_a_wrong_size_that_a_program_wrote_into_a_sheet_hides_no_rows(workbook: Callable[..., bytes]) -> None:
    data = workbook(Registers=ROWS)
    changed = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as new:
        for part in old.namelist():
            new.writestr(part, old.read(part).replace(b'ref="A1:D4"', b'ref="A1:B2"'))
    (found,) = grids(changed.getvalue(), "list.xlsx")
    assert len(found.rows) == 4


def _bomb(workbook: Callable[..., bytes]) -> bytes:
    data = io.BytesIO(workbook(Registers=ROWS))
    with zipfile.ZipFile(data, "a", zipfile.ZIP_DEFLATED) as part:
        part.writestr("xl/worksheets/sheet2.xml", b"\0" * 40_000_000)
    return data.getvalue()


def test_a_zip_bomb_is_refused_before_it_is_unpacked(
    workbook: Callable[..., bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    data = _bomb(workbook)
    assert "its part xl/worksheets/sheet2.xml has " in refusal(data, "list.xlsx")
    monkeypatch.setattr(archive, "MOST_UNPACKED", 30_000_000)
    assert "would unpack to 40" in refusal(data, "list.xlsx")


def test_broken_protected_and_foreign_workbooks_are_refused_with_what_to_do(workbook: Callable[..., bytes]) -> None:
    good = workbook(Registers=ROWS)
    assert "broken workbook" in refusal(good[:2000], "list.xlsx")
    assert "broken workbook" in refusal(good[:300] + b"\0" * 80 + good[380:], "list.xlsx")
    encrypted = archive.OLE + b"\0" * 600 + "EncryptedPackage".encode("utf-16-le")
    assert "protected by a password" in refusal(encrypted, "list.xlsx")
    assert "workbook of the old kind (.xls)" in refusal(archive.OLE + b"\0" * 600, "list.xls")
    other = io.BytesIO()
    with zipfile.ZipFile(other, "w") as part:
        part.writestr("content.xml", "<x/>")
    assert "(.ods)" in refusal(other.getvalue(), "list.ods")


def test_a_workbook_with_a_bomb_of_entities_is_refused(workbook: Callable[..., bytes]) -> None:
    data = workbook(Registers=ROWS)
    lines = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 9))
    changed = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as new:
        for part in old.namelist():
            content = old.read(part)
            if part == "xl/worksheets/sheet1.xml":
                content = f'<!DOCTYPE x [<!ENTITY a0 "x">{lines}]>'.encode() + content.replace(
                    b"<sheetData>", b"&a8;<sheetData>"
                )
            new.writestr(part, content)
    assert "broken workbook" in refusal(changed.getvalue(), "list.xlsx")


def test_a_sheet_that_is_not_there_is_told_with_those_that_are(workbook: Callable[..., bytes]) -> None:
    said = refusal(workbook(Registers=ROWS, History=ROWS), "list.xlsx", sheet="Regs")
    assert said == "--sheet Regs: list.xlsx has no such sheet; it has `Registers`, `History`"


def test_tables_of_a_pdf_are_joined_over_its_pages_with_their_places(pdf: Callable[..., bytes]) -> None:
    data = pdf([["Register", "Name"], ["40001", "Speed"]], [["Register", "Name"], ["40002", "Flow"]])
    (found,) = grids(data, "list.pdf")
    assert [(row.where, row.cells) for row in found.rows] == [
        ("page 1, row 1", ("Register", "Name")),
        ("page 1, row 2", ("40001", "Speed")),
        ("page 2, row 1", ("Register", "Name")),
        ("page 2, row 2", ("40002", "Flow")),
    ]


def test_pages_and_an_area_of_a_pdf_can_be_chosen(pdf: Callable[..., bytes]) -> None:
    data = pdf([["Register", "Name"], ["40001", "Speed"]], [["Register", "Name"], ["40002", "Flow"]])
    (found,) = grids(data, "list.pdf", pages="2")
    assert [row.cells for row in found.rows] == [("Register", "Name"), ("40002", "Flow")]
    assert "--pages 3: list.pdf has 2 pages" in refusal(data, "list.pdf", pages="3")
    assert "no table with ruled lines in that area" in refusal(data, "list.pdf", area="0,600,595,800")


def test_tables_of_a_pdf_that_are_no_list_of_registers_are_passed_over_and_told_by_page(
    pdf: Callable[..., bytes],
) -> None:
    pages = (
        [["Start", "Code", "Check"], ["T1", "1 byte", "2 bytes"]],
        [["Register", "Name"], ["40001", "Speed"]],
        [["Pin", "Wire", "Colour"], ["1", "A", "red"]],
        [["40002", "Flow"]],
    )
    (found,), stated = read_pdf(pdf(*pages), "list.pdf", (), None)
    assert [row.cells for row in found.rows] == [("Register", "Name"), ("40001", "Speed"), ("40002", "Flow")]
    joined, before, other = stated
    assert joined == "the tables of pages 2, 4 are read as one"
    assert before == "a table on page 1 has no header and is passed over"
    assert other.startswith("2 rows of tables on page 3 have 3 columns, not the 2 of the list, and are passed over")
    assert "--pages 3 --header none" in other


def test_without_headers_the_tables_as_wide_as_most_rows_are_read(pdf: Callable[..., bytes]) -> None:
    pages = ([["a", "b", "c"]], [["1", "Speed"], ["2", "Flow"]], [["3", "Heat"]])
    (found,) = grids(pdf(*pages), "list.pdf", header="none")
    assert [row.cells[0] for row in found.rows] == ["1", "2", "3"]


def test_two_lists_of_registers_with_other_columns_are_refused(pdf: Callable[..., bytes]) -> None:
    data = pdf([["Register", "Name"], ["40001", "Speed"]], [["Register", "Name", "Unit"], ["40002", "Flow", "l/h"]])
    assert "the list of registers on page 2 has 3 columns, and that on page 1 has 2" in refusal(data, "list.pdf")


def test_a_pdf_without_tables_a_broken_one_and_a_protected_one_are_refused(pdf: Callable[..., bytes]) -> None:
    assert "its page 1 has no table with ruled lines: copy the table" in refusal(pdf([]), "list.pdf")
    assert "is a broken PDF" in refusal(b"%PDF-1.4 nothing else", "list.pdf")
    lock = (
        "/Encrypt << /Filter /Standard /V 1 /R 2 /P -4 /O <" + "00" * 32 + "> /U <" + "00" * 32 + "> >> /ID [<00><00>]"
    )
    assert "protected by a password" in refusal(pdf([["Register", "Name"]], more=lock), "list.pdf")


def test_without_the_extra_a_pdf_is_refused_with_what_to_install(
    pdf: Callable[..., bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    import sys  # noqa: PLC0415 - one test

    monkeypatch.setitem(sys.modules, "pdfplumber", None)
    assert 'pip install "regscribe[pdf]"' in refusal(pdf([["Register", "Name"]]), "list.pdf")


@pytest.mark.parametrize(
    ("data", "name", "found"),
    [
        (b"anything", "list.csv", Likeness.PERHAPS),
        (b"PK\x03\x04", "list", Likeness.PERHAPS),
        (b"%PDF-1.7", "list", Likeness.PERHAPS),
        (HEAD.encode(), "stdin", Likeness.PERHAPS),
        (b"modbus:\n  - name: hub\n", "configuration.yaml", Likeness.NO),
        (b"", "list.csv", Likeness.NO),
        (b"\0\1\2\0", "stdin", Likeness.NO),
    ],
)
def test_what_is_perhaps_a_table_is_told_by_a_look(data: bytes, name: str, found: Likeness) -> None:
    assert table.likeness(data, name) is found


def test_columns_have_letters_as_in_a_spreadsheet() -> None:
    for number, name in ((0, "A"), (25, "Z"), (26, "AA"), (701, "ZZ"), (702, "AAA")):
        assert grid.letters(number) == name
        assert grid.number_of(name) == number


BEGINNINGS = (b"", b"%PDF-1.4\n", b"PK\x03\x04", archive.OLE, b"\xff\xfe", b"Address,Name,Type\n", b"sep=;\n")


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.sampled_from(BEGINNINGS), st.binary(max_size=200), st.sampled_from(["list.csv", "list.xlsx", "stdin"]))
def test_no_bytes_raise_anything(beginning: bytes, data: bytes, name: str) -> None:
    table.likeness(beginning + data, name)
    found = table.read(beginning + data, name, {})
    assert found.failed or found.stated


@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.integers(0, 4000), st.binary(min_size=1, max_size=30))
def test_a_workbook_in_which_bytes_are_wrong_is_read_or_refused(at: int, wrong: bytes) -> None:
    book = openpyxl.Workbook()
    for row in ROWS:
        book.worksheets[0].append(row)
    data = io.BytesIO()
    book.save(data)
    spoiled = data.getvalue()[:at] + wrong + data.getvalue()[at + len(wrong) :]
    assert table.read(spoiled, "list.xlsx", {}) is not None
