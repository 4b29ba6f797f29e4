"""Small maps, and the command line run in this process or in one of its own."""

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from regscribe.cli.app import run

PLAIN = """\
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
manual: {title: Oven manual, number: X1}
models:
  M1: {}
protocol: {functions: [3, 6, 16], limits: {read_words: 20, write_words: 20}}
groups:
  - id: control
    name: Control
    source: "1"
    each: {access: rw}
    registers:
      - {at: 1, name: Setpoint, type: int16, decimals: 1, unit: °C, range: 0..400, default: 20}
      - {at: 2, name: Mode, enum: {0: stop, 1: run}, default: 0}
"""


@dataclass(frozen=True)
class Result:
    code: int
    out: str
    err: str


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory with a cache of its own."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    for name in ("NO_COLOR", "FORCE_COLOR", "REGSCRIBE_DEBUG"):
        monkeypatch.delenv(name, raising=False)
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    return here


@pytest.fixture
def oven(folder: Path) -> Path:
    """A good map at maps/acme/oven.yaml below the working directory."""
    path = folder / "maps" / "acme" / "oven.yaml"
    path.parent.mkdir(parents=True)
    path.write_text(PLAIN, encoding="utf-8")
    return path


@pytest.fixture
def cli(folder: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., Result]:
    """Run `regscribe` in this process, in the empty working directory."""

    def call(*arguments: str | Path) -> Result:
        assert Path.cwd() == folder
        capsys.readouterr()
        try:
            code = run([str(argument) for argument in arguments])
        except SystemExit as end:
            code = int(end.code or 0)
        captured = capsys.readouterr()
        assert "Traceback" not in captured.out + captured.err
        return Result(code, captured.out, captured.err)

    return call


@pytest.fixture
def process(folder: Path) -> Callable[..., Result]:
    """Run `regscribe` (or with `python=True` Python) in a process of its own."""

    def call(*arguments: str | Path, python: bool = False, env: dict[str, str] | None = None) -> Result:
        head: Sequence[str] = ["-c"] if python else ["-c", "from regscribe.cli import main; main()"]
        done = subprocess.run(  # noqa: S603 - our own command
            [sys.executable, *head, *map(str, arguments)],
            cwd=folder,
            env={**os.environ, **(env or {})},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        assert "Traceback" not in done.stdout + done.stderr
        return Result(done.returncode, done.stdout, done.stderr)

    return call
