"""Tables as spreadsheets write them, and tables that are none: each is refused with where, why and what to do."""

from collections.abc import Callable

import pytest

from regscribe.evidence.differences import Comparison
from regscribe.evidence.table import TableError, read

Held = Callable[..., Comparison]

EXCEL = 'sep=;\r\nmodel;address;name;default\r\nK1;1;"Set-Point\r\n(RAM)";25\r\n;;;\r\nK1;2;Sensor;1\r\n'


@pytest.mark.parametrize(
    "content",
    [
        EXCEL.encode(),
        b"\xef\xbb\xbf" + EXCEL.encode(),
        EXCEL.replace("sep=;\r\n", "").encode(),
        EXCEL.replace("sep=;", '"sep=;"').encode(),
        EXCEL.replace("sep=;\r\n", "").replace(";", "\t").encode(),
        EXCEL.replace("sep=;\r\n", "").replace(";", ",").replace("\r\n", "\n").encode(),
        EXCEL.replace("sep=;\r\n", "").replace("\r\n", ";\r\n").replace('"Set-Point;', '"Set-Point').encode(),
    ],
    ids=["excel", "byte order mark", "semicolons", "quoted sep", "tabs", "commas", "trailing separators"],
)
def test_a_table_is_read_as_spreadsheets_write_it(held: Held, content: bytes) -> None:
    found = held(content, partial=True)
    assert found.equal
    assert found.matched == 2


def test_a_row_knows_the_line_on_which_it_starts() -> None:
    assert [row.line for row in read(EXCEL.encode(), "t").rows] == [3, 6]
    assert [row.line for row in read(b'a,b\n\n"x\ny",1\nz,2\n', "t").rows] == [3, 5]


REFUSED = {
    "empty": (b"", "t.csv is empty: its first line must name the columns"),
    "blank": (b"\n,,\n", "t.csv is empty"),
    "no rows": (b"address,name\n", "t.csv has a header in line 1 and no row after it"),
    "no header": (b"0,Process Value,r\n1,Set-Point,rw\n", "none of `0`, `Process Value`, `r` is the name of a column"),
    "utf-16": ("address\n1\n".encode("utf-16"), "t.csv is encoded as UTF-16"),
    "utf-16 without mark": ("address\n1\n".encode("utf-16-le"), "t.csv is encoded as UTF-16"),
    "latin-1": ("address,unit\n1,°C\n".encode("latin-1"), r"t.csv:2: the byte 0xB0 is no UTF-8; .* Latin-1"),
    "workbook": (b"PK\x03\x04...", "t.csv is a workbook and no CSV"),
    "open quote": (b'model,address,name\nK1,1,"Set\nK1,2,Sensor\n', r"t.csv:2: this row is no CSV \("),
    "text after a quote": (b'model,address,name\nK1,1,"Set"x\n', r"t.csv:2: this row is no CSV \("),
    "short row": (b"model,address,name\nK1,1\n", "t.csv:2: this row has 2 cells and the header has 3"),
    "long row": (b"model,address\nK1,1,x\n", "t.csv:2: this row has 3 cells and the header has 2"),
    "unknown column": (b"model,adress\nK1,1\n", "there is no column `adress`; did you mean `address`?"),
    "foreign column": (b"model,address,zzz\nK1,1,x\n", "there is no column `zzz`; there are map, model, id"),
    "nameless column": (b"model,address,,name\nK1,1,x,y\n", "column 3 has no name in the header, but content"),
    "doubled column": (b"model,address,Address\nK1,1,2\n", "`address` and `Address` both are the column `address`"),
    "two names of one column": (b"address,min,minimum\n1,2,3\n", "`min` and `minimum` both are the column `minimum`"),
    "no key": (b"model,name\nK1,Sensor\n", "t.csv has none of the columns address, JBUS, id"),
    "no model": (b"address,name\n1,x\n", "no column `model`, and acme/kiln has K1, K2: name one with --model"),
    "empty model": (b"model,address\n,1\n", "t.csv:2: the cell of the column model is empty"),
    "hexadecimal address": (
        b"model,address\nK1,0x10\n",
        "t.csv:2: column address: `0x10` is neither a decimal address",
    ),
    "backward stretch": (b"model,address\nK1,9..8\n", "t.csv:2: column address: `9..8` is neither"),
    "endless stretch": (b"model,address\nK1,0..999999999\n", "t.csv:2: column address"),
    "no place": (b"model,address,id\nK1,,\n", "t.csv:2: there is neither an address nor an id"),
    "unknown space": (b"model,address,space\nK1,1,4x\n", "column space: `4x` is none of holding, input, coil"),
    "notation without space": (b"model,jbus,space\nK1,1,status\n", "no notation JBUS for the space status"),
    "decimal comma": (
        b"model;address;default\nK1;1;25,0\nK1;2;1,0\n",
        r"t.csv:2: column default: `25,0` has a comma: write a decimal point.*\nt.csv:3: .*`1,0`",
    ),
    "broken object": (b'model,address,values\nK1,2,"{""0"": "\n', "t.csv:2: column values: .* neither a JSON object"),
    "deep object": (b"model,address,values\nK1,2,{" + b"[" * 9000 + b"\n", "t.csv:2: column values"),
    "doubled row": (b"model,address\nK1,1\nK1,2\nK1,1\n", "t.csv: lines 2 and 4 both describe 1 of K1: remove one"),
    "doubled by model": (b"model,address\nK1 K2,1\nK2,1\n", "t.csv: lines 2 and 3 both describe 1 of K2"),
    "doubled by stretch": (b"model,address\nK1,20..21\nK1,21\n", "t.csv: lines 2 and 3 both describe 21 of K1"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_table_is_refused_with_place_and_reason(held: Held, name: str) -> None:
    content, reason = REFUSED[name]
    with pytest.raises(TableError, match=reason):
        held(content)


def test_of_many_faults_ten_are_told(held: Held) -> None:
    with pytest.raises(TableError) as refused:
        held("model,address\n" + "K1,x\n" * 13)
    assert str(refused.value).count("t.csv:") == 10
    assert str(refused.value).endswith("\nand 3 more")


@pytest.mark.parametrize(
    ("columns", "reason"),
    [
        (["adress"], "there is no column `adress`; did you mean `address`?"),
        (["unit"], "t.csv has no column `unit`: it has model, address, note"),
        (["default=worth"], "t.csv has no column `worth`"),
    ],
)
def test_columns_that_do_not_exist_are_refused(held: Held, columns: list[str], reason: str) -> None:
    with pytest.raises(TableError, match=reason):
        held("model,address,note\nK1,1,x\n", columns=columns)


def test_a_model_that_does_not_exist_is_refused(held: Held) -> None:
    with pytest.raises(TableError, match="acme/kiln has no model `K9`; did you mean"):
        held("address\n1\n", model="K9")
