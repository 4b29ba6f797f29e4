"""Imports run one way, as the table says; those for type checkers alone and those inside functions count as well."""

import ast
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from importlib.util import resolve_name
from pathlib import Path

import pytest

import regscribe
import regscribe_runtime

PACKAGES = {package.__name__: Path(str(package.__file__)).parent for package in (regscribe, regscribe_runtime)}

RUNTIME = "regscribe_runtime"


def _inside(names: str) -> set[str]:
    return {f"{RUNTIME}.{name}" for name in names.split()}


VALUES, WIRE = f"{RUNTIME}.values", f"{RUNTIME}.wire"
WHOLE = {RUNTIME, *_inside("errors report wire link registers planning operations driver")}
ROOMS = {
    VALUES: set[str](),
    f"{RUNTIME}.report": set[str](),
    f"{RUNTIME}.errors": _inside("report"),
    WIRE: _inside("errors"),
    f"{RUNTIME}.link": _inside("errors wire"),
    f"{RUNTIME}.registers": _inside("errors"),
    f"{RUNTIME}.planning": set[str](),
    f"{RUNTIME}.operations": _inside("errors report wire link registers planning"),
    f"{RUNTIME}.driver": _inside("errors report wire link registers planning operations"),
    f"{RUNTIME}.public": WHOLE,
    RUNTIME: _inside("public"),
    "model": set[str](),
    "visible": set[str](),
    "map_files": set[str](),
    "reference": {"model"},
    "source": {"model"},
    "map_format": {"source", "visible"},
    "schema": {"model", "source", "map_files"},
    "compose": {"model", "source", "schema", "map_files"},
    "lower": {"model", "reference", "source", "schema"},
    "breaking": {"model", "emit"},
    "checks": {"model", "reference", "source", "schema", "compose", "lower", "breaking", WIRE},
    "emit": {"model", "reference", "schema", "visible", RUNTIME},
    "pictures": {"model", "emit", "visible"},
    "losses": set[str](),
    "dialects": {"model"},
    "draft": {"model", "source", "checks", "files", "visible"},
    "planned_model": {"model", "reference", "checks", f"{RUNTIME}.planning"},
    "plugins": {"model", "visible", "draft", "losses"},
    "export": {"model", "dialects", "reference", "checks", "emit", "plugins", "visible", "losses", "files"}
    | {"planned_model", f"{RUNTIME}.planning"},
    "register_browser": {"model", "emit", "export", "visible"},
    "evidence": {"model", "emit", "export"},
    "importers": {"model", "dialects", "source", "emit", "evidence", "files", "draft", "plugins", "visible"},
    "site": {"model", "emit", "evidence", "register_browser"},
    "files": {"model", "source", "schema", "visible"},
    "pipeline": {"model", "source", "schema", "compose", "lower", "checks"},
    "simulate": {"model", "reference", "source", "files", "map_files", "pipeline", WIRE},
    "language_server": {"model", "reference", "source", "schema", "compose", "checks", "emit", "pipeline", "map_files"}
    | {"map_format"}
    | {"visible"},
    "pytest_plugin": {"model", "simulate"},
    "testing": WHOLE,
    "tools": {"model", "source", "schema", "files", "visible", "emit", "pictures", "map_files", "pipeline"} | WHOLE,
    "cli": {"model", "reference", "source", "schema", "compose", "lower", "checks", "emit", "pictures", "evidence"}
    | {"plugins", "simulate", "pipeline", "files", "tools", "map_files", "visible", "draft", "losses"}
    | {"planned_model", "breaking", "map_format", "register_browser", "language_server", "site"}
    | WHOLE,
}
"""Which other rooms a room may import, besides the vocabulary in `regscribe_runtime.values`."""

LINK = f"{RUNTIME}.link"
LINK_OF_OPERATIONS = {f"{RUNTIME}.link.{name}" for name in ("links", "timing")}
"""What operations may know of links: what they are like, not how they work."""

LIBRARIES = {
    "yaml": {"source", "files", "regscribe.map_format.tokens", "regscribe.importers.shared.read_yaml"},
    "jsonschema": {"schema"},
    "jinja2": {"emit"},
    "click": {"cli"},
    "rich": {"cli"},
    "plotille": {"cli"},
    "platformdirs": {"tools"},
    "pymodbus": {f"{WIRE}.framing", f"{RUNTIME}.link.clients"},
    "openpyxl": {"importers", "export"},
    "pdfplumber": {"importers"},
    "defusedxml": {"importers"},
    "serial": {f"{RUNTIME}.link.streams", "regscribe.simulate.line.serial_ports"},
    "hypothesis": {"testing"},
    "pygls": {"language_server"},
    "lsprotocol": {"language_server"},
    "markdown_it": {"register_browser"},
}
"""Which rooms, or modules, may import a library."""

REMOVABLE = {
    "regscribe.pictures": {"regscribe.tools.programs.picture"},  # the table of emitters names it as well
    "regscribe.tools.programs": {"regscribe.cli.commands.program", "regscribe.cli.shared.program_text"},
    "regscribe.export.collectd": set[str](),  # an entry point
}
"""Parts that could be removed without a change to the core, and which modules outside them import them."""


def _statements(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    for statement in body:
        yield statement
        for field in ("body", "orelse", "finalbody"):
            yield from _statements(getattr(statement, field, []))
        for handler in getattr(statement, "handlers", []) + getattr(statement, "cases", []):
            yield from _statements(handler.body)


def _targets(statement: ast.stmt, package: str) -> Iterator[str]:
    if isinstance(statement, ast.Import):
        yield from (alias.name for alias in statement.names)
    elif isinstance(statement, ast.ImportFrom):
        origin = resolve_name("." * statement.level + (statement.module or ""), package)
        yield from (f"{origin}.{alias.name}" for alias in statement.names)


@cache
def imports() -> Mapping[str, frozenset[str]]:
    """What each module of the packages imports, anywhere in it; `from a import b` as a.b."""
    found = {}
    for top, folder in PACKAGES.items():
        for path in sorted(folder.rglob("*.py")):
            parts = (top, *path.relative_to(folder).with_suffix("").parts)
            module = ".".join(parts).removesuffix(".__init__")
            package = module if path.name == "__init__.py" else module.rpartition(".")[0]
            statements = _statements(ast.parse(path.read_bytes()).body)
            found[module] = frozenset(target for one in statements for target in _targets(one, package))
    return found


def room_of(module: str) -> str:
    """`regscribe.emit.write` is in the room emit; the package itself, with its version, is in none."""
    top, *inner = module.split(".")
    if top == RUNTIME:
        room = ".".join((top, *inner[:1]))
        return room if room in ROOMS else RUNTIME
    return inner[0] if top == "regscribe" and inner and inner[0] in ROOMS else ""


def test_every_module_is_in_a_room() -> None:
    assert {module for module in imports() if not room_of(module)} <= {"regscribe", "regscribe.__main__"}


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_imports_only_what_it_may(room: str) -> None:
    wrong = {
        f"{module} imports {name}"
        for module, names in imports().items()
        if room_of(module) == room
        for name in names
        if room_of(name) not in ROOMS[room] | {room, VALUES, ""}
    }
    assert wrong == set()


def test_operations_know_of_links_what_they_are_like_and_not_how_they_work() -> None:
    operations = {module: names for module, names in imports().items() if room_of(module) == f"{RUNTIME}.operations"}
    known = {name.rpartition(".")[0] for names in operations.values() for name in names if room_of(name) == LINK}
    assert known <= LINK_OF_OPERATIONS


def test_the_runtime_imports_nothing_for_type_checkers_alone() -> None:
    # but for its front, which loads its names as they are asked for
    users = {module for module, names in imports().items() if "typing.TYPE_CHECKING" in names}
    assert {module for module in users if module.startswith(f"{RUNTIME}.")} == set()


@pytest.mark.parametrize("part", REMOVABLE)
def test_only_named_modules_import_what_could_be_removed(part: str) -> None:
    outside = {module: names for module, names in imports().items() if not f"{module}.".startswith(f"{part}.")}
    users = {module for module, names in outside.items() if any(f"{name}.".startswith(f"{part}.") for name in names)}
    assert users == REMOVABLE[part]


@pytest.mark.parametrize("library", LIBRARIES)
def test_a_library_is_used_in_its_rooms_alone(library: str) -> None:
    users = {module for module, names in imports().items() if any(name.split(".")[0] == library for name in names)}
    assert {module for module in users if not {module, room_of(module)} & LIBRARIES[library]} == set()


def test_no_modules_import_each_other_in_a_circle() -> None:
    graph: dict[str, set[str]] = defaultdict(set)
    for module, names in imports().items():
        if module != RUNTIME:  # loads its names as they are asked for
            graph[module] = {one for name in names for one in _loaded(name) if not f"{module}.".startswith(f"{one}.")}
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as circle:
        pytest.fail(" -> ".join(circle.args[1]))


def _loaded(name: str) -> Iterator[str]:
    """The modules that an import loads: the packages around a module run before it."""
    parts = name.split(".")
    for end in range(2, len(parts) + 1):
        module = ".".join(parts[:end])
        if module in imports():
            yield module


@pytest.mark.parametrize("module", ["regscribe_devices.fdc.series_100", "regscribe_devices.athena.series_c"])
def test_a_generated_driver_loads_nothing_of_the_compiler(module: str) -> None:
    script = f"import sys, {module}\nprint(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)  # noqa: S603 - our own
    loaded = set(done.stdout.split())
    unwanted = {
        name for name in loaded if name.split(".")[0] in {"regscribe", "yaml", "jinja2", "jsonschema", "click", "rich"}
    }
    assert (module in loaded, unwanted) == (True, set())
