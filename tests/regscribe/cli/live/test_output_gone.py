"""Commands that write to a device or draw, with nobody who takes their output: the code says so, nothing else does."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TextIO

import pytest

from regscribe.cli.app import run

pytestmark = pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that is always full")

COMMANDS = {
    "write": ["write", "OVEN", "setpoint_ram", "99"],
    "command": ["command", "OVEN"],
    "command sent": ["command", "OVEN", "clear_latched_alarms", "--json"],
    "restore": ["restore", "OVEN", "oven.yaml", "--json"],
    "clone": ["clone", "oven.yaml", "OVEN", "--json"],
    "watch": ["watch", "OVEN", "setpoint_ram", "--count", "3", "--every", "0"],
    "watch for programs": ["watch", "OVEN", "setpoint_ram", "--count", "3", "--every", "0", "--json"],
    "scan": ["scan", "LINK", "--units", "1", "--no-names"],
    "program show": ["program", "show", "X5000", "--program", "1"],
    "program read": ["program", "read", "X5000", "--program", "1"],
    "program status": ["program", "status", "X5000", "--program", "1"],
    "program draw": ["program", "draw", "program.yaml"],
    "simulate": ["simulate", "athena/series-c", "--model", "16C", "--tcp", "127.0.0.1:0"],
}


@pytest.fixture
def called(cli: Callable[..., Any], serve: Callable[..., Any]) -> Iterator[Callable[[str], list[str]]]:
    """The arguments of a command, with devices that answer."""
    with serve() as oven, serve("athena/platinum-x5000", "X5000") as other:
        link = f"tcp:{oven.host}:{oven.port}"
        places = {"LINK": link, "OVEN": f"{link}?model=16C", "X5000": f"tcp:{other.host}:{other.port}?model=X5000"}
        assert cli("backup", places["OVEN"], "oven.yaml").code == 0
        assert cli("program", "read", places["X5000"], "--program", "1", "--out", "program.yaml").code == 0
        yield lambda name: [places.get(one, one) for one in COMMANDS[name]]


@contextmanager
def full() -> Iterator[TextIO]:
    """A disk without room."""
    with Path("/dev/full").open("w", encoding="utf-8") as stream:
        yield stream


@contextmanager
def unread() -> Iterator[TextIO]:
    """A pipe whose reader went away."""
    reading, writing = os.pipe()
    os.close(reading)
    with os.fdopen(writing, "w", encoding="utf-8") as stream:
        yield stream


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_on_a_device_ends_with_the_code_of_its_output(
    name: str,
    called: Callable[[str], list[str]],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    for stream, code, said in ((full, 74, "standard output: No space left on device\n"), (unread, 141, "")):
        capsys.readouterr()
        with stream() as out, monkeypatch.context() as patched:
            patched.setattr(sys, "stdout", out)
            assert run([*called(name), "-q"] if name == "scan" else called(name)) == code
        assert capsys.readouterr().err == (f"Error: {said}" if said else "")
