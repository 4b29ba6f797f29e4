"""`regscribe breaking` as a user types it: against a file, a folder and commits of a repository."""

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from .conftest import PLAIN

Cli = Callable[..., Any]
LIBRARY = """\
format: 1
library: {id: acme/common, title: Common}
enums: {modes: {0: stop, 1: run}}
"""
USING = PLAIN.replace("manual:", "uses: [acme/common]\nmanual:").replace("{0: stop, 1: run}", "modes")


@pytest.fixture
def other(oven: Path) -> Callable[..., Path]:
    """Writes an earlier version of the oven to a file: its text with parts replaced."""

    def write(*texts: str) -> Path:
        text = PLAIN
        for old, new in zip(texts[::2], texts[1::2], strict=True):
            assert old in text
            text = text.replace(old, new)
        path = oven.parents[2] / "old.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def git(folder: Path, *arguments: str) -> None:
    who = ["-c", "user.name=A", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", "-C", str(folder), *who, *arguments], check=True, capture_output=True)  # noqa: S603, S607 (git on a folder of the test)


@pytest.fixture
def repository(oven: Path) -> Path:
    """The working directory as a repository with one commit."""
    top = oven.parents[2]
    git(top, "init", "-q", ".")
    git(top, "add", ".")
    git(top, "commit", "-q", "-m", "First")
    return top


def test_the_same_version_is_no_change(cli: Cli, oven: Path, other: Callable[..., Path]) -> None:
    result = cli("breaking", oven, "--against", other())
    assert (result.code, result.err) == (0, "")
    assert result.out == "verdict none: nothing that counts at this level differs\n"


def test_another_address_breaks_and_ends_with_1(cli: Cli, other: Callable[..., Path]) -> None:
    result = cli("breaking", "--against", other("at: 2, name: Mode", "at: 3, name: Mode"))
    assert result.code == 1
    assert result.out == (
        "breaking[RS0701]: `mode`: address holding 3 -> holding 2\n"
        "  --> maps/acme/oven.yaml:14:23\n"
        "   14 |       - {at: 2, name: Mode, enum: {0: stop, 1: run}, default: 0}\n"
        "      |                       ^^^^\n"
        "  before: old.yaml:14:23\n"
        "  breaking on the wire\n"
        "\n"
        "verdict major: 1 breaking change (RS0701); below 1.0.0 the minor number plays the part of the major one\n"
    )


def test_an_address_does_not_count_for_a_name(cli: Cli, other: Callable[..., Path]) -> None:
    result = cli("breaking", "--against", other("name: Mode", "name: State"), "--level", "wire")
    assert result.code == 0
    assert result.out == (
        "verdict none: nothing that counts at this level differs\n"
        "3 changes not shown, which do not count at level wire: see --level api or --level docs\n"
    )


@pytest.mark.parametrize(("fail_on", "code"), [("major", 0), ("minor", 1), ("patch", 1)])
def test_fail_on_sets_the_exit_code(cli: Cli, other: Callable[..., Path], fail_on: str, code: int) -> None:
    assert cli("breaking", "--against", other("default: 20", "default: 21"), "--fail-on", fail_on).code == code


def test_a_text_counts_at_level_docs_only(cli: Cli, other: Callable[..., Path]) -> None:
    path = other("number: X1", "number: X0")
    assert "not shown" in cli("breaking", "--against", path).out
    result = cli("breaking", "--against", path, "--level", "docs", "--fail-on", "patch")
    assert result.code == 1
    assert "text[RS0774]: `map`: manual number X0 -> number X1\n" in result.out
    assert result.out.endswith("verdict patch: 1 text change (RS0774)\n")


def test_json_has_each_change_with_both_effects(cli: Cli, other: Callable[..., Path]) -> None:
    result = cli("breaking", "--against", other("range: 0..400", "range: 0..500"), "--format", "json")
    found = json.loads(result.out)
    assert (result.code, found["verdict"], found["level"], found["hidden"]) == (1, "major", "api", 0)
    (change,) = found["changes"]
    assert (change["rule"], change["wire"], change["api"]) == ("RS0713", "none", "breaking")
    assert (change["before"], change["after"], change["registers"]) == ("0 to 500", "0 to 400", ["setpoint"])
    assert change["place"] == {"file": "maps/acme/oven.yaml", "line": 13, "column": 23}


def test_github_and_sarif_show_the_place_of_the_new_version(cli: Cli, other: Callable[..., Path]) -> None:
    path = other("unit: °C", "unit: °F")
    line = cli("breaking", "--against", path, "--format", "github").out
    assert line.startswith("::error file=maps/acme/oven.yaml,line=13,")
    assert "`setpoint`: unit °F -> °C" in line
    (run,) = json.loads(cli("breaking", "--against", path, "--format", "sarif").out)["runs"]
    assert [one["ruleId"] for one in run["results"]] == ["RS0712"]
    assert run["tool"]["driver"]["rules"][0]["shortDescription"] == {"text": "Unit changed"}


def test_markdown_is_a_section_of_a_changelog(cli: Cli, other: Callable[..., Path]) -> None:
    path = other("name: Mode", "name: State", "default: 20", "default: 210")
    result = cli("breaking", "--against", path, "--format", "markdown")
    assert result.out == (
        "## Major change of the maps\n"
        "\n"
        "### Breaking\n"
        "\n"
        "- acme/oven `map`: names of the driver module State is gone (RS0771)\n"
        "- acme/oven `mode`: path state \N{RIGHTWARDS ARROW} mode (RS0742)\n"
        "\n"
        "### Changed in behaviour\n"
        "\n"
        "- acme/oven `setpoint`: default 210 \N{RIGHTWARDS ARROW} 20 (RS0716)\n"
        "\n"
        "### Compatible\n"
        "\n"
        "- acme/oven `map`: names of the driver module Mode is new (RS0772)\n"
    )


def test_a_rename_says_what_follows_the_path(cli: Cli, other: Callable[..., Path]) -> None:
    out = cli("breaking", "--against", other("name: Mode", "name: State")).out
    assert "`state` is `mode` in drivers, on the command line and in backups; unique ids of Home Assistant" in out


def test_a_folder_is_compared_by_the_ids_of_maps(cli: Cli, oven: Path) -> None:
    old = oven.parents[2] / "before" / "any"
    old.mkdir(parents=True)
    (old / "name.yaml").write_text(PLAIN.replace("default: 20", "default: 30"), encoding="utf-8")
    (old / "kiln.yaml").write_text(PLAIN.replace("acme/oven", "acme/kiln").replace("M1", "M9"), encoding="utf-8")
    whole = cli("breaking", "--against", "before")
    assert (whole.code, "RS0716" in whole.out, "map acme/kiln is gone" in whole.out) == (1, True, True)
    one = cli("breaking", "acme/oven", "--against", "before")
    assert (one.code, "RS0716" in one.out, "kiln" in one.out) == (0, True, False)


def test_a_commit_is_compared_as_it_was(cli: Cli, repository: Path, oven: Path) -> None:
    oven.write_text(PLAIN.replace("at: 2, name: Mode", "at: 5, name: Mode"), encoding="utf-8")
    (oven.parent / "kiln.yaml").write_text(PLAIN.replace("acme/oven", "acme/kiln"), encoding="utf-8")
    result = cli("breaking", "--against", "git:HEAD")
    assert result.code == 1
    assert "`mode`: address holding 2 -> holding 5" in result.out
    assert "before: HEAD:maps/acme/oven.yaml:14:23" in result.out
    assert "map acme/kiln is new" in result.out
    git(repository, "add", ".")
    git(repository, "commit", "-q", "-m", "Second")
    assert cli("breaking", "maps", "--against", "git:HEAD").code == 0
    (oven.parent / "kiln.yaml").unlink()
    gone = cli("breaking", "--against", "git:HEAD")
    assert (gone.code, "map acme/kiln is gone" in gone.out) == (1, True)


def test_a_hook_of_git_may_run_it(cli: Cli, repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert repository.is_dir()
    monkeypatch.setenv("GIT_DIR", ".git")
    monkeypatch.setenv("GIT_INDEX_FILE", ".git/index")
    assert cli("breaking", "--against", "git:HEAD").code == 0


def test_a_library_of_a_commit_is_that_of_the_commit(cli: Cli, oven: Path) -> None:
    library = oven.parent / "common.library.yaml"
    oven.write_text(USING, encoding="utf-8")
    library.write_text(LIBRARY, encoding="utf-8")
    top = oven.parents[2]
    for command in (["init", "-q", "."], ["add", "."], ["commit", "-q", "-m", "First"]):
        git(top, *command)
    library.write_text(LIBRARY.replace("1: run", "1: run, 2: dry"), encoding="utf-8")
    result = cli("breaking", "acme/oven", "--against", "git:HEAD", "--fail-on", "minor")
    assert result.code == 1
    assert (
        'behavioural[RS0717]: `mode`: code 2 DRY "dry" is new\n  --> maps/acme/common.library.yaml:3:9\n' in result.out
    )


def test_a_map_split_into_a_library_is_no_change(cli: Cli, other: Callable[..., Path], oven: Path) -> None:
    path = other("enum: {0: stop, 1: run}", "enum: modes", "groups:", "enums: {modes: {0: stop, 1: run}}\ngroups:")
    oven.write_text(USING, encoding="utf-8")
    (oven.parent / "common.library.yaml").write_text(LIBRARY, encoding="utf-8")
    result = cli("breaking", "--against", path, "--level", "docs")
    assert result.out == "verdict none: nothing that counts at this level differs\n"


@pytest.mark.parametrize(
    ("against", "said"),
    [
        ("git:", "write a commit, for example git:HEAD~1"),
        ("git:--output=x", "write a commit, for example git:HEAD~1"),
        ("git:nowhere", "has no commit `nowhere`"),
        ("nowhere", "there is no such file or folder; a commit is written git:REF"),
        ("empty", "there is no map (*.yaml) in this folder"),
    ],
)
def test_an_earlier_version_that_is_none_is_refused(cli: Cli, repository: Path, against: str, said: str) -> None:
    (repository / "empty").mkdir()
    result = cli("breaking", "--against", against)
    assert (result.code, said in result.err) == (2, True), result.err


def test_without_a_repository_a_commit_is_refused(cli: Cli, oven: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(oven.parents[3]))
    result = cli("breaking", "--against", "git:HEAD")
    assert (result.code, "maps is in no git repository" in result.err) == (2, True)


def test_one_file_is_held_against_one_map_only(cli: Cli, oven: Path, other: Callable[..., Path]) -> None:
    path = other()
    (oven.parent / "kiln.yaml").write_text(PLAIN.replace("acme/oven", "acme/kiln"), encoding="utf-8")
    result = cli("breaking", "--against", path)
    assert (result.code, "name the one map to compare with it, not 2" in result.err) == (2, True)


def test_an_error_in_either_version_is_told_with_its_place(
    cli: Cli, repository: Path, oven: Path, other: Callable[..., Path]
) -> None:
    path = other("at: 2, name: Mode", "at: 1, name: Mode")
    result = cli("breaking", "--against", path)
    assert (result.code, result.out) == (2, "")
    assert "error[RS0401]" in result.err
    assert result.err.endswith("nothing was compared: old.yaml cannot be compiled\n")
    oven.write_text(PLAIN.replace("at: 2, name: Mode", "at: 1, name: Mode"), encoding="utf-8")
    git(repository, "add", ".")
    git(repository, "commit", "-q", "-m", "Broken")
    oven.write_text(PLAIN, encoding="utf-8")
    result = cli("breaking", "--against", "git:HEAD")
    assert (result.code, "--> HEAD:maps/acme/oven.yaml:14:23" in result.err) == (2, True), result.err


def test_a_waiver_of_the_map_excuses_a_change(cli: Cli, oven: Path, other: Callable[..., Path]) -> None:
    waivers = "waivers: [{rule: RS0701, at: mode, reason: the old address was never released}]\n"
    path = other("at: 2, name: Mode", "at: 3, name: Mode")
    oven.write_text(PLAIN + waivers, encoding="utf-8")
    result = cli("breaking", "--against", path)
    assert (result.code, result.err) == (0, "")
    assert cli("check").out == "1 map checked: no findings\n"


def test_a_waiver_that_excuses_nothing_is_told(cli: Cli, oven: Path, other: Callable[..., Path]) -> None:
    path = other()
    oven.write_text(PLAIN + "waivers: [{rule: RS0701, at: mode, reason: it was never released}]\n", encoding="utf-8")
    result = cli("breaking", "--against", path)
    assert (result.code, "warning[RS0467]: nothing at `mode` is a change by RS0701" in result.err) == (0, True)


def test_a_waiver_of_no_rule_is_an_error_of_the_map(cli: Cli, oven: Path) -> None:
    oven.write_text(PLAIN + "waivers: [{rule: RS0799, at: mode, reason: it was never released}]\n", encoding="utf-8")
    assert "error[RS0468]" in cli("check").out


def test_explain_shows_an_edit_that_makes_the_change(cli: Cli) -> None:
    out = cli("explain", "rs0713").out
    assert out.startswith("change[RS0713]: Limits narrowed\n")
    assert "\n-      - {at: 1, name: Setpoint, type: int16, decimals: 1, unit: °C, range: 0..400" in out
    assert "\n+      - {at: 1, name: Setpoint, type: int16, decimals: 1, unit: °C, range: 0..300" in out
    assert out.endswith("breaking for programs\n")


def test_what_a_map_says_does_not_reach_the_terminal_as_it_is(cli: Cli, oven: Path, other: Callable[..., Path]) -> None:
    path = other()
    text = PLAIN.replace("1: run}", '1: run, 2: "dry\\u001b[31m"}').replace("number: X1", 'number: "X\\u202e"')
    oven.write_text(text, encoding="utf-8")
    for form in ("text", "json", "github", "sarif", "markdown"):
        out = cli("breaking", "--against", path, "--level", "docs", "--format", form).out
        assert "\x1b" not in out
        assert "\u202e" not in out
