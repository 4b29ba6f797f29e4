"""-q, -v, -V and --color before and after the name of a command; the exit codes and their table."""

import io
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
import pytest

from regscribe.cli.app import COMMANDS, regscribe
from regscribe.cli.shared.exit_codes import EXIT_CODES
from regscribe.cli.shared.output import in_colour

from .test_colour import Terminal

ROOT = Path(__file__).parents[3]
Cli = Callable[..., Any]
BAD = "format: 1\nfromat: 1\n"


def both(option: list[str], command: list[str]) -> list[list[str]]:
    """The option before and after the name of the command."""
    return [[*option, *command], [*command, *option]]


@pytest.mark.parametrize("arguments", both(["-q"], ["check"]) + both(["--quiet"], ["check"]))
def test_quiet_leaves_out_that_nothing_was_found(cli: Cli, oven: Path, arguments: list[str]) -> None:
    assert (cli(*arguments).code, cli(*arguments).out) == (0, ""), oven


def test_quiet_leaves_findings(cli: Cli, oven: Path) -> None:
    oven.write_text(BAD)
    quiet, usual = cli("check", "-q"), cli("check")
    assert "fromat" in quiet.out
    assert usual.out == f"{quiet.out}1 map checked: 4 errors\n"
    assert (quiet.code, usual.code) == (1, 1)


def test_quiet_leaves_out_remarks_and_no_result(cli: Cli) -> None:
    decoded = ("decode", "16C", "zz")
    assert "there is no frame in it" in cli(*decoded).err
    assert cli(*decoded, "-q").err == ""
    assert cli("devices", "16C", "-q").out == cli("devices", "16C").out != ""


@pytest.mark.usefixtures("oven")
def test_quiet_generates_and_creates_without_a_word(cli: Cli) -> None:
    for arguments in (("generate", "-q"), ("new", "-q", "acme/kiln")):
        result = cli(*arguments)
        assert (result.code, result.out, result.err) == (0, "", "")


@pytest.mark.usefixtures("oven")
@pytest.mark.parametrize("arguments", both(["-v"], ["check"]) + both(["--verbose"], ["check", "acme/oven"]))
def test_verbose_names_files_and_times_on_standard_error(cli: Cli, arguments: list[str]) -> None:
    result = cli(*arguments)
    assert result.out == "1 map checked: no findings\n"
    lines = result.err.splitlines()
    assert lines[0] == "read maps/acme/oven.yaml"
    assert re.fullmatch(r"compiled maps/acme/oven.yaml in [0-9]+\.[0-9]{2} s", lines[1])
    assert re.fullmatch(r"done in [0-9]+\.[0-9]{2} s", lines[2])


def test_verbose_names_every_file_that_a_map_builds_on(cli: Cli) -> None:
    said = cli("-v", "check", "omega/cn8200").err
    assert "athena/series-c.yaml" in said


def test_verbose_names_the_configuration_that_counts(cli: Cli, folder: Path) -> None:
    (folder / "regscribe.yaml").write_text("format: 1\n")
    assert "configuration: regscribe.yaml\n" in cli("devices", "16C", "-v").err
    assert "configuration: none\n" in cli("devices", "16C", "--no-config", "-v").err


def test_quiet_and_verbose_contradict_each_other(cli: Cli) -> None:
    for arguments in (["-q", "check", "-v"], ["check", "-q", "-v"], ["-v", "-q", "check"]):
        result = cli(*arguments)
        assert (result.code, "contradict each other" in result.err) == (2, True)


@pytest.mark.parametrize("arguments", both(["-V"], ["check"]) + both(["--version"], ["check"]))
def test_the_version_has_a_short_name(cli: Cli, arguments: list[str]) -> None:
    assert cli(*arguments).out.startswith("regscribe 0.")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_says_in_its_help_what_quiet_verbose_and_color_do(cli: Cli, command: str) -> None:
    out = cli(command, "--help").out
    assert all(f"\n  {option} " in out for option in ("-q, --quiet", "-v, --verbose", "--color [auto|always|never]"))
    assert "--debug" not in out


@pytest.mark.parametrize("arguments", both(["--color", "always"], ["check"]))
def test_colours_are_had_on_a_pipe_for_the_asking(cli: Cli, oven: Path, arguments: list[str]) -> None:
    oven.write_text(BAD)
    assert "\x1b[1;31merror[" in cli(*arguments).out
    assert "\x1b" not in cli("check").out


def test_a_table_on_a_pipe_is_coloured_for_the_asking_and_says_the_same(cli: Cli) -> None:
    coloured = cli("devices", "16C", "--color=always").out
    assert "\x1b[36m16C" in coloured
    assert re.sub(r"\x1b\[[0-9;]*m", "", coloured) == cli("devices", "16C").out


@pytest.mark.parametrize(
    ("option", "environment", "terminal", "coloured"),
    [
        ("always", {"NO_COLOR": "1", "TERM": "dumb"}, False, True),
        ("never", {"FORCE_COLOR": "1", "CLICOLOR_FORCE": "1"}, True, False),
        ("auto", {"NO_COLOR": "1", "FORCE_COLOR": "1"}, True, False),
        ("auto", {"NO_COLOR": ""}, True, True),
        ("auto", {"FORCE_COLOR": "1"}, False, True),
        ("auto", {"CLICOLOR_FORCE": "1", "TERM": "dumb"}, False, True),
        ("auto", {"CLICOLOR_FORCE": "0"}, False, False),
        ("auto", {"TERM": "dumb"}, True, False),
        ("auto", {}, False, False),
        ("auto", {}, True, True),
    ],
)
def test_option_wins_over_variables_and_these_over_the_terminal(
    option: str,
    environment: dict[str, str],
    terminal: bool,  # noqa: FBT001 - a parameter of the table
    coloured: bool,  # noqa: FBT001 - as above
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name in ("NO_COLOR", "FORCE_COLOR", "CLICOLOR_FORCE"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    with regscribe.make_context("regscribe", ["--color", option, "check"]) as context:
        assert click.get_current_context() is context
        assert in_colour(Terminal() if terminal else io.StringIO()) == coloured


@pytest.mark.parametrize("page", ["README.md", "docs/cli.md"])
def test_the_exit_codes_are_told_as_they_are(page: str) -> None:
    rows = re.findall(r"^\| ([0-9]+) \| (.*) \|$", (ROOT / page).read_text(encoding="utf-8"), re.MULTILINE)
    assert {int(code): text.replace("\\|", "|") for code, text in rows} == EXIT_CODES
