"""`regscribe import` with a mapping: how a list is read is kept, rows are corrected, and the next list is merged."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from regscribe.pipeline import compile_map

pytestmark = pytest.mark.usefixtures("folder")

LIST = "address,name,access,unit,scale,group\n1,Speed,rw,%,,Drive\n2,Flow,r,l/h,x/10,Drive\n3,Spare,r,,,Drive\n"
MAP, MAPPING = Path("maps/acme/pump.yaml"), Path("maps/acme/pump.import.yaml")


def run(cli: Callable[..., Any], text: str, *arguments: str | Path) -> Any:
    Path("list.csv").write_text(text, encoding="utf-8")
    return cli("import", "list.csv", *arguments)


def first(cli: Callable[..., Any]) -> None:
    done = run(cli, LIST, "--format", "csv", "-o", MAP, "--save-mapping", MAPPING)
    assert done.code == 0, done.err


def test_the_next_list_is_merged_into_the_edited_map(cli: Callable[..., Any]) -> None:
    first(cli)
    edited = (
        MAP.read_text(encoding="utf-8")
        .replace("name: Speed", "name: Motor speed  ")
        .replace("unit: l/h", "unit: l/min")
    )
    MAP.write_bytes(edited.replace("\n", "\r\n").encode())
    text = LIST.replace("l/h,x/10", "m³/h,x/100") + "4,Level,r,%,,Drive\n"
    done = run(cli, text, "--mapping", MAPPING, "-o", MAP, "--merge")
    assert done.code == 1
    assert "Flow (holding 2): changed: decimals: `1` -> `2` in the list" in done.err
    assert "Flow (holding 2): kept as you have it: unit: `l/h` -> `m³/h` in the list, and `l/min` here" in done.err
    assert "Level (holding 4): added: to the group Drive" in done.err
    expected = edited.replace("decimals: 1", "decimals: 2") + "      - {at: 4, name: Level, access: r, unit: '%'}\n"
    assert MAP.read_bytes() == expected.replace("\n", "\r\n").encode()
    again = run(cli, text, "--mapping", MAPPING, "-o", MAP, "--merge")
    assert (again.code, MAP.read_bytes()) == (0, expected.replace("\n", "\r\n").encode())


def test_the_report_as_json_and_sarif_has_what_was_merged(cli: Callable[..., Any]) -> None:
    first(cli)
    text = LIST.replace("x/10", "x/100")
    done = run(cli, text, "--mapping", MAPPING, "-o", MAP, "--merge", "--report", "json", "--report-to", "report.json")
    report = json.loads(Path("report.json").read_text(encoding="utf-8"))
    assert done.code == 0
    assert [(note["change"], note["name"]) for note in report["merge"]] == [("changed", "Flow (holding 2)")]
    done = run(cli, LIST, "--mapping", MAPPING, "-o", MAP, "--merge", "--report", "sarif")
    assert '"merge/changed"' in done.err


def test_a_merge_that_check_refuses_writes_nothing(cli: Callable[..., Any]) -> None:
    first(cli)
    MAP.write_text(MAP.read_text(encoding="utf-8").replace("{at: 3,", "{at: 30,"), encoding="utf-8")
    before, mapping = MAP.read_bytes(), MAPPING.read_bytes()
    done = run(cli, LIST.replace("2,Flow", "30,Flow"), "--mapping", MAPPING, "-o", MAP, "--merge")
    assert done.code == 1
    assert "overlaps" in done.err
    assert (MAP.read_bytes(), MAPPING.read_bytes()) == (before, mapping)


def test_what_a_person_wrote_in_the_mapping_stays(cli: Callable[..., Any]) -> None:
    first(cli)
    own, mark, said = MAPPING.read_text(encoding="utf-8").partition("# What the last import said")
    assert mark
    mine = own + "# the vendor says these are not in use\nskip: [{name: Spare, reason: not in use}]\n"
    MAPPING.write_text(mine + mark + said, encoding="utf-8")
    done = run(cli, LIST, "--mapping", MAPPING, "-o", MAP, "--merge")
    assert "1 row is skipped, as maps/acme/pump.import.yaml says" in done.err
    assert "Spare (holding 3): gone from the list" in done.err
    assert MAPPING.read_text(encoding="utf-8").startswith(mine.rstrip() + "\n")


def test_a_fix_settles_what_the_row_leaves_unclear(cli: Callable[..., Any]) -> None:
    Path("fix.import.yaml").write_text(
        "format: 1\nimporter: csv\nfixes:\n"
        "  - {at: 2, set: {decimals: 1, enum: null}, reason: page 30}\n"
        "  - {row: 'list.csv:4:1', set: {at: 7, access: r, enum: {0: off, 1: on}}}\n"
        "  - {name: Nobody, set: {unit: V}}\n",
        encoding="utf-8",
    )
    text = LIST.replace("x/10", "x/10^dp").replace("3,Spare", "three,Spare")
    done = run(cli, text, "--mapping", "fix.import.yaml", "-o", MAP)
    assert done.code == 0
    assert "the source has no row `Nobody`, which is to be skipped or fixed" in done.err
    assert "Flow: whole: fixed: decimals, enum as you say (page 30)" in done.err
    found = compile_map(MAP).map
    assert found is not None
    assert "{at: 2, name: Flow, access: r, unit: l/h, decimals: 1}" in MAP.read_text(encoding="utf-8")
    spare = found.models[0].register("spare")
    assert spare.enum is not None
    assert (spare.address, [member.label for member in spare.enum.members]) == (7, ["off", "on"])


@pytest.mark.parametrize(
    ("arguments", "said", "code"),
    [
        (("--merge",), "--merge needs the map that is to be changed", 2),
        (
            ("--merge", "-o", "maps/x/y.yaml", "--mapping", MAPPING),
            "maps/x/y.yaml does not exist: leave --merge out",
            2,
        ),
        (("-o", MAP), "maps/acme/pump.yaml exists; nothing was changed", 2),
        (("-o", "maps/x/y.yaml", "--save-mapping", MAPPING), "pump.import.yaml exists; nothing of it was changed", 2),
        (("--mapping", "none.yaml"), "there is no file none.yaml", 1),
        (("--mapping", MAP), "is no mapping of an import", 1),
    ],
)
def test_wrong_use_of_a_mapping_is_refused_and_writes_nothing(
    cli: Callable[..., Any], arguments: tuple[str | Path, ...], said: str, code: int
) -> None:
    first(cli)
    before = sorted(Path().rglob("*"))
    done = run(cli, LIST, "--format", "csv", *arguments)
    assert (done.code, said in done.err) == (code, True), done.err
    assert sorted(Path().rglob("*")) == before


def test_a_mapping_without_a_last_import_cannot_be_merged(cli: Callable[..., Any]) -> None:
    first(cli)
    Path("bare.yaml").write_text("format: 1\nimporter: csv\n")
    done = run(cli, LIST, "--mapping", "bare.yaml", "-o", MAP, "--merge")
    assert (done.code, "does not say what the last import said" in done.err) == (2, True)


def test_a_mapping_beside_maps_is_no_map(cli: Callable[..., Any]) -> None:
    first(cli)
    assert cli("check", "maps").code == 0
    done = cli("check", MAPPING)
    assert (done.code, "is the mapping of an import and no map" in done.err) == (2, True)
