"""The command that an editor starts."""

import importlib.util
import subprocess
import sys

import pytest

from regscribe.cli.app import run


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
