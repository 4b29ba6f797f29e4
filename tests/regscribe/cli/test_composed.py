"""Maps of several files on the command line: found, checked, built again when any of the files changes."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

LIBRARY = "format: 1\nlibrary: {id: acme/common, title: Common}\nenums: {mode: {0: one, 1: two}}\n"
EXTENSION = """\
format: 1
map: {id: other/oven, title: Other, maker: Other, class_prefix: Other}
extends: acme/oven
uses: [acme/common]
models: {M2: {from: M1}}
groups: [{id: extra, name: Extra, source: "9", registers: [{at: 900, name: Own Mode, access: r, enum: mode}]}]
"""


@pytest.fixture
def extension(oven: Path) -> Path:
    """A map that extends the oven and uses a library."""
    (oven.parent / "common.library.yaml").write_text(LIBRARY)
    path = oven.parents[1] / "other" / "oven.yaml"
    path.parent.mkdir()
    path.write_text(EXTENSION)
    return path


def changed(path: Path) -> None:
    path.write_text(path.read_text() + "# a remark\n")


@pytest.mark.usefixtures("extension")
def test_check_counts_libraries_among_the_files(cli: Callable[..., Any]) -> None:
    assert cli("check").out == "3 maps checked: no findings\n"


def test_a_library_can_be_checked_by_file_and_by_id(cli: Callable[..., Any], extension: Path) -> None:
    path = extension.parents[1] / "acme" / "common.library.yaml"
    path.write_text(path.read_text().replace("enums:", "enmus:"))
    by_file, by_id = cli("check", path.relative_to(Path.cwd())), cli("check", "acme/common")
    assert (by_file.code, by_file.out) == (1, by_id.out)
    assert "did you mean `enums`?" in by_id.out


def test_a_mistake_in_a_library_is_shown_once(cli: Callable[..., Any], extension: Path) -> None:
    path = extension.parents[1] / "acme" / "common.library.yaml"
    path.write_text(path.read_text().replace("0: one", "0: {label: one, id: 9}"))
    assert cli("check").out.count("error[") == 1


@pytest.mark.parametrize("command", [("generate",), ("export", "--format", "csv")])
def test_nothing_is_made_of_a_library_alone(cli: Callable[..., Any], extension: Path, command: tuple[str, ...]) -> None:
    path = extension.parents[1] / "acme" / "common.library.yaml"
    result = cli(*command, path)
    assert result.code == 2
    assert "is a library: nothing is made of it alone" in result.err


@pytest.mark.usefixtures("extension")
def test_a_folder_is_exported_without_its_libraries(cli: Callable[..., Any]) -> None:
    rows = cli("export", "--format", "csv").out.splitlines()
    assert {row.partition(",")[0] for row in rows[1:]} == {"acme/oven", "other/oven"}


@pytest.mark.parametrize("name", ["acme/oven.yaml", "acme/common.library.yaml", "other/oven.yaml"])
def test_a_map_is_built_again_when_a_file_of_it_changes(cli: Callable[..., Any], extension: Path, name: str) -> None:
    header = Path("generated/regscribe_devices/other/oven.py")
    cli("generate")
    before = header.read_text()
    assert " 0 written" in cli("generate").out
    changed(extension.parents[1] / name)
    assert " 0 written" not in cli("generate").out
    assert header.read_text() != before


def test_an_unchanged_map_of_several_files_is_not_compiled_again(
    cli: Callable[..., Any], extension: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cli("generate")
    monkeypatch.setattr("regscribe.pipeline.compile_map", None)
    assert " 0 written" in cli("generate").out
    changed(extension)
    assert cli("generate").code == 70


def test_a_map_without_its_base_is_a_finding(cli: Callable[..., Any], extension: Path) -> None:
    (extension.parents[1] / "acme" / "oven.yaml").unlink()
    result = cli("generate")
    assert result.code == 1
    assert "RS0501" in result.err
    assert not Path("generated").exists()


def test_an_explanation_shows_every_file_of_an_example(cli: Callable[..., Any]) -> None:
    out = cli("explain", "RS0505").out
    for kind in ("Bad", "Good"):
        assert f"\n{kind}, maps/example/controller.yaml:\n" in out
        assert f"\n{kind}, maps/example/base.yaml:\n" in out
    marked = [line for line in out.splitlines() if line.startswith(("- ", "+ "))]
    assert [line for line in marked if "expect" not in line] == [
        "- models: {X1: {from: C7}, X2: {from: C2}}",
        "+ models: {X1: {from: C1}, X2: {from: C2}}",
    ]
