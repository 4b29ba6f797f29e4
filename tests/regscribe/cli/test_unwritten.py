"""Files that cannot be written: every command ends with the exit code of output."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

FULL = "/dev/full"

needs_full = pytest.mark.skipif(not Path(FULL).exists(), reason="needs a device that is always full")

FILES = [
    ["browse", "acme/oven", "-o"],
    ["export", "acme/oven", "--format", "csv", "-o"],
    ["export", "acme/oven", "--format", "csv", "--report-to"],
    ["import", "list.csv", "--report-to"],
    ["program", "draw", "program.yaml", "--svg"],
]
FOLDERS = [["man", "-o"], ["generate", "--out"], ["new", "acme/kiln", "--dir"]]


@pytest.fixture
def given(oven: Path) -> None:
    """A map, and files for commands that take others."""
    assert oven.exists()
    Path("list.csv").write_text("Address,Name,Type,Access\n1,Level,uint16,r\n", encoding="utf-8")
    program = "format: 1\nprogram: {segments: [{to: 100, ramp: 30 min}]}\n"
    Path("program.yaml").write_text(program, encoding="utf-8")


@pytest.mark.usefixtures("given")
def test_a_file_that_is_written_is_told_with_what_is_in_it_and_nothing_with_quiet(cli: Callable[..., Any]) -> None:
    told = cli("browse", "acme/oven", "-o", "oven.html").err
    size = round(Path("oven.html").stat().st_size / 1000)
    assert (told, size > 10) == (f"wrote oven.html: 1 map, 2 registers, {size} kB\n", True)
    assert cli("export", "acme/oven", "--format", "csv", "-o", "a.csv").err.startswith("wrote a.csv: ")
    assert cli("program", "draw", "program.yaml", "--svg", "a.svg").err.startswith("wrote a.svg: ")
    assert cli("-q", "browse", "acme/oven", "-o", "oven.html").err == ""
    assert "wrote" not in cli("export", "acme/oven", "--format", "csv", "-o", "a.csv", "--report", "json").err


@needs_full
@pytest.mark.usefixtures("given")
@pytest.mark.parametrize("arguments", FILES, ids=" ".join)
def test_a_full_disk_behind_a_file_has_the_exit_code_of_output(cli: Callable[..., Any], arguments: list[str]) -> None:
    done = cli(*arguments, FULL)
    assert (done.code, "No space left on device" in done.err) == (74, True), done


@pytest.mark.usefixtures("given")
@pytest.mark.parametrize("arguments", [*FILES, ["import", "list.csv", "--save-mapping"]], ids=" ".join)
def test_a_folder_that_is_missing_has_the_exit_code_of_output(cli: Callable[..., Any], arguments: list[str]) -> None:
    done = cli(*arguments, "none/here")
    assert (done.code, "No such file or directory" in done.err) == (74, True), done


@pytest.mark.usefixtures("given")
@pytest.mark.parametrize("arguments", FOLDERS, ids=" ".join)
def test_a_folder_that_cannot_be_made_has_the_exit_code_of_output(
    cli: Callable[..., Any], arguments: list[str]
) -> None:
    Path("taken").write_text("", encoding="utf-8")
    done = cli(*arguments, "taken/here")
    assert (done.code, "Not a directory" in done.err) == (74, True), done
