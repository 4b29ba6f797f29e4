"""`regscribe import` of tables, from the command line: what is found comes out, what is no table is one message."""

import io
import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import openpyxl
import pytest

from regscribe.model import Kind
from regscribe.pipeline import compile_map

pytestmark = pytest.mark.usefixtures("folder")

LIST = """\
Register;Bezeichnung;Typ;Faktor;Einheit;Zugriff;Bemerkung
Messwerte;;;;;;
40001;Drehzahl;U16;;1/min;L;
40002;Druck;S16;0,01;bar;L;
40003;Betrieb;U16;;;L;0 = aus, 1 = an
Sollwerte;;;;;;
40101;Sollwert;U32;siehe S. 3;bar;L/S;
40103;Zeit;weird;;s;L/S;
"""


def workbook() -> bytes:
    book = openpyxl.Workbook()
    sheet = book.worksheets[0]
    sheet.append(["Address", "Name", "Type", "Access"])
    sheet.append([1, "Speed", "U16", "R"])
    data = io.BytesIO()
    book.save(data)
    return data.getvalue()


def bomb() -> bytes:
    data = io.BytesIO(workbook())
    with zipfile.ZipFile(data, "a", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/more.xml", b" " * 30_000_000)
    return data.getvalue()


def test_a_list_becomes_a_map_that_compiles_and_the_report_tells_what_is_open(cli: Callable[..., Any]) -> None:
    Path("liste.csv").write_bytes(LIST.encode("cp1252"))
    done = cli("import", "liste.csv", "-o", "maps/acme/pumpe.yaml", "--report", "json", "--report-to", "report.json")
    report = json.loads(Path("report.json").read_text(encoding="utf-8"))
    assert done.code == 1
    assert report["counts"] == {"whole": 3, "with_loss": 1, "left_out": 1}
    assert [column["meaning"] for column in report["columns"]] == [
        "at",
        "name",
        "type",
        "scale",
        "unit",
        "access",
        "description",
    ]
    assert [(row["where"], row["outcome"]) for row in report["rows"]][-2:] == [
        ("line 7", "with loss"),
        ("line 8", "left out"),
    ]
    found = compile_map(Path("maps/acme/pumpe.yaml")).map
    assert found is not None
    speed, pressure, running, setpoint = found.models[0].registers
    assert (speed.address, pressure.scale[0].then.multiply.denominator, running.kind) == (0, 100, Kind.ENUM)
    assert (setpoint.kind, setpoint.base.words, setpoint.group) == (Kind.RAW, 2, "sollwerte")
    assert "# TODO the scale is unclear" in Path("maps/acme/pumpe.yaml").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("list.xlsx", workbook()[:3000], "list.xlsx is a broken workbook"),
        ("list.xlsx", bomb(), "would unpack to 30000000"),
        ("list.xlsx", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + b"\0" * 600, "save it as .xlsx"),
        ("list.csv", b'Address,Name\n1,"x\n', "list.csv:2: the quotes of this row are broken"),
        ("list.csv", b"Address,Name\n1,x\0\n", "list.csv:2: this line holds a NUL byte"),
        ("list.csv", b"one\ntwo\n", "no row looks like the header of a list of registers"),
        ("list.csv", b"Address,Name\n1,a\n", "no row of it became a register"),
        ("list.pdf", b"%PDF-1.7\nnothing", "list.pdf is a broken PDF"),
    ],
)
def test_what_is_no_table_is_one_message_and_nothing_is_written(
    cli: Callable[..., Any], name: str, data: bytes, said: str
) -> None:
    Path(name).write_bytes(data)
    done = cli("import", name, "-o", "maps/acme/pump.yaml", "--save-mapping", "m.yaml")
    assert done.code == 1
    assert done.err.count("error: ") == 1
    assert said in done.err
    assert (Path("maps").exists(), Path("m.yaml").exists(), done.out) == (False, False, "")


def test_an_empty_source_is_told_as_such(cli: Callable[..., Any]) -> None:
    Path("list.csv").write_bytes(b"\n")
    done = cli("import", "list.csv", "-o", "maps/acme/pump.yaml")
    assert (done.code, Path("maps").exists()) == (2, False)
    assert "list.csv is empty" in done.err


def test_a_wrong_option_is_wrong_usage(cli: Callable[..., Any]) -> None:
    Path("liste.csv").write_text(LIST, encoding="utf-8")
    done = cli("import", "liste.csv", "--base", "seven", "-o", "maps/acme/pump.yaml")
    assert (done.code, "--base seven: write some of 0, 1, modicon" in done.err, Path("maps").exists()) == (
        2,
        True,
        False,
    )


def test_many_rows_of_which_the_same_is_said_are_told_together_and_apart_in_json(cli: Callable[..., Any]) -> None:
    rows = "".join(f"{at};Point {at};odd{at};\n" for at in range(1, 9))
    Path("list.csv").write_text(f"Register;Name;Type;Access\n{rows}9;Speed;U16;R\n", encoding="utf-8")
    told = cli("import", "list.csv", "-o", "map.yaml").err.splitlines()
    assert [line for line in told if "is no type" in line] == [
        "line 2: Point 1: left out: type-unclear: `odd1` is no type"
    ]
    assert "  and 7 rows more of which the same is said: line 3, line 4, line 5, .. line 9" in told
    cli("import", "list.csv", "-o", "other.yaml", "--report", "json", "--report-to", "report.json")
    assert len(json.loads(Path("report.json").read_text(encoding="utf-8"))["rows"]) == 9


def test_a_name_longer_than_any_is_cut_in_the_text_of_the_report(cli: Callable[..., Any]) -> None:
    Path("long.csv").write_text(
        f"Address,Name,Type,Access\n1,{'n' * 30_000},what,r\n2,Level,uint16,r\n", encoding="utf-8"
    )
    done = cli("import", "long.csv")
    assert f"{'n' * 100}..." in done.err
    assert "n" * 101 not in done.err


def test_a_configuration_in_lines_is_no_table_even_if_one_looks_like_a_header(cli: Callable[..., Any]) -> None:
    Path("flow.yaml").write_text("Address, Name, Type, Access\n1, Level, uint16, r\n", encoding="utf-8")
    assert "nothing here reads flow.yaml" in cli("import", "flow.yaml").err
