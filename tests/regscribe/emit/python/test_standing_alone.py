"""A driver module stands alone: of other modules it imports the named values of libraries, and nothing else."""

import ast
import importlib
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import regscribe_devices
from regscribe.emit import python
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map

ROOT = Path(__file__).parents[4]
PACKAGE = "regscribe_devices/alone"
SHIPPED = sorted((ROOT / "generated/regscribe_devices").glob("*/*.py"))
LIBRARY = """\
format: 1
library: {id: alone/common, title: Common}
protocol: {functions: [3, 6, 16], limits: {read_words: 20, write_words: 20}}
enums:
  mode: {0: "off", 1: {label: run, description: until it is stopped}}
  speed: {0: slow, 1: fast, 2: {label: faster, models: [Large]}}
sets:
  limits:
    - {at: 10, name: Low limit, access: rw, type: int16, unit: °C, range: 0..400, danger: the oven may cool down fast}
    - {at: 11, name: High limit, access: rw, type: int16, unit: °C, special: {999: {label: none, id: NO_LIMIT}}}
  state:
    - {at: 20, name: State, access: r, type: uint16, flags: {0: hot, 1: cold}}
    - {at: 21, name: Mode, access: rw, enum: mode}
  bounded:
    - {at: 40, name: Bounded, access: rw, type: int16, range: {from: 0, to: most}}
commands:
  clear: {name: Clear, steps: [{at: 90, words: [1]}]}
"""
BASE = """\
format: 1
map: {id: alone/base, title: Base, maker: Acme, class_prefix: Acme}
manual: {title: Base manual}
uses: [alone/common]
models: {Small: {}, Large: {}}
enums:
  kind: {0: J, 1: K}
  action: {0: "off", 1: low}
groups:
  - id: control
    name: Control
    source: 4.1
    each: {access: rw, type: int16}
    registers:
      - {at: 1, name: Kind, enum: kind, default: 0}
      - {at: 2, name: Action, enum: action}
      - {at: 3, name: Setpoint, decimals: 1, unit: °C, range: 0..400, default: 77}
      - {set: limits, set_each: {persistence: eeprom, endurance: 10000}}
      - {at: 6, name: Fan, models: [Large]}
      - {at: 7, name: Pump, models: [Large]}
      - {at: 8, name: Most}
      - {set: state}
      - {at: 22, name: Speed, enum: speed, type: uint16}
      - {set: bounded}
      - id: steps
        name: Step
        repeat: 1..3
        stride: 2
        source: 4.2
        registers: [{at: 50, name: Level}, {at: 51, name: Action, id: step_action, enum: action}]
"""
EXTENSION = """\
format: 1
map: {id: alone/extension, title: Extension, maker: Zenith, class_prefix: Zenith}
manual: {title: Extension manual}
extends: alone/base
models: {S: {from: Small}, L: {from: Large}}
renumber: {"4": "6"}
drop: {registers: [{id: pump, reason: it has none}]}
override:
  - {register: setpoint, reason: another default, set: {default: 25}}
  - {register: action, reason: other words, set: {enum: {0: none, 1: high}}}
"""
OTHER = """\
format: 1
map: {id: alone/other, title: Other, maker: Other, class_prefix: Other}
manual: {title: Other manual}
uses: [alone/common]
models: {B: {}, Large: {}}
groups: [{id: page, name: Page, source: "8.3", registers: [{set: state}, {set: limits}]}]
"""
FILES = {"common.library": LIBRARY, "base": BASE, "extension": EXTENSION, "other": OTHER}
MAPS = {"base": "Acme", "extension": "Zenith", "other": "Other"}


@pytest.fixture(scope="module")
def maps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all files above."""
    folder = tmp_path_factory.mktemp("alone") / "maps" / "alone"
    folder.mkdir(parents=True)
    for name, text in FILES.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    return folder


def compiled(maps: Path, name: str) -> RegisterMap:
    """One of the maps."""
    found = compile_map(maps / f"{name}.yaml")
    assert found.map is not None, found.diagnostics
    return found.map


@pytest.fixture(scope="module")
def out(maps: Path) -> Path:
    """The drivers of all maps, written as one package below `regscribe_devices`."""
    folder = maps.parents[1] / "out"
    for name in MAPS:
        for path, text in python.render(compiled(maps, name)).items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text, encoding="utf-8")
    for package in (folder / "regscribe_devices", folder / PACKAGE):
        (package / "__init__.py").write_text("")
    return folder


@pytest.fixture(scope="module")
def module(out: Path) -> Iterator[Callable[[str], Any]]:
    """Import one of the drivers."""
    before = regscribe_devices.__path__
    regscribe_devices.__path__ = [*before, str(out / "regscribe_devices")]

    def load(name: str) -> ModuleType:
        return importlib.import_module(f"regscribe_devices.alone.{name}")

    yield load
    regscribe_devices.__path__ = before
    for name in [name for name in sys.modules if name.startswith("regscribe_devices.alone")]:
        del sys.modules[name]


def private_or_foreign(path: Path) -> list[str]:
    """The names that a module imports and may not."""
    found = []
    for one in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(one, ast.ImportFrom):
            base = str(one.module).partition(".")[0]
            classes = [alias.name for alias in one.names if base == "regscribe_devices"]
            wrong = [name for name in classes if name.startswith("_") or not _names_values(str(one.module), name)]
            allowed = base in {*sys.stdlib_module_names, "regscribe_runtime", "regscribe_devices"}
            found += wrong if allowed else [base]
    return found


def _names_values(module: str, name: str) -> bool:
    kind = getattr(importlib.import_module(module), name)
    return {"Choice", "Flags", "Word", "SpecialNumber"} & {base.__name__ for base in kind.__mro__} != set()


def test_modules_import_the_runtime_and_named_values_of_libraries_alone(
    out: Path, module: Callable[[str], Any]
) -> None:
    module("base")
    for path in (*SHIPPED, *(out / PACKAGE).glob("*.py")):
        assert private_or_foreign(path) == [], path.name


def test_the_module_of_a_library_has_named_values_and_no_registers(out: Path) -> None:
    code = (out / PACKAGE / "common.py").read_text()
    assert re.findall(r"^class (\w+)\(", code, re.MULTILINE) == ["Mode", "Speed", "HighLimitSpecial", "State"]
    assert not re.search(r"^\w+ = |Read(Only|Write)\(|Command\(|Protocol\(", code.partition("]\n")[2], re.MULTILINE)


def test_an_enum_of_a_library_is_one_type_in_all_drivers(module: Callable[[str], Any]) -> None:
    for name in ("Mode", "State", "HighLimitSpecial"):
        assert {getattr(module(one), name) for one in MAPS} == {getattr(module("common"), name)}
        assert all(name in module(one).__all__ for one in MAPS)
    assert module("base").AcmeSmall.mode.decode((1,)) is module("other").OtherB.mode.decode((1,))
    assert module("other").Mode.RUN.description == "until it is stopped"


def test_an_enum_that_a_model_has_differently_stays_its_own(module: Callable[[str], Any]) -> None:
    base, common = module("base"), module("common")
    assert base.AcmeSmall.speed.decode((1,)) is common.Speed.FAST
    assert base.AcmeLarge.speed.decode((2,)) is base.SpeedLarge.FASTER


def test_registers_stand_in_the_order_of_the_own_manual_and_cite_its_sections(
    module: Callable[[str], Any], maps: Path
) -> None:
    for name, prefix in MAPS.items():
        for model in compiled(maps, name).models:
            for driver in (f"{prefix}{model.name}", f"Async{prefix}{model.name}"):
                found = getattr(module(name), driver).registers
                assert [(one.path, one.section, one.persistence) for one in found.values()] == [
                    (one.path, one.section, one.persistence) for one in model.registers
                ]
    sections = {one.section for one in module("extension").ZenithS.registers.values()}
    assert sections == {"6.1", "6.2"}
    assert module("extension").ZenithS.low_limit.persistence == "eeprom"


def test_no_docstring_cites_another_manual(out: Path) -> None:
    code = {name: (out / PACKAGE / f"{name}.py").read_text() for name in MAPS}
    assert "4.1" not in code["extension"]
    assert "6.1" in code["extension"]
    assert "8.3" not in code["base"]


def test_a_dropped_register_cannot_be_reached(module: Callable[[str], Any]) -> None:
    large = module("extension").ZenithL
    assert hasattr(module("base").AcmeLarge, "pump")
    assert not hasattr(large, "pump")
    assert hasattr(large, "fan")


def test_overrides_win_and_leave_the_base_alone(module: Callable[[str], Any]) -> None:
    base, extension = module("base"), module("extension")
    assert (base.AcmeSmall.setpoint.default, extension.ZenithS.setpoint.default) == (77, 25)
    assert extension.ZenithS.action.decode((1,)).name == "HIGH"
    assert extension.ZenithS.registers["steps[2].step_action"].decode((1,)).name == "LOW"
    assert base.AcmeSmall.action.decode((1,)) is base.Action.LOW


def test_a_group_has_the_registers_of_its_model(module: Callable[[str], Any]) -> None:
    small, large = module("base").AcmeSmall, module("base").AcmeLarge
    read = [register.path for register in large.groups.control.registers(large)]
    assert read == list(large.registers)
    assert [register.path for register in small.groups.control.registers(small)] == list(small.registers)
    own = {register.path: register for register in large.groups.control.registers(large)}
    assert own["speed"].decode((2,)) is module("base").SpeedLarge.FASTER


def test_a_driver_is_rendered_without_that_of_its_base(maps: Path) -> None:
    assert sorted(python.render(compiled(maps, "extension"))) == [f"{PACKAGE}/common.py", f"{PACKAGE}/extension.py"]


def test_a_library_is_rendered_the_same_whichever_map_uses_it(maps: Path) -> None:
    path = f"{PACKAGE}/common.py"
    assert len({python.render(compiled(maps, name))[path] for name in MAPS}) == 1


def test_no_hash_seed_shows_in_a_module(maps: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from regscribe.emit import python\n"
        "from regscribe.pipeline import compile_map\n"
        "for name in sys.argv[1:]: print(python.render(compile_map(Path(name)).map))"
    )
    command = [sys.executable, "-c", code, str(maps / "extension.yaml"), str(maps / "other.yaml")]
    texts = {
        subprocess.run(  # noqa: S603 (our own code)
            command, env=os.environ | {"PYTHONHASHSEED": seed}, capture_output=True, text=True, check=True
        ).stdout
        for seed in ("1", "2", "3")
    }
    assert len(texts) == 1


USE = """\
from regscribe_devices.alone.base import AcmeLarge, AcmeSmall, AsyncAcmeSmall, Mode
from regscribe_devices.alone.extension import Action, AsyncZenithS, Kind, ZenithL, ZenithS
from regscribe_devices.alone.other import OtherB
from regscribe_runtime import Group


async def use(first: AcmeSmall, other: OtherB, later: AsyncZenithS, small: ZenithS, large: ZenithL) -> None:
    mode: Mode = other.mode.read()
    first.mode.write(mode)
    await later.mode.write(mode)
    kind: Kind = small.kind.read()
    level: float = (await later.steps[1].level.read()) + large.fan.read() + first.low_limit.read()
    group: Group = large.groups.control
    first.state.write(0)  # refused
    first.fan.read()  # refused
    large.pump.read()  # refused
    small.action.write(kind)  # refused
    first.mode.write(other.state.read())  # refused
    print(level, group, Action, AcmeLarge, AsyncAcmeSmall)
"""


@pytest.mark.parametrize("checker", ["mypy", "pyright"])
def test_type_checkers_see_the_registers_that_a_model_has_and_no_others(out: Path, checker: str) -> None:
    (out / "use.py").write_text(USE, encoding="utf-8")
    options = {
        "mypy": ["--strict", f"--cache-dir={out / 'cache'}", "--config-file=", "--explicit-package-bases"],
        "pyright": ["--pythonpath", sys.executable],
    }[checker]
    (out / "pyrightconfig.json").write_text('{"extraPaths": ["."], "typeCheckingMode": "standard"}')
    done = subprocess.run(  # noqa: S603 (our own command)
        [sys.executable, "-m", checker, *options, "regscribe_devices", "use.py"],
        cwd=out,
        env=os.environ
        | {"MYPYPATH": os.pathsep.join(map(str, (out, ROOT / "generator", ROOT / "generator" / "runtime")))},
        capture_output=True,
        text=True,
        check=False,
    )
    refused = [number for number, line in enumerate(USE.splitlines(), 1) if "# refused" in line]
    found = re.findall(r"use\.py:(\d+):(?:\d+ -)? error", done.stdout)
    assert {int(line) for line in found} == set(refused), done.stdout + done.stderr
    assert not re.findall(r"alone/\w+\.py:\d+.*error", done.stdout), done.stdout


def test_modules_are_formatted_and_pass_the_linter(out: Path) -> None:
    ruff = [sys.executable, "-m", "ruff"]
    for command in (["format", "--check"], ["check", "--ignore=INP001,D104,E501"]):
        done = subprocess.run(  # noqa: S603 (our own command)
            [*ruff, *command, "--config", str(ROOT / "pyproject.toml"), str(out / PACKAGE)],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr
