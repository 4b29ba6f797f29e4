"""`regscribe simulate`: several devices, requests by name, time, state; and what it refuses."""

import os
import pty
import re
import select
import signal
import socket
import struct
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

COMMAND = [sys.executable, "-u", "-c", "from regscribe.cli import main; main()", "simulate"]


Served = tuple[subprocess.Popen[str], int]
"""The process, and the port that it announced."""


@contextmanager
def running(folder: Path, *arguments: str | Path, ends: int = signal.SIGINT) -> Iterator[Served]:
    """The command, until its port is known; stopped by a signal at the end."""
    command = [*COMMAND, *map(str, arguments), "--tcp", "127.0.0.1:0"]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as started:  # noqa: S603 - our own
        assert started.stdout is not None
        line = started.stdout.readline()
        found = re.search(r":(\d+); Ctrl-C", line)
        try:
            assert found, line
            yield started, int(found[1])
        finally:
            started.send_signal(ends)
            started.communicate(timeout=20)


def ask(port: int, unit: int, *pdus: bytes) -> list[bytes]:
    """Send requests and return the answers, without their headers."""
    answers = []
    with socket.create_connection(("127.0.0.1", port), timeout=20) as link:
        for pdu in pdus:
            link.sendall(struct.pack(">HHHB", 1, 0, len(pdu) + 1, unit) + pdu)
            answers.append(link.recv(300)[7:])
    return answers


def read(address: int, count: int = 1) -> bytes:
    return struct.pack(">BHH", 3, address, count)


def write(address: int, word: int) -> bytes:
    return struct.pack(">BHH", 6, address, word)


def test_requests_are_shown_by_name_one_a_line(folder: Path, oven: Path) -> None:
    with running(folder, oven, "--model", "M1") as (started, port):
        ask(port, 1, read(1), write(1, 355), write(2, 9), read(7))
        ask(port, 5, read(1))
        assert started.stdout is not None
        shown = [started.stdout.readline().split(" ", 1)[1].rstrip() for _ in range(5)]
    assert shown == [
        "unit 1 read setpoint = 20 °C",
        "unit 1 write setpoint = 35.5 °C",
        "unit 1 write mode = 9: exception 3",
        "unit 1 read holding 7: exception 2",
        "unit 5 read a unit that is not here: exception 11",
    ]


def test_several_devices_answer_on_one_line(folder: Path, oven: Path) -> None:
    (folder / "line.yaml").write_text("devices:\n- {map: acme/oven, model: M1, unit: 4, seed: 1}\n", encoding="utf-8")
    more = ["--device", f"{oven}:M1:3", "--devices", "line.yaml", "--quiet"]
    with running(folder, oven, "--model", "M1", "--unit", "2", *more) as (started, port):
        for unit in (2, 3, 4):
            assert ask(port, unit, write(1, unit), read(1))[1] == struct.pack(">BBH", 3, 2, unit)
        assert ask(port, 5, read(1)) == [b"\x83\x0b"]
        assert started.stdout is not None
        assert [started.stdout.readline().split(" on ")[0] for _ in range(2)] == [
            "Oven M1 answers as unit 3",
            "Oven M1 answers as unit 4",
        ]


@pytest.mark.parametrize(("ends", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_state_is_loaded_and_saved_at_the_end(folder: Path, oven: Path, ends: int, code: int) -> None:
    state = folder / "state.yaml"
    head = "format: 1\nstate: {map: acme/oven, model: M1}\n"
    state.write_text(f"{head}values: {{setpoint: 35.5, mode: run}}\n", encoding="utf-8")
    files = ["--state", state, "--save", state, "--quiet"]
    with running(folder, oven, "--model", "M1", *files, ends=ends) as (started, port):
        assert ask(port, 1, read(1, 2), write(1, 200))[0] == struct.pack(">BBHH", 3, 4, 355, 1)
    assert started.returncode == code
    assert "setpoint: 20\n" in state.read_text(encoding="utf-8")


def test_a_process_moves_with_time(folder: Path) -> None:
    process = ["--process", "ambient=70,gain=600,time_constant=10,dead_time=0", "--speed", "500", "--quiet"]
    with running(folder, "athena/series-c", "--model", "16C", *process) as (_, port):
        ask(port, 1, write(4057, 50), write(4004, 3), write(2, 300))
        until = time.monotonic() + 30
        while ask(port, 1, read(0))[0] < struct.pack(">BBH", 3, 2, 200) and time.monotonic() < until:
            time.sleep(0.1)
        assert ask(port, 1, read(0))[0] >= struct.pack(">BBH", 3, 2, 200)


def test_on_a_terminal_the_last_requests_stand_in_a_table(folder: Path, oven: Path) -> None:
    ours, theirs = pty.openpty()
    environment = os.environ | {"TERM": "xterm", "COLUMNS": "110", "LINES": "30"}
    command = [*COMMAND, str(oven), "--model", "M1", "--tcp", "127.0.0.1:0"]
    with subprocess.Popen(command, cwd=folder, stdout=theirs, stderr=subprocess.PIPE, env=environment) as started:  # noqa: S603 - our own
        os.close(theirs)
        shown = _until(ours, rb":(\d+); Ctrl-C")
        found = re.search(rb":(\d+); Ctrl-C", shown)
        assert found
        ask(int(found[1]), 1, write(1, 355), write(2, 9))
        table = _until(ours, rb"exception 3").decode("utf-8", "replace")
        started.send_signal(signal.SIGINT)
        os.close(ours)
        assert started.wait(20) == 130
    for text in ("2 requests", "setpoint = 35.5", "mode = 9"):
        assert text in table


def _until(fd: int, pattern: bytes) -> bytes:
    data, until = b"", time.monotonic() + 30
    while not re.search(pattern, data) and time.monotonic() < until:
        if select.select([fd], [], [], 0.5)[0]:
            data += os.read(fd, 4096)
    return data


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ("--tcp :0", "name a MAP (and which --model of several), or devices"),
        ("athena/series-c --tcp :0", "--model is missing: athena/series-c has 1ZC, 16C"),
        ("acme/oven --model M1 --tcp :0 --latency fast", "neither off, real, nor a factor"),
        ("acme/oven --model M1 --tcp :0 --speed -1", "--speed"),
        ("acme/oven --model M1 --tcp :0 --paced", "--paced goes with --rtu pty only"),
        ("acme/oven --model M1 --tcp :0 --line-format 8X1", "such as 8N1"),
        ("acme/oven --model M1 --tcp :0 --process on", "does not say which registers control"),
        ("acme/oven --model M1 --tcp :0 --process time_constant=0", "time_constant 0 must be more than 0"),
        ("acme/oven --model M1 --tcp :0 --process time_konstant=5", "did you mean `time_constant`?"),
        ("acme/oven --model M1 --tcp :0 --process gain=much", "`much` is no number"),
        ("--device athena/series-c --tcp :0", "--model is missing"),
        ("--device acme/oven:M1:999 --tcp :0", "unit 999 is outside"),
        ("--device acme/oven:M1 --device acme/oven:M1:2 --save x.yaml --tcp :0", "are for one device, not for 2"),
        ("--devices none.yaml --tcp :0", "cannot be read as YAML"),
        ("--devices list.yaml --tcp :0", "has the key `unti`: known are"),
        ("--devices empty.yaml --tcp :0", "write `devices:` with a list"),
    ],
)
@pytest.mark.usefixtures("oven")
def test_what_cannot_be_served_is_one_clear_message(
    cli: Callable[..., Any], folder: Path, arguments: str, message: str
) -> None:
    (folder / "list.yaml").write_text("devices: [{map: acme/oven, model: M1, unti: 3}]\n", encoding="utf-8")
    (folder / "empty.yaml").write_text("devices: []\n", encoding="utf-8")
    result = cli("simulate", *arguments.split())
    assert result.code == 2
    assert message in " ".join(result.err.split())


@pytest.mark.usefixtures("oven")
def test_states_and_devices_that_do_not_fit_are_one_clear_message(cli: Callable[..., Any], folder: Path) -> None:
    (folder / "other.yaml").write_text("format: 1\nstate: {map: acme/kiln, model: K}\nvalues: {}\n", encoding="utf-8")
    result = cli("simulate", "acme/oven", "--model", "M1", "--tcp", ":0", "--state", "other.yaml")
    assert (result.code, "is of acme/kiln, model K, but this is acme/oven, model M1" in result.err) == (1, True)
    result = cli("simulate", "--device", "acme/oven:M1", "--device", "acme/oven:M1", "--tcp", ":0")
    assert (result.code, "two simulated devices have unit 1" in result.err) == (1, True)
