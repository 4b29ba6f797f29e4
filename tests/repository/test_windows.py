"""What Windows lacks is not needed: each is hidden here, and what was built on it works or says why it cannot."""

import asyncio
import io
import os
import signal
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path

import pytest
import serial

from regscribe import files
from regscribe.cli.app import run
from regscribe.emit.write import WriteError, write
from regscribe.simulate import SimulatorError, simulate
from regscribe.simulate.line.serial_ports import open_serial
from regscribe.tools.live import config
from regscribe.tools.live.log import open_log
from regscribe.tools.live.watch import Round
from regscribe_devices.athena.series_c import AsyncAthena16C
from regscribe_runtime import NoAnswer
from regscribe_runtime.values.serial_line import SerialLine

ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def _hidden(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("fchmod", "pread", "openpty", "set_blocking", "ttyname", "getuid"):
        monkeypatch.delattr(os, name)


def test_a_file_is_saved_with_the_mode_that_it_had(tmp_path: Path) -> None:
    path = tmp_path / "kept.yaml"
    files.save(path, "a\n")
    path.chmod(0o640)
    files.save(path, "b\nc\n")
    assert (path.read_bytes(), path.stat().st_mode & 0o777) == (b"b\nc\n", 0o640)


def test_a_file_that_is_open_elsewhere_is_said_and_stays_as_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "kept.yaml"
    files.save(path, "a\n")

    def refused(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(os, "replace", refused)
    monkeypatch.setattr(Path, "replace", refused)
    with pytest.raises(files.FileError, match=r"Permission denied.*nothing of it was changed"):
        files.save(path, "b\n")
    assert [one.name for one in tmp_path.iterdir()] == ["kept.yaml"]
    assert path.read_text(encoding="utf-8") == "a\n"


@pytest.mark.parametrize("name", ["log.csv", "log.jsonl"])
def test_a_log_that_was_cut_off_is_continued_after_its_last_whole_line(tmp_path: Path, name: str) -> None:
    one = Round(
        1,
        datetime(2026, 11, 30, tzinfo=UTC),
        0.1,
        (),
        frozenset(),
        NoAnswer(unit=1, function=3, address=0, seconds=1),
        late=False,
    )
    for _ in range(2):
        log = open_log(tmp_path / name, "oven")
        log.write(one)
        log.close()
        whole = (tmp_path / name).read_bytes()
        (tmp_path / name).write_bytes(whole + b"2026-11-30T0")
    open_log(tmp_path / name, "oven").close()
    assert (tmp_path / name).read_bytes() == whole
    assert whole.count(b"\n") == (3 if name == "log.csv" else 2)


def test_an_asynchronous_driver_reads_where_the_loop_watches_no_descriptors(monkeypatch: pytest.MonkeyPatch) -> None:
    def lacking(*_: object) -> None:
        raise NotImplementedError

    monkeypatch.setattr(asyncio.SelectorEventLoop, "add_reader", lacking)

    async def read(port: int) -> object:
        async with AsyncAthena16C.tcp("127.0.0.1", port=port, unit=1) as controller:
            return await controller.input_filter.read()

    with simulate("athena/series-c", "16C") as running:
        running.poke("input_filter", 7)
        assert asyncio.run(read(running.port)) == 7


def _started(script: str, *arguments: str) -> "subprocess.Popen[str]":
    code = f"{script}\nfrom regscribe.cli import main\nmain()"
    return subprocess.Popen(  # noqa: S603 - our own program
        [sys.executable, "-c", code, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=ROOT
    )


def test_the_simulator_serves_where_the_loop_takes_no_signal_handlers() -> None:
    script = (
        "import asyncio\ndef lacking(*_):\n    raise NotImplementedError\n"
        "asyncio.SelectorEventLoop.add_signal_handler = lacking"
    )
    with _started(script, "simulate", "athena/series-c", "--model", "16C", "--tcp", "127.0.0.1:0") as process:
        assert process.stdout is not None
        assert "answers as unit" in process.stdout.readline()
        process.send_signal(signal.SIGINT)
        assert process.communicate(timeout=30)[1].strip() == ""
        assert process.returncode == 130


WITHOUT_TERMINALS = """
import asyncio, ctypes, multiprocessing, serial, shutil, subprocess, sys, tempfile, tty, uuid, click, jsonschema, jinja2
for name in ("termios", "tty", "pty", "fcntl"):
    sys.modules[name] = None
sys.platform = "win32"
"""


def test_the_simulator_says_that_there_is_no_terminal_and_what_to_do() -> None:
    with _started(WITHOUT_TERMINALS, "simulate", "athena/series-c", "--model", "16C", "--rtu", "pty") as process:
        out, err = process.communicate(timeout=60)
    assert (process.returncode, out) == (1, "")
    assert err.startswith("Error: Windows has no pseudo terminals; serve TCP"), err


def test_the_simulator_says_that_a_port_has_no_descriptor_to_wait_for(monkeypatch: pytest.MonkeyPatch) -> None:
    class Port(io.RawIOBase):
        """As pyserial's is on Windows."""

    port = Port()
    monkeypatch.setattr(serial, "Serial", lambda *_, **__: port)
    with pytest.raises(SimulatorError, match="COM10: on Windows no serial device can be served; serve TCP"):
        open_serial("COM10", SerialLine())
    assert port.closed


@pytest.mark.parametrize("name", ["con.py", "docs/NUL.md", "aux/x.md", "a/com1.tar.gz", "LPT9"])
def test_no_file_gets_the_name_of_a_device(name: str, tmp_path: Path) -> None:
    with pytest.raises(WriteError, match="is a device on Windows"):
        write({name: "text"}, tmp_path)


@pytest.mark.parametrize("name", ["console.py", "com10.py", "auxiliary/x.md", "nul_.md"])
def test_other_names_are_free(name: str, tmp_path: Path) -> None:
    assert write({name: "text"}, tmp_path).written


def test_what_commands_write_ends_lines_alike_everywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(os, "linesep", "\r\n")
    assert run(["new", "acme/oven"]) == 0
    assert run(["generate", "--out", "out"]) == 0
    written = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert [path for path in written if b"\r" in path.read_bytes()] == []
    assert len(written) > 5


def test_the_configuration_of_the_user_lies_where_the_system_has_such_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import platformdirs  # noqa: PLC0415 - for this test alone

    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_, **__: tmp_path / "AppData")
    monkeypatch.delenv("REGSCRIBE_CONFIG", raising=False)
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    (tmp_path / "AppData").mkdir()
    (tmp_path / "AppData" / "devices.yaml").write_text("format: 1\ndevices: {far: 'tcp:h'}", encoding="utf-8")
    assert list(config.load().devices) == ["far"]
