"""Real maps, compiled once, and their devices served on loopback."""

import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

import regscribe
from regscribe.cli.app import run
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.simulate import Running, simulate

ROOT = Path(regscribe.__file__).parents[2]


@cache
def compiled(name: str) -> RegisterMap:
    found = compile_map(ROOT / "maps" / f"{name}.yaml").map
    assert found is not None
    return found


@dataclass(frozen=True)
class Result:
    code: int
    out: str
    err: str


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty working directory without any configuration."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    for name in ("NO_COLOR", "FORCE_COLOR", "REGSCRIBE_DEBUG", "REGSCRIBE_CONFIG"):
        monkeypatch.delenv(name, raising=False)
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    return here


@pytest.fixture
def cli(folder: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., Result]:
    """Run `regscribe` in this process, in the empty working directory."""

    def call(*arguments: object) -> Result:
        assert Path.cwd() == folder
        capsys.readouterr()
        try:
            code = run([str(argument) for argument in arguments])
        except SystemExit as end:
            code = int(end.code or 0)
        captured = capsys.readouterr()
        assert "Traceback" not in captured.out + captured.err
        assert "internal error" not in captured.err, captured.err
        return Result(code, captured.out, captured.err)

    return call


@pytest.fixture(scope="session", name="compiled")
def compiled_fixture() -> Callable[[str], RegisterMap]:
    """Compiles a shipped map, once."""
    return compiled


Serve = Callable[..., AbstractContextManager[Running]]


@pytest.fixture(scope="session")
def serve() -> Serve:
    """Serves a model of a shipped map while a `with` block runs."""

    @contextmanager
    def served(name: str = "athena/series-c", model: str = "16C", **more: object) -> Iterator[Running]:
        with simulate(compiled(name), model, **more) as running:  # type: ignore[arg-type]  # keywords of `simulate`
            yield running

    return served


@pytest.fixture(scope="module")
def running(serve: Serve) -> Iterator[Running]:
    """A 16C over TCP, shared by the tests of a module."""
    with serve() as found:
        yield found


@pytest.fixture
def oven(running: Running) -> str:
    """The name of that 16C."""
    return f"tcp:{running.host}:{running.port}?unit=1&model=16C"


Start = Callable[..., subprocess.Popen[str]]


@pytest.fixture
def start(folder: Path) -> Iterator[Start]:
    """Start `regscribe` in a process of its own; ended with the test."""
    started: list[subprocess.Popen[str]] = []

    def begin(*arguments: object, env: dict[str, str] | None = None) -> subprocess.Popen[str]:
        process = subprocess.Popen(  # noqa: S603 - our own command
            [sys.executable, "-c", "from regscribe.cli import main; main()", *map(str, arguments)],
            cwd=folder,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=env,
        )
        started.append(process)
        return process

    yield begin
    for process in started:
        process.kill()
        process.communicate()
