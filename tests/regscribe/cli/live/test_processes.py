import asyncio
import json
import os
import pty
import re
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import Exchange

Start = Callable[..., subprocess.Popen[str]]


def ended(process: subprocess.Popen[str], *, seconds: float = 30) -> tuple[int, str, str]:
    out, err = process.communicate(timeout=seconds)
    assert "Traceback" not in err, err
    return process.returncode, out, err


def first_lines(process: subprocess.Popen[str], count: int) -> list[str]:
    """What the process prints first; it goes on meanwhile."""
    assert process.stdout is not None
    return [process.stdout.readline() for _ in range(count)]


def test_ctrl_c_ends_watching_with_a_whole_log(start: Start, oven: str, folder: Path) -> None:
    process = start("watch", oven, "process_value", "--every", "0.01", "--json", "--log", "log.jsonl")
    first_lines(process, 3)
    process.send_signal(signal.SIGINT)
    code, _, _ = ended(process)
    lines = (folder / "log.jsonl").read_text(encoding="utf-8").splitlines()
    assert code == 130
    assert len([json.loads(line) for line in lines]) >= 3


def test_ctrl_c_ends_a_scan_with_what_was_found(start: Start, serve: Callable[..., Any]) -> None:
    with serve(transport="rtu-tcp", unit=1) as running:
        link = f"tcp:{running.host}:{running.port}?framing=rtu&timeout=0.5"
        process = start("scan", link, "--json", "--no-names")
        assert process.stderr is not None
        process.stderr.readline()  # it tells how long it takes, then begins
        wait = threading.Event()
        while not running.requests:
            wait.wait(0.01)
        wait.wait(0.3)  # the answer is there, the next unit is silent
        process.send_signal(signal.SIGINT)
        code, out, err = ended(process)
    found = json.loads(out)
    assert (code, found["complete"], [one["unit_id"] for one in found["found"]]) == (130, False, [1])
    assert "stopped before the end" in err


def test_ctrl_c_during_a_write_lets_it_come_to_its_end(start: Start, serve: Callable[..., Any]) -> None:
    asked, go = threading.Event(), threading.Event()

    async def held(exchange: Exchange) -> bytes:
        if exchange.request.pdu[0] in {6, 16}:
            asked.set()
            await asyncio.to_thread(go.wait, 20)
        return exchange.frame

    with serve(delivery=held) as running:
        process = start("write", f"tcp:{running.host}:{running.port}?model=16C&timeout=20", "setpoint_ram", "99")
        assert asked.wait(20)
        process.send_signal(signal.SIGINT)
        assert process.stderr is not None
        assert "finishing what is being written" in process.stderr.readline()
        go.set()
        code, out, _ = ended(process)
    assert (code, out) == (130, "setpoint_ram  99 °F\n")


@pytest.mark.parametrize("transport", ["tcp", "pty"])
def test_a_port_that_vanishes_ends_watching_after_patience(
    transport: str, start: Start, serve: Callable[..., Any], folder: Path
) -> None:
    with serve(transport=transport) as running:
        link = f"rtu:{running.path}?baud=9600&" if running.path else f"tcp:{running.host}:{running.port}?"
        target = f"{link}model=16C&timeout=0.2"
        process = start(
            "watch", target, "process_value", "--every", "0.01", "--give-up", "2", "--json", "--log", "log.csv"
        )
        first_lines(process, 2)
    code, out, err = ended(process)
    assert (code, "Error: " in err) == (3, True)
    assert json.loads(out.splitlines()[-1])["error"]["kind"] in {"link-lost", "no-answer"}
    assert (folder / "log.csv").read_text(encoding="utf-8").endswith("\n")


@pytest.mark.parametrize(
    ("transport", "settings"), [("tcp", ""), ("rtu-tcp", "&framing=rtu"), ("ascii-tcp", "&framing=ascii")]
)
def test_every_kind_of_frame_carries_and_tells_its_values(
    transport: str, settings: str, cli: Callable[..., Any], serve: Callable[..., Any]
) -> None:
    with serve(transport=transport, addressing="jbus") as running:
        target = f"tcp:{running.host}:{running.port}?model=16C&addressing=jbus{settings}"
        result = cli("read", target, "input_type", "--trace")
    assert result.out == "input_type  J_THERMOCOUPLE\n"
    assert "input_type = J_THERMOCOUPLE" in result.err


def test_a_serial_line_carries_every_command(cli: Callable[..., Any], serve: Callable[..., Any]) -> None:
    with serve(transport="pty", unit=5) as running:
        target = f"rtu:{running.path}?baud=9600&unit=5&model=16C"
        assert cli("write", target, "setpoint_ram", "42").code == 0
        assert cli("read", target, "setpoint_ram", "--value").out == "42\n"
        assert cli("command", target, "clear_latched_alarms").code == 0
        assert json.loads(cli("identify", target, "--json").out)["models"][0]["model"] == "16C"


def test_two_processes_on_one_port_get_in_no_ones_way(start: Start, serve: Callable[..., Any]) -> None:
    with serve(transport="pty", unit=1) as running:
        target = f"rtu:{running.path}?baud=9600&unit=1&model=16C"
        first = start("watch", target, "process_value", "--every", "0.05", "--json")
        first_lines(first, 1)
        code, _, err = ended(start("read", target, "process_value"))
        assert (code, "another program has it open" in err) == (3, True), err
        first.send_signal(signal.SIGINT)
        assert ended(first)[0] == 130


def test_a_log_on_a_full_disk_has_the_exit_code_of_output(start: Start, oven: str, folder: Path) -> None:
    (folder / "log.csv").symlink_to("/dev/full")
    code, _, err = ended(start("watch", oven, "process_value", "--log", "log.csv", "--every", "0.01"))
    assert (code, "no space left" in err) == (74, True), err


@pytest.fixture
def terminal() -> Iterator[tuple[int, int]]:
    """A pseudo terminal: our end and the one of the process."""
    ours, theirs = pty.openpty()
    yield ours, theirs
    os.close(ours)


def test_a_terminal_gets_a_table_in_colour(terminal: tuple[int, int], oven: str, folder: Path) -> None:
    ours, theirs = terminal
    arguments = ("watch", oven, "process_value", "--count", "2", "--every", "0.01", "--chart", "process_value")
    process = subprocess.Popen(  # noqa: S603 - our own command
        [sys.executable, "-c", "from regscribe.cli import main; main()", *arguments],
        cwd=folder,
        stdin=subprocess.DEVNULL,
        stdout=theirs,
        stderr=theirs,
        env=os.environ | {"TERM": "xterm", "COLUMNS": "80"},
    )
    os.close(theirs)
    shown = b""
    while True:
        try:
            part = os.read(ours, 4096)
        except OSError:  # the other end is closed: the process is done
            break
        shown += part
    assert process.wait(30) == 0
    text = shown.decode()
    plain = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", " ", text)
    assert {"REGISTER", "VALUE", "CHANGED", "process_value"} <= set(plain.split())
    assert plain != text


def test_the_shell_completes_commands_devices_registers_and_values(start: Start, folder: Path) -> None:
    (folder / "regscribe.yaml").write_text(
        "format: 1\ndevices: {oven: 'tcp:h?model=16C', kiln: 'tcp:i?model=M5000'}", encoding="utf-8"
    )

    def completed(*typed: str) -> list[str]:
        env = os.environ | {
            "_REGSCRIBE_COMPLETE": "bash_complete",
            "COMP_WORDS": " ".join(["regscribe", *typed]),
            "COMP_CWORD": str(len(typed)),
        }
        code, out, _ = ended(start(env=env))
        assert code == 0
        return [line.partition(",")[2] for line in out.split()]

    assert completed("wat") == ["watch"]
    assert completed("read", "ov") == ["oven"]
    assert "setpoint_ram" in completed("read", "oven", "setp")
    assert completed("command", "oven", "clear") == ["clear_latched_alarms"]
    assert completed("write", "oven", "autotune_damping", "L") == ["LOW"]
    assert completed("read", "nobody", "setp") == []


def test_the_version_imports_neither_a_driver_nor_a_library() -> None:
    script = (
        "import sys\nfrom regscribe.cli.app import run\nrun(['--version'])\nrun(['--help'])\n"
        "print(sorted({'pymodbus', 'rich', 'yaml', 'plotille', 'sqlite3', 'regscribe_runtime'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)  # noqa: S603 - our own
    assert done.stdout.splitlines()[-1] == "[]"
