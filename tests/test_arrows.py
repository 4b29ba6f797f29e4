"""Imports run one way: cli -> emit, simulate, checks -> lower -> schema -> source, all -> model; runtime is apart."""

import ast
import subprocess
import sys
from collections.abc import Iterator
from importlib.util import resolve_name
from pathlib import Path

import pytest

import regscribe

PACKAGE = Path(regscribe.__file__).parent
ROOMS = {
    "model": set[str](),
    "visible": set[str](),
    "source": {"model"},
    "schema": {"model", "source"},
    "shipped": set[str](),
    "compose": {"model", "source", "schema", "shipped"},
    "lower": {"model", "source", "schema"},
    "checks": {"model", "source", "schema", "compose", "lower"},
    "emit": {"model", "schema", "visible"},
    "evidence": {"model", "emit"},
    "simulate": {"model", "source", "files", "shipped", "pipeline"},
    "runtime": set[str](),
    "files": {"model", "source", "schema", "visible"},
    "live": {"model", "source", "schema", "runtime", "files", "visible"},
    "programs": {"model", "source", "schema", "runtime", "live", "files", "emit"},
    "settings": {"runtime", "live", "files"},
    "testing": {"runtime"},
    "pytest_plugin": {"model", "simulate"},
    "pipeline": {"model", "source", "schema", "compose", "lower", "checks"},
    "cli": {"model", "source", "schema", "compose", "lower", "checks", "emit", "evidence", "simulate", "pipeline"}
    | {"runtime", "files", "live", "settings", "programs", "shipped", "visible"},
}
"""Which other rooms a room may import."""

OWNERS = {
    "yaml": {"source", "files"},
    "jsonschema": {"schema"},
    "jinja2": {"emit"},
    "click": {"cli"},
    "rich": {"cli"},
    "plotille": {"cli"},
    "pymodbus": {"runtime", "simulate"},
    "serial": {"runtime", "simulate"},
    "hypothesis": {"testing"},
}
"""Which rooms may import a library."""


def modules() -> list[str]:
    paths = (path.relative_to(PACKAGE.parent).with_suffix("") for path in sorted(PACKAGE.rglob("*.py")))
    return [".".join(path.parts).removesuffix(".__init__") for path in paths]


def source_of(module: str) -> Path:
    path = PACKAGE.parent.joinpath(*module.split("."))
    file = path.with_suffix(".py")
    return file if file.is_file() else path / "__init__.py"


def imports(module: str) -> Iterator[str]:
    """Every module that `module` imports, also inside functions and for type checkers; `from a import b` as a.b."""
    package = module if source_of(module).name == "__init__.py" else module.rpartition(".")[0]
    for node in ast.walk(ast.parse(source_of(module).read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            origin = resolve_name("." * node.level + (node.module or ""), package)
            yield from (f"{origin}.{alias.name}" for alias in node.names)


def room_of(module: str) -> str:
    """`regscribe.emit.write` is in the room emit; the package itself, with its version, is in none."""
    parts = module.split(".")
    return parts[1] if parts[0] == "regscribe" and len(parts) > 1 and parts[1] in ROOMS else ""


def users_of(library: str) -> set[str]:
    return {module for module in modules() if any(name.split(".")[0] == library for name in imports(module))}


def test_every_module_is_in_a_room() -> None:
    assert {module for module in modules() if not room_of(module)} <= {"regscribe", "regscribe.__main__"}


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_only_what_it_may(room: str) -> None:
    wrong = {
        f"{module} imports {name}"
        for module in modules()
        if room_of(module) == room
        for name in imports(module)
        if room_of(name) not in ROOMS[room] | {room, ""}
    }
    assert wrong == set()


@pytest.mark.parametrize("library", OWNERS)
def test_a_library_is_used_in_its_room_alone(library: str) -> None:
    assert {room_of(module) for module in users_of(library)} <= OWNERS[library]


def test_one_module_of_the_runtime_and_one_of_the_simulator_import_pymodbus() -> None:
    assert sorted(room_of(module) for module in users_of("pymodbus")) == ["runtime", "simulate"]


@pytest.mark.parametrize("module", ["regscribe_devices.fdc.series_100", "regscribe_devices.athena.series_c"])
def test_a_generated_driver_loads_nothing_of_the_compiler(module: str) -> None:
    script = f"import sys, {module}\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)  # noqa: S603 - our own
    loaded = set(done.stdout.split())
    compiler = {name for name in loaded if room_of(name) not in {"", "runtime"}}
    assert (loaded & {"yaml", "jinja2", "jsonschema", "click", "rich"}, compiler) == (set(), set())
    assert module in loaded
