"""Small maps, and what all phases say of them; shipped maps, compiled once, and their devices on loopback."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import pytest

from regscribe import checks, lower, schema, source
from regscribe.checks.catalogue import Example
from regscribe.map_files import shipped
from regscribe.model import Diagnostic, RegisterMap, Severity
from regscribe.pipeline import compile_map
from regscribe.simulate import Running, simulate
from regscribe.simulate.map_cache import find_map

HEAD = """\
format: 1
map: {{id: example/controller, title: Controller, maker: Example, class_prefix: Example}}
manual: {{title: Controller Manual, number: EC-1}}
models: {{{models}}}
{top}
groups:
  - id: control
    name: Control
    source: "3.1"
    each: {{access: rw, type: int16}}
    registers:
"""


def _errors(found: list[Diagnostic]) -> bool:
    return any(one.severity is Severity.ERROR for one in found)


def compile_text(text: str) -> tuple[RegisterMap | None, list[Diagnostic]]:
    """The phases in their order, each only if the one before found no error."""
    document, found = source.parse(text.encode(), name="map.yaml")
    if document is None or _errors(found):
        return None, found
    found = [*found, *schema.validate(document)]
    if _errors(found):
        return None, found
    register_map, lowered = lower.lower(document)
    found = [*found, *lowered]
    if register_map is None or _errors(found):
        return None, found
    return register_map, [*found, *checks.check(register_map)]


@pytest.fixture
def diagnose() -> Callable[[str], list[Diagnostic]]:
    """All diagnostics of a map given as text."""
    return lambda text: compile_text(text)[1]


@pytest.fixture
def diagnose_files(tmp_path: Path) -> Callable[[Example], list[Diagnostic]]:
    """All diagnostics of an example: its files lie in one maps folder, the first of them is compiled."""

    def diagnose(files: Example) -> list[Diagnostic]:
        for name, text in files:
            path = tmp_path / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text.encode())
        return list(compile_map(tmp_path / files[0][0]).diagnostics)

    return diagnose


@pytest.fixture
def model_of() -> Callable[[str], RegisterMap]:
    """The model of a map given as text, which must have no errors before the checks."""

    def lowered(text: str) -> RegisterMap:
        register_map, found = compile_text(text)
        assert register_map is not None, found
        return register_map

    return lowered


@pytest.fixture
def small() -> Callable[..., str]:
    """The text of a small map: lines of registers, and what stands before `groups` and after them."""

    def text(*registers: str, top: str = "", tail: str = "", models: str = "A1: {}") -> str:
        lines = "".join(f"      - {{{register}}}\n" for register in registers)
        return HEAD.format(models=models, top=top or "description: Small") + lines + tail

    return text


def shipped_map(name: str) -> RegisterMap:
    return find_map(shipped() / f"{name}.yaml")


@pytest.fixture(scope="session", name="compiled")
def compiled_fixture() -> Callable[[str], RegisterMap]:
    """Compiles a shipped map, once."""
    return shipped_map


Serve = Callable[..., AbstractContextManager[Running]]


@pytest.fixture(scope="session")
def serve() -> Serve:
    """Serves a model of a shipped map while a `with` block runs."""

    @contextmanager
    def served(name: str = "athena/series-c", model: str = "16C", **more: object) -> Iterator[Running]:
        with simulate(shipped_map(name), model, **more) as running:  # type: ignore[arg-type]  # keywords of `simulate`
            yield running

    return served


@pytest.fixture(scope="module")
def running(serve: Serve) -> Iterator[Running]:
    """A 16C over TCP, shared by the tests of a module."""
    with serve() as found:
        yield found
