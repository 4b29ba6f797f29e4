"""The command that an editor starts."""

import importlib.util
import logging
import subprocess
import sys

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from regscribe.cli.app import run
from regscribe.cli.commands.lsp import TameFormatter
from regscribe.language_server.server import guarded, is_worth_telling


def test_without_its_libraries_the_command_names_the_extra(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: None)
    assert run(["lsp"]) == 1
    assert capsys.readouterr().err == "Error: the language server needs pygls: pip install 'regscribe[lsp]'\n"


def test_the_libraries_of_the_server_are_loaded_by_it_alone() -> None:
    script = "import sys; from regscribe.cli.app import run; run(['lsp', '--help']); print('pygls' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)  # noqa: S603 - our own
    assert done.stdout.splitlines()[-1] == "False"


def test_a_request_that_fails_is_told_in_the_log_and_ends_nothing(caplog: pytest.LogCaptureFixture) -> None:
    def fails() -> None:
        message = "no such thing"
        raise LookupError(message)

    assert guarded(fails)() is None
    assert "no such thing" in caplog.text


def test_what_a_map_hides_does_not_reach_the_log() -> None:
    record = logging.LogRecord("x", logging.ERROR, "x", 1, "a\x1b[2J\u202eb", (), None)
    assert TameFormatter().format(record) == r"a\x1b[2J\u202eb"


def test_a_refusal_is_no_fault(caplog: pytest.LogCaptureFixture) -> None:
    def refuses() -> None:
        message = "not so"
        raise JsonRpcException(message, 1)

    with pytest.raises(JsonRpcException):
        guarded(refuses)()
    assert caplog.text == ""


@pytest.mark.parametrize(
    ("fault", "told"),
    [
        (JsonRpcException("not so", lsp.LSPErrorCodes.RequestFailed), False),
        (JsonRpcException("broken", lsp.ErrorCodes.InternalError), True),
        (LookupError("no such thing"), True),
        (None, True),
    ],
)
def test_a_refusal_that_the_editor_shows_is_not_in_the_log(fault: Exception | None, *, told: bool) -> None:
    information = (type(fault), fault, None) if fault else None
    record = logging.LogRecord("x", logging.ERROR, "x", 1, "an exception occurred", (), information)
    assert is_worth_telling(record) is told
