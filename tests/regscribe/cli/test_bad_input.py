"""Whatever is wrong with what a user gives: one clear message, exit code 1 or 2, no traceback (`cli` asserts that)."""

import socket
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from regscribe.cli import app

pytestmark = pytest.mark.usefixtures("oven")

COMMANDS = ["check", "generate", "export --format csv", "simulate --model M1 --tcp :0"]


@pytest.mark.parametrize("command", COMMANDS)
def test_a_missing_map_is_usage_with_a_hint(cli: Callable[..., Any], command: str) -> None:
    result = cli(*command.split(), "acme/ovne")
    assert result.code == 2
    assert "there is no map `acme/ovne`: neither a file nor a map id; did you mean `acme/oven`?" in result.err


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", ["", "../../etc/passwd", "/no/such/file.yaml", "a\nb", "x" * 5000, "\udcff"])
def test_a_name_that_names_nothing_is_usage(cli: Callable[..., Any], command: str, name: str) -> None:
    assert cli(*command.split(), name).code == 2


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize(
    "content", [b"", b"\xff\xfe", b"a: [", b"\t- x", b"[]", b"null", b"a: *b", b"\0", b"a: 1\na: 1"]
)
def test_a_malformed_map_exits_1(cli: Callable[..., Any], oven: Path, command: str, content: bytes) -> None:
    oven.write_bytes(content)
    result = cli(*command.split(), oven)
    assert result.code == 1
    assert "maps/acme/oven.yaml:" in result.out + result.err
    assert not Path("generated").exists()


@pytest.mark.parametrize("command", COMMANDS)
def test_what_is_no_regular_file_exits_1(cli: Callable[..., Any], command: str) -> None:
    assert cli(*command.split(), "/dev/null").code == 1


@pytest.mark.parametrize(
    "arguments",
    [
        "chekc",
        "check --fromat json",
        "check --format xml",
        "generate --out",
        "explain RS9999",
        "explain --format yaml",
        "export",
        "export --format yaml",
        "simulate",
        "simulate acme/oven --model M1",
        "simulate athena/series-c --tcp :0",
        "plan athena/series-c --all",
        "simulate acme/oven --model M1 --tcp :0 --rtu pty",
        "simulate acme/oven --model M1 --tcp 5020",
        "simulate acme/oven --model M1 --tcp :65536",
        "simulate acme/oven --model M1 --tcp :-1",
        "simulate acme/oven --model M1 --tcp :0 --unit 256",
        "simulate acme/oven --model M1 --tcp :0 --unit 0",
        "simulate acme/oven --model M1 --tcp :0 --unit x",
        "simulate acme/oven --model M1 --tcp :0 --given x=1",
        "simulate maps --model M1 --tcp :0",
        "new",
        "new acme",
        "new acme/oven/3",
        "new Acme/Oven",
        "new acme/../oven",
        "new acme/class",
        "new acme/3-",
        "new acme/the_oven",
        "new /",
    ],
)
def test_a_wrong_argument_is_usage(cli: Callable[..., Any], arguments: str) -> None:
    result = cli(*arguments.split())
    assert (result.code, result.out) == (2, "")
    assert "Error: " in result.err


@pytest.mark.parametrize(
    ("arguments", "meant"),
    [
        ("chekc", "check"),
        ("explain RS109", "RS0109"),
        ("simulate acme/oven --model m --tcp :0", "M1"),
        ("check maps/acme/oven.yml", "maps/acme/oven.yaml"),
    ],
)
def test_a_slip_is_answered_with_what_was_probably_meant(cli: Callable[..., Any], arguments: str, meant: str) -> None:
    assert f"did you mean `{meant}`" in cli(*arguments.split()).err


def test_an_output_directory_that_is_a_file_exits_74(cli: Callable[..., Any]) -> None:
    Path("out").write_text("in the way")
    result = cli("generate", "--out", "out")
    assert result.code == 74
    assert "Error: cannot write out/" in result.err
    assert Path("out").read_text() == "in the way"


def test_an_output_directory_that_cannot_be_written_exits_74(cli: Callable[..., Any]) -> None:
    result = cli("generate", "--out", "/proc/nowhere")
    assert result.code == 74
    assert "choose another directory with --out" in result.err


def test_a_folder_for_a_new_map_that_cannot_be_written_exits_74(cli: Callable[..., Any]) -> None:
    result = cli("new", "acme/oven", "--dir", "/proc/nowhere")
    assert result.code == 74
    assert "choose another folder with --dir" in result.err


def test_a_port_in_use_exits_1(cli: Callable[..., Any], oven: Path) -> None:
    with socket.socket() as busy:
        busy.bind(("127.0.0.1", 0))
        busy.listen()
        port = busy.getsockname()[1]
        result = cli("simulate", oven, "--model", "M1", "--tcp", f"127.0.0.1:{port}")
    assert result.code == 1
    assert f"cannot listen on 127.0.0.1 port {port}" in result.err


def test_a_host_that_is_not_here_exits_1(cli: Callable[..., Any], oven: Path) -> None:
    assert cli("simulate", oven, "--model", "M1", "--tcp", "192.0.2.1:5020").code == 1


def test_an_absent_serial_device_exits_1(cli: Callable[..., Any], oven: Path) -> None:
    result = cli("simulate", oven, "--model", "M1", "--rtu", "/dev/no-such-tty")
    assert result.code == 1
    assert "/dev/no-such-tty" in result.err


def test_a_new_map_overwrites_nothing(cli: Callable[..., Any], oven: Path) -> None:
    before = oven.read_bytes()
    result = cli("new", "acme/oven")
    assert (result.code, oven.read_bytes()) == (2, before)
    assert "maps/acme/oven.yaml exists; nothing was changed" in result.err


def test_a_closed_pipe_is_quiet(folder: Path) -> None:
    command = [sys.executable, "-c", "from regscribe.cli import main; main()", "export", "--format", "csv"]
    with subprocess.Popen(  # noqa: S603 - our own command
        [*command, "fdc/series-100", "athena/series-c"], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as running:
        assert running.stdout is not None
        assert running.stderr is not None
        running.stdout.close()
        assert running.stderr.read() == b""
        assert running.wait(timeout=60) == 141


def test_an_internal_error_asks_for_a_report_without_a_traceback(
    cli: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(*_: object, **__: object) -> None:
        message = "boom"
        raise RuntimeError(message)

    monkeypatch.setattr("regscribe.cli.shared.compiled_maps.compile_map", broken)
    result = cli("check")
    assert result.code == 70
    assert "internal error: RuntimeError: boom (test_bad_input.py:" in result.err
    assert "report it" in result.err


@pytest.mark.parametrize("by", ["option", "environment"])
def test_an_internal_error_shows_its_traceback_on_request(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], by: str
) -> None:
    def broken(*_: object, **__: object) -> None:
        message = "boom"
        raise RuntimeError(message)

    monkeypatch.setattr("regscribe.cli.shared.compiled_maps.compile_map", broken)
    if by == "environment":
        monkeypatch.setenv("REGSCRIBE_DEBUG", "1")
    assert app.run(["check"] if by == "environment" else ["--debug", "check"]) == 70
    assert "Traceback (most recent call last)" in capsys.readouterr().err
