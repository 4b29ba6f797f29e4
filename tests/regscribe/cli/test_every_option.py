"""Every command with every option: strange values, full disks and readers that go away are no internal errors."""

import ast
import os
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import click
import pytest

import regscribe.cli
from regscribe.cli.app import COMMANDS, run
from regscribe.simulate import simulate as simulated
from regscribe.visible import INVISIBLE

from .labelled import put_map

NOBODY = "tcp:127.0.0.1:1?model=O1&unit=1"
USUAL: dict[str, list[str]] = {
    "check": [],
    "fmt": [],
    "generate": ["--out", "out"],
    "explain": ["RS0401"],
    "new": ["acme/new"],
    "export": ["acme/oven", "--format", "csv"],
    "import": ["table.csv"],
    "browse": ["acme/oven"],
    "site": ["acme/oven"],
    "compare": ["acme/oven", "acme/oven"],
    "breaking": ["acme/oven", "--against", "maps"],
    "coverage": [],
    "simulate": ["acme/oven"],
    "plan": ["acme/oven", "--model", "O1", "--all"],
    "devices": [],
    "scan": ["LINK", "--units", "1"],
    "identify": ["TARGET", "--json"],
    "read": ["TARGET", "label"],
    "write": ["TARGET", "level", "1"],
    "dump": ["TARGET"],
    "watch": ["TARGET", "label", "--count", "1"],
    "command": ["TARGET"],
    "backup": ["TARGET"],
    "restore": ["TARGET", "none.yaml"],
    "diff": ["TARGET", "TARGET", "--json"],
    "clone": ["TARGET", "TARGET"],
    "program": ["TARGET", "1"],
    "decode": ["O1", "010300000001840a"],
    "man": ["-o", "pages"],
    "completion": ["bash"],
}
"""Arguments with which each command does its work."""
STRANGE = {
    "empty": "",
    "here": ".",
    "above": "..",
    "long": "x" * 300,
    "folder": "maps",
    "closed": "closed",
    "bytes": "bytes",
    "NUL": "a\0b",
    "escape": "\x1b[31m",
    "huge": "9" * 30,
}
PRINTING = sorted(USUAL.keys() - {"simulate", "restore", "clone", "program", "write", "command"})
"""Commands that end, and print to standard output when nothing is wrong."""


@pytest.fixture
def bench(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder with a map, its driver and some strange files, alone in the folder above."""
    folder = tmp_path / "bench"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.setenv("XDG_CACHE_HOME", str(folder / "cache"))
    put_map(folder)
    (folder / "table.csv").write_text("Address,Name,Type,Access\n1,Level,uint16,r\n")
    (folder / "bytes").write_bytes(bytes(range(256)))
    (folder / "closed").mkdir(mode=0)
    assert run(["generate", "--out", "mine"]) == 0
    text = "format: 1\npackages: [./mine/regscribe_devices/acme]\n"
    (folder / "regscribe.yaml").write_text(text, encoding="utf-8")


@pytest.fixture
def link(bench: None) -> Iterator[str]:  # noqa: ARG001 (the map of the device stands there)
    """Where a device answers."""
    with simulated("acme/oven", "O1") as device:
        yield f"tcp:{device.host}:{device.port}"


def called(name: str, link: str) -> list[str]:
    places = {"LINK": link, "TARGET": f"{link}?model=O1&unit=1"}
    return [name, *(places.get(one, one) for one in USUAL[name])]


def variants(name: str, value: str) -> Iterator[list[str]]:
    """Every option and argument of a command, and of those below it, with a strange value."""
    command: click.Command = import_module(f"regscribe.cli.commands.{name}").command
    below = command.commands if isinstance(command, click.Group) else {"": command}
    for sub, one in below.items():
        usual = [NOBODY if each == "TARGET" else "tcp:127.0.0.1:1" if each == "LINK" else each for each in USUAL[name]]
        arguments = [each for each in one.params if isinstance(each, click.Argument)]
        for place in range(len(arguments)):
            yield [name, *filter(None, [sub]), *usual[:place], value, *usual[place + 1 :]]
        for option in one.get_params(click.Context(one)):
            if isinstance(option, click.Option) and not option.is_flag:
                yield [name, *filter(None, [sub]), *usual, max(option.opts, key=len), value]


@pytest.mark.usefixtures("bench")
@pytest.mark.parametrize("strange", STRANGE)
@pytest.mark.parametrize("name", sorted(COMMANDS.keys() - {"simulate", "lsp"}))  # the latter takes no values
def test_no_option_with_a_strange_value_is_an_internal_error(
    name: str, strange: str, capsys: pytest.CaptureFixture[str]
) -> None:
    tried = 0
    for arguments in variants(name, STRANGE[strange]):
        tried += 1
        code = run(arguments)
        found = capsys.readouterr()
        said = found.out + found.err
        assert code in {0, 1, 2, 3, 74}, arguments
        assert "internal error" not in said, (arguments, said)
        assert "Traceback" not in said, (arguments, said)
        assert code == 0 or said.strip(), arguments
        assert set(INVISIBLE.findall(said)) <= {"\n", "\t"}, (arguments, said)
    assert tried


def test_a_package_that_is_none_is_told_before_a_line_is_asked(link: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([*called("scan", link), "--package", "."]) == 2
    said = capsys.readouterr().err
    assert "cannot be imported" in said
    assert "asking" not in said


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")
@pytest.mark.parametrize("name", PRINTING)
def test_a_full_disk_behind_the_output_of_any_command_is_said(
    name: str, link: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    capsys.readouterr()
    with Path("/dev/full").open("w", encoding="utf-8") as full, monkeypatch.context() as patched:
        patched.setattr(sys, "stdout", full)

        assert run(called(name, link)) == 74

    said = capsys.readouterr().err
    assert "standard output: No space left on device" in said
    assert "internal error" not in said


@pytest.mark.parametrize("name", PRINTING)
def test_a_reader_that_went_away_ends_any_command_without_a_word(
    name: str, link: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    capsys.readouterr()
    with os.fdopen(writing, "w", encoding="utf-8") as closed, monkeypatch.context() as patched:
        patched.setattr(sys, "stdout", closed)

        assert run(called(name, link)) == 141

    assert "rror" not in capsys.readouterr().err


def _writes(tree: ast.AST) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            yield ast.unparse(node.func)


def test_all_that_commands_print_goes_through_one_door() -> None:
    raw = {f"sys.std{end}.{how}" for end in ("out", "err") for how in ("write", "writelines", "buffer.write")}
    raw |= {"print", "click.echo", "click.secho", "os.write"}
    found: dict[str, Any] = {}
    for path in Path(regscribe.cli.__file__).parent.rglob("*.py"):
        if used := raw & set(_writes(ast.parse(path.read_text(encoding="utf-8")))):
            found[path.name] = used
    door = {"sys.stdout.write", "sys.stderr.write", "sys.stdout.buffer.write"}
    assert found == {"output.py": door, "app.py": {"click.echo"}}
