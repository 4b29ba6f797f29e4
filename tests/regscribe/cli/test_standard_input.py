"""`-` in place of a file, wherever one is read or written."""

import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from .conftest import PLAIN

Cli = Callable[..., Any]
TABLE = "address,name\n1,Setpoint\n2,Mode\n"


@pytest.fixture
def given(monkeypatch: pytest.MonkeyPatch) -> Callable[[str | bytes], None]:
    """Put a text where standard input is read."""

    def put(text: str | bytes) -> None:
        content = text.encode() if isinstance(text, str) else text
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(content), encoding="utf-8"))

    return put


def test_a_map_from_standard_input_is_checked(cli: Cli, given: Callable[..., None]) -> None:
    given(PLAIN)
    assert cli("check", "-").out == "1 map checked: no findings\n"


def test_a_mistake_in_standard_input_is_shown_with_its_line(cli: Cli, given: Callable[..., None]) -> None:
    given(PLAIN.replace("format: 1", "format: 1\nfromat: 1"))
    result = cli("check", "-")
    assert result.code == 1
    assert "  --> -:2:1\n    2 | fromat: 1\n      | ^^^^^^\n" in result.out


def test_the_text_of_standard_input_is_shown_under_the_name_that_it_counts_as(
    cli: Cli, given: Callable[..., None], oven: Path
) -> None:
    given(PLAIN.replace("format: 1", "format: 1\nfromat: 1"))
    result = cli("check", "-", "--stdin-filename", oven.relative_to(Path.cwd()))
    assert "  --> maps/acme/oven.yaml:2:1\n    2 | fromat: 1\n" in result.out
    assert oven.read_text(encoding="utf-8") == PLAIN


def test_what_standard_input_builds_on_is_found_from_the_name_that_it_counts_as(
    cli: Cli, given: Callable[..., None], folder: Path
) -> None:
    base = folder / "elsewhere" / "acme" / "oven.yaml"
    base.parent.mkdir(parents=True)
    base.write_text(PLAIN)
    variant = """\
format: 1
map: {id: acme/kiln, title: Kiln, maker: Acme, class_prefix: Kiln}
extends: acme/oven
manual: {title: Manual, number: "2"}
models: {K1: {from: M1}}
"""
    given(variant)
    assert "acme/oven" in cli("check", "-").out
    given(variant)
    result = cli("check", "-", "--stdin-filename", base.with_name("kiln.yaml"), "-v")
    assert result.out == "1 map checked: no findings\n"
    assert f"read {base}\n" in result.err


def test_bytes_that_are_no_utf8_are_a_finding(cli: Cli, given: Callable[..., None]) -> None:
    given(b"format: 1\nmap: \xb0C\n")
    result = cli("check", "-")
    assert (result.code, "-:2:6" in result.out) == (1, True)


def test_every_command_that_takes_a_map_takes_standard_input(cli: Cli, given: Callable[..., None], oven: Path) -> None:
    for arguments in (
        ("export", "-", "--format", "csv"),
        ("coverage", "-"),
        ("compare", "-", oven),
        ("compare", oven, "-"),
        ("plan", "-", "--all"),
        ("breaking", "-", "--against", oven),
    ):
        given(TABLE if arguments[-1] == "-" and arguments[0] == "compare" else PLAIN)
        result = cli(*arguments)
        assert (result.code, "rror" in result.err) == (0, False), (arguments, result)


def test_standard_input_is_not_the_map_and_the_table(cli: Cli) -> None:
    assert cli("compare", "-", "-").code == 2


def test_generate_wants_a_file(cli: Cli) -> None:
    result = cli("generate", "-")
    assert (result.code, "name its file" in result.err) == (2, True)


def test_frames_from_standard_input_are_decoded(cli: Cli, given: Callable[..., None]) -> None:
    for arguments in (("decode", "16C", "-"), ("decode", "16C"), ("decode", "16C", "--log", "-")):
        given("01 03 0F D1 00 01 D7 27\n")
        assert cli(*arguments).out == "unit 1 -> read holding 4049: input_type\n"


def test_a_backup_from_standard_input_is_read_and_refused_with_its_place(cli: Cli, given: Callable[..., None]) -> None:
    for arguments in (
        ("diff", "-", "factory"),
        ("restore", "tcp:127.0.0.1:1?model=16C", "-"),
        ("program", "draw", "-"),
    ):
        given("format: 1\nnothing: 1\n")
        result = cli(*arguments)
        assert (result.code, "standard input is no " in result.err) == (2, True), arguments
        assert "standard input:2:1" in result.err


def test_the_state_of_a_simulated_device_is_read_from_standard_input(cli: Cli, given: Callable[..., None]) -> None:
    begin = ("simulate", "athena/series-c", "--model", "16C", "--tcp", "127.0.0.1:0")
    given("format: 1\nnothing: 1\n")
    result = cli(*begin, "--state", "-")
    assert (result.code, "standard input is no state" in result.err) == (1, True)
    result = cli(*begin, "--save", "-")
    assert (result.code, "standard output tells the requests" in result.err) == (2, True)


def test_a_dash_is_standard_output(cli: Cli, given: Callable[..., None], oven: Path) -> None:
    arguments = ("export", oven, "--format", "csv")
    assert cli(*arguments, "-o", "-").out == cli(*arguments).out
    list_of_registers = "Address,Name,Type,Access\n1,Level,uint16,r\n"
    given(list_of_registers)
    usual = cli("import", "-").out
    given(list_of_registers)
    assert cli("import", "-", "-o", "-").out == usual != ""
    given(list_of_registers)
    assert cli("import", "-", "--report", "json", "--report-to", "-").out.startswith(usual)
    assert not Path("-").exists()
