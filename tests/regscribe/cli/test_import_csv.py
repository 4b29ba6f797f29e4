"""`regscribe import TABLE.csv`: what a table says outright is in the map, what it does not is told."""

from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from regscribe.model import Kind, RegisterMap
from regscribe.pipeline import compile_map

pytestmark = pytest.mark.usefixtures("folder")

TABLE = """\
Model;Address;Name;R/W;Type;Unit;Min;Max;Default;Enum;Flags;Scale;Group;Source
M1;1;Setpoint;R/W;int16;°C;-50;400;20.5;;;x/10;Control;4.10
M2;1;Setpoint;R/W;int16;°C;-50;400;20.5;;;x/10;Control;4.10
M1;2;Mode;rw;;;;;1;0 = stop; 1 = run;;;Control;
M1;3;Alarms;read only;;;;;;;0 = high; 3 = low;;Status;
M2;4;Raw;r;uint32;;;;;;;not stated;Status;
"""


def imported(cli: Callable[..., Any], table: str) -> tuple[Any, RegisterMap | None]:
    Path("table.csv").write_text(table, encoding="utf-8")
    path = Path("maps/acme/pump.yaml")
    done = cli("import", "table.csv", "--format", "csv", "-o", path)
    return done, compile_map(path).map if path.exists() else None


def test_what_a_table_says_outright_is_in_the_map(cli: Callable[..., Any]) -> None:
    done, found = imported(
        cli,
        TABLE.replace("0 = stop; 1 = run", '"0 = stop; 1 = run"').replace("0 = high; 3 = low", '"0 = high; 3 = low"'),
    )
    assert (done.code, "4 rows: 4 whole, 0 with loss, 0 left out" in done.err) == (0, True)
    assert found is not None
    assert [[register.path for register in model.registers] for model in found.models] == [
        ["setpoint", "mode", "alarms"],
        ["setpoint", "raw"],
    ]
    setpoint, mode, alarms = found.model("M1").registers
    assert (setpoint.address, setpoint.base.type, setpoint.section) == (1, "int16", "4.10")
    assert (setpoint.default, setpoint.scale[0].then.multiply) == (Fraction("20.5"), Fraction(1, 10))
    assert mode.enum is not None
    assert [(member.code, member.label) for member in mode.enum.members] == [(0, "stop"), (1, "run")]
    assert [(bit.low, bit.label) for bit in alarms.fields] == [(0, "high"), (3, "low")]
    assert found.model("M2").register("raw").kind is Kind.RAW


def test_a_map_comes_back_from_its_export(cli: Callable[..., Any], oven: Path) -> None:
    before = compile_map(oven).map
    done, found = imported(cli, cli("export", "acme/oven", "--format", "csv").out)
    assert (done.code, "2 rows: 2 whole, 0 with loss, 0 left out" in done.err) == (0, True)
    assert found is not None
    assert before is not None
    assert cli("compare", oven, "maps/acme/pump.yaml").code == 0
    assert [one.range for one in found.models[0].registers] == [one.range for one in before.models[0].registers]


@pytest.mark.parametrize(
    ("cells", "said", "code"),
    [
        ("unit\nmode: °C; otherwise: °F", "with loss: unit-in-words: left out: unit `mode: °C; otherwise: °F`", 0),
        ("minimum\nlow_limit", "with loss: minimum-in-words: left out: minimum `low_limit`", 0),
        ("scale\nx/10^dp", "with loss: scale-in-words: left out: scale `x/10^dp`; the number is raw", 0),
        ("type\nbcd", "left out: place-unclear: the number hangs on what is in words: type `bcd`", 1),
        ("kind\ncommand", "left out: command: a command is not read back", 1),
    ],
)
def test_what_no_key_says_is_left_out_and_told(cli: Callable[..., Any], cells: str, said: str, code: int) -> None:
    column, cell = cells.split("\n")
    done, found = imported(cli, f"address,name,access,{column}\n1,Level,r,{cell}\n2,Flow,r,\n")
    assert done.code == code
    assert f"table.csv:2:1: Level: {said}" in done.err
    assert found is not None
    assert [register.path for register in found.models[0].registers] == ["level", "flow"][code:]


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("", "table.csv is empty"),
        ("address,name\n1,Level\n", "no column access"),
        ("address,name,access\nx,Level,r\n", "address-unclear: no decimal address: `x`"),
        ("address,name,access,colour\n1,Level,r,red\n", "there is no column `colour`"),
        ("\ud800", "UTF-8"),
    ],
)
def test_a_table_that_is_none_writes_nothing(cli: Callable[..., Any], table: str, said: str) -> None:
    Path("table.csv").write_bytes(table.encode(errors="surrogatepass"))
    done = cli("import", "table.csv", "--format", "csv", "-o", "maps/acme/pump.yaml")
    assert done.code == 1
    assert said in done.err
    assert not Path("maps").exists()


def test_a_format_without_a_file_is_wrong_usage(cli: Callable[..., Any]) -> None:
    assert cli("new", "acme/pump", "--format", "csv").code == 2
    assert not Path("maps").exists()
