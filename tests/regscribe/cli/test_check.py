import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest


def test_a_good_map_exits_0(cli: Callable[..., Any], oven: Path) -> None:
    result = cli("check", oven)
    assert (result.code, result.out, result.err) == (0, "1 map checked: no findings\n", "")


def test_without_a_path_the_folder_maps_is_searched(cli: Callable[..., Any], oven: Path) -> None:
    assert cli("check").out == "1 map checked: no findings\n"
    (oven.parent / ".hidden.yaml").write_text("not: a map")
    (oven.parent / "notes.txt").write_text("not a map")
    assert cli("check").out == "1 map checked: no findings\n"


def test_a_map_named_twice_is_checked_once(cli: Callable[..., Any], oven: Path) -> None:
    assert cli("check", oven, "maps", "acme/oven").out == "1 map checked: no findings\n"


def test_an_error_exits_1_and_shows_the_line_with_carets(cli: Callable[..., Any], oven: Path) -> None:
    oven.write_text(oven.read_text().replace("format: 1\n", "format: 1\nfromat: 1\n"))
    result = cli("check")
    assert result.code == 1
    assert "  --> maps/acme/oven.yaml:2:1\n    2 | fromat: 1\n      | ^^^^^^\n" in result.out
    assert result.out.endswith("1 map checked: 1 error\n")


def test_a_separator_that_ends_no_line_does_not_shift_what_is_shown(cli: Callable[..., Any], oven: Path) -> None:
    oven.write_text(oven.read_text().replace("name: Control", "name: Con\u2028trol"))
    assert "    9 |     name: Con\ufffdtrol\n      |              ^\n" in cli("check").out


def test_all_maps_are_checked_even_if_the_first_is_wrong(cli: Callable[..., Any], oven: Path) -> None:
    (oven.parent / "a.yaml").write_text("")
    (oven.parent / "b.yaml").write_text("x: [")
    result = cli("check")
    assert "a.yaml" in result.out
    assert "b.yaml" in result.out
    assert "3 maps checked: 2 errors\n" in result.out


def test_warnings_exit_0_unless_strict(cli: Callable[..., Any], oven: Path) -> None:
    waiver = 'waivers:\n  - {rule: RS0472, at: setpoint, reason: "nothing is against it"}\n'
    oven.write_text(oven.read_text() + waiver)
    result = cli("check")
    assert (result.code, "1 map checked: 1 warning\n" in result.out) == (0, True)
    assert cli("check", "--strict").code == 1


@pytest.mark.parametrize("form", ["json", "sarif"])
def test_machine_formats_are_json_with_and_without_findings(cli: Callable[..., Any], oven: Path, form: str) -> None:
    assert isinstance(json.loads(cli("check", "--format", form).out), dict)
    oven.write_text("")
    result = cli("check", "--format", form)
    assert result.code == 1
    assert "RS0107" in json.dumps(json.loads(result.out))


def test_github_annotations_are_one_line_each_and_none_without_findings(cli: Callable[..., Any], oven: Path) -> None:
    assert cli("check", "--format", "github").out == ""
    oven.write_text("")
    result = cli("check", "--format", "github")
    assert result.out.startswith("::error file=maps/acme/oven.yaml,line=1,")
    assert result.out.count("\n") == 1


def test_the_maps_that_come_with_regscribe_are_found_by_id(cli: Callable[..., Any], folder: Path) -> None:
    assert not (folder / "maps").exists()
    assert "1 map checked" in cli("check", "fdc/series-100").out


def test_a_map_of_ones_own_comes_before_one_that_is_shipped(cli: Callable[..., Any], oven: Path) -> None:
    mine = oven.parents[1] / "fdc" / "series-100.yaml"
    mine.parent.mkdir()
    mine.write_text("")
    assert "maps/fdc/series-100.yaml:1:1" in cli("check", "fdc/series-100").out


def test_colour_is_for_terminals_alone(cli: Callable[..., Any], oven: Path) -> None:
    oven.write_text("")
    assert "\x1b" not in cli("check").out


@pytest.mark.parametrize("command", ["check", "generate", "export --format csv"])
def test_no_maps_at_all_is_usage(cli: Callable[..., Any], folder: Path, command: str) -> None:
    assert "there is no folder maps/ here" in cli(*command.split()).err
    (folder / "maps").mkdir()
    result = cli(*command.split())
    assert (result.code, "there is no map (*.yaml) in the folder maps" in result.err) == (2, True)
