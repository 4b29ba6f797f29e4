"""Sets of a library are declared once; each map that uses them tells the section and the memory of its own devices."""

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

ROOT = Path(__file__).parents[3]
PACKAGE = "regscribe_devices/setting"
LIBRARY = """\
format: 1
library: {id: setting/common, title: Common}
protocol: {functions: [3, 6, 16], limits: {read_words: 20, write_words: 20}}
enums:
  speed: {0: slow, 1: fast}
sets:
  limits:
    - {at: 10, name: Low limit, access: rw, type: int16, unit: °C, range: 0..400, danger: the oven may cool down fast}
    - {at: 11, name: High limit, access: rw, type: int16, unit: °C, special: {999: {label: none, id: NO_LIMIT}}}
  state:
    - {at: 20, name: State, access: r, type: uint16, flags: {0: hot, 1: cold}}
    - {at: 21, name: Mode, access: rw, type: uint16, enum: {0: "off", 1: run}}
  fan:
    - {at: 30, name: Fan, access: rw, enum: speed}
    - {at: 31, name: Fan time, access: rw, type: int16}
  bounded:
    - {at: 40, name: Bounded, access: rw, type: int16, range: {from: 0, to: most}}
  some:
    - {at: 41, name: Some, access: rw, type: int16, models: [A]}
  steps:
    - {id: steps, name: Step, repeat: 1..2, stride: 1, registers: [{at: 50, name: Level, access: rw, type: int16}]}
commands:
  clear: {name: Clear, steps: [{at: 90, words: [1]}]}
"""
HEAD = """\
format: 1
map: {{id: setting/{name}, title: {name}, maker: Acme, class_prefix: {prefix}}}
manual: {{title: {name} manual}}
uses: [setting/common]
models: {models}
"""
FIRST = (
    HEAD.format(name="first", prefix="First", models="{A: {}}")
    + """\
groups:
  - id: control
    name: Control
    source: "7.3"
    each: {access: rw, type: int16}
    registers:
      - {at: 1, name: Most}
      - {set: limits, set_each: {persistence: eeprom, endurance: 10000}}
      - {at: 2, name: Setpoint}
      - {set: state}
      - {set: bounded}
      - {set: some}
  - id: rest
    name: Rest
    source: "7.4"
    registers: [{set: fan}, {set: steps}]
"""
)
SECOND = (
    HEAD.format(name="second", prefix="Second", models="{B: {}, C: {}}")
    + """\
groups:
  - id: control
    name: Control
    source: "8.3"
    registers:
      - {set: state}
      - {set: limits, models: [B]}
      - {set: fan, except_ids: [fan_time]}
"""
)
THIRD = """\
format: 1
map: {id: setting/third, title: third, maker: Zenith, class_prefix: Third}
manual: {title: third manual}
extends: setting/first
models: {T: {from: A}}
renumber: {"7": "9"}
override: [{register: low_limit, reason: another, set: {range: 0..200}}]
"""
FILES = {"common.library": LIBRARY, "first": FIRST, "second": SECOND, "third": THIRD}


@pytest.fixture(scope="module")
def maps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all files above."""
    folder = tmp_path_factory.mktemp("sets") / "maps" / "setting"
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
    for name in ("second", "third"):
        for path, text in python.render(compiled(maps, name)).items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text, encoding="utf-8")
    for package in (folder / "regscribe_devices", folder / PACKAGE):
        (package / "__init__.py").write_text("")
    return folder


@pytest.fixture(scope="module")
def module(out: Path) -> Iterator[Callable[[str], Any]]:
    """Import one of the drivers."""
    regscribe_devices.__path__.append(str(out / "regscribe_devices"))

    def load(name: str) -> ModuleType:
        return importlib.import_module(f"regscribe_devices.setting.{name}")

    yield load
    regscribe_devices.__path__.pop()
    for name in [name for name in sys.modules if name.startswith("regscribe_devices.setting")]:
        del sys.modules[name]


def declared(out: Path, name: str) -> list[str]:
    """The registers that a module declares itself."""
    return re.findall(r"^    (\w+) = (?:Read|Array)", (out / PACKAGE / f"{name}.py").read_text(), flags=re.MULTILINE)


def test_a_set_is_declared_in_the_module_of_its_library_alone(out: Path) -> None:
    assert declared(out, "common") == ["low_limit", "high_limit", "state", "mode", "fan", "fan_time"]
    assert set(declared(out, "first")) & set(declared(out, "common")) == set()
    assert set(declared(out, "second")) == {"fan"}  # of its set the other register is missing


def test_enums_and_flags_in_a_set_are_one_type_in_all_drivers(module: Callable[[str], Any]) -> None:
    common = module("common")
    for name in ("State", "Mode", "HighLimitSpecial", "Speed"):
        assert getattr(module("first"), name) is getattr(common, name), name
        assert name in module("first").__all__
    assert module("second").Mode is common.Mode
    assert module("first").FirstA.mode.decode((1,)) is module("second").SecondB.mode.decode((1,))


def test_a_map_tells_the_section_and_the_memory_of_its_own_devices(module: Callable[[str], Any]) -> None:
    first, second = module("first").FirstA, module("second").SecondB
    told = {
        driver.__name__: (register.section, register.persistence)
        for driver in (first, second)
        for register in (driver.low_limit, driver.registers["low_limit"], driver(object(), unit=1).low_limit.register)
    }
    assert told == {"FirstA": ("7.3", "eeprom"), "SecondB": ("8.3", "")}
    assert (first.state.section, first.state.persistence) == ("7.3", "")
    assert first.fan_time.section == "7.4"
    assert first.low_limit is first.registers["low_limit"]


def test_shared_docstrings_cite_no_section_and_those_of_the_map_its_own(
    module: Callable[[str], Any], out: Path
) -> None:
    code = {name: (out / PACKAGE / f"{name}.py").read_text() for name in ("common", "first", "second")}
    assert '"""Low limit: 0 to 400; unit °C; read and write."""' in code["common"]
    assert not re.search(r"\b[789]\.\d", code["common"])
    assert "(7.3, eeprom)" in code["first"]
    assert "(8.3)" in code["second"]
    assert "8.3" not in code["first"]
    assert "7.3" not in code["second"]
    assert module("common").State.__doc__ == "State."


def test_a_model_has_exactly_its_registers_in_the_order_of_the_manual(module: Callable[[str], Any], maps: Path) -> None:
    for name in ("first", "second", "third"):
        for model in compiled(maps, name).models:
            for prefix in ("", "Async"):
                driver = getattr(module(name), f"{prefix}{model.class_name}")
                assert list(driver.registers) == [one.path for one in model.registers]
    assert not hasattr(module("second").SecondC, "low_limit")
    assert not hasattr(module("second").SecondB, "fan_time")


def test_a_set_that_needs_its_map_is_declared_in_the_map(module: Callable[[str], Any], out: Path) -> None:
    assert {"bounded", "some", "steps"} <= set(declared(out, "first"))
    assert module("first").FirstA.registers["steps[2].level"].section == "7.4"


def test_an_extension_renumbers_what_its_base_told_of_a_set(module: Callable[[str], Any], out: Path) -> None:
    driver, common = module("third").ThirdT, module("common")
    assert (driver.state.section, driver.fan.section, driver.low_limit.section) == ("9.3", "9.4", "9.3")
    assert (driver.high_limit.section, driver.high_limit.persistence) == ("9.3", "eeprom")
    assert module("third").Mode is common.Mode
    assert declared(out, "third") == ["low_limit"]
    assert [max(code for code in (200, 400) if _fits(one, code)) for one in (driver, module("first").FirstA)] == [
        200,
        400,
    ]


def _fits(driver: Any, value: int) -> bool:
    try:
        driver.low_limit.encode(value)
    except ValueError:
        return False
    return True


def test_protocol_commands_and_constants_of_a_library_are_imported(module: Callable[[str], Any], out: Path) -> None:
    assert module("first").FirstA.protocol is module("second").SecondC.protocol
    assert module("first").FirstA.commands.part is module("second").SecondB.commands.part
    for name in ("first", "second"):
        code = (out / PACKAGE / f"{name}.py").read_text()
        assert "Protocol(" not in code
        assert "cool down" not in code


def test_a_library_is_rendered_the_same_whichever_map_uses_it(maps: Path) -> None:
    path = f"{PACKAGE}/common.py"
    assert len({python.render(compiled(maps, name))[path] for name in ("first", "second", "third")}) == 1


USE = """\
from regscribe_devices.setting.first import AsyncFirstA, FirstA, Mode
from regscribe_devices.setting.second import SecondB, SecondC
from regscribe_devices.setting.third import ThirdT


async def use(first: FirstA, later: AsyncFirstA, second: SecondB, third: ThirdT, other: SecondC) -> None:
    mode: Mode = second.mode.read()
    first.mode.write(mode)
    await later.mode.write(mode)
    level: float = (await later.low_limit.read()) + third.low_limit.read()
    first.state.write(0)  # refused
    other.low_limit.read()  # refused
    second.fan_time.read()  # refused
    first.mode.write(second.state.read())  # refused
    print(level)
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
    assert not re.findall(r"setting/\w+\.py:\d+.*error", done.stdout), done.stdout


def test_modules_with_sets_are_formatted_and_pass_the_linter(out: Path) -> None:
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
