"""What maps share stands in one module: an extension imports from its base, maps import from their library."""

import importlib
import os
import re
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from textwrap import dedent
from types import ModuleType
from typing import Any

import pytest

import regscribe_devices
from regscribe.emit import python
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map

ROOT = Path(__file__).parents[3]
PACKAGE = "regscribe_devices/sharing"
LIBRARY = """\
format: 1
library: {id: sharing/common, title: Common}
enums:
  mode: {0: "off", 1: {label: run, description: until it is stopped}}
  speed: {0: slow, 1: fast, 2: {label: faster, models: [Beta]}}
"""
USER = """\
format: 1
map: {{id: sharing/{name}, title: {name}, maker: Acme, class_prefix: {prefix}}}
manual: {{title: {name} manual}}
uses: [sharing/common]
models: {{Alpha: {{}}, Beta: {{}}}}
protocol: {{functions: [3, 6], limits: {{read_words: 20, write_words: 20}}}}
groups:
  - id: control
    name: Control
    source: "1"
    each: {{access: rw}}
    registers: [{{at: 1, name: Mode, enum: mode}}, {{at: 2, name: Speed, enum: speed}}]
"""
BASE = """\
format: 1
map: {id: sharing/base, title: Base, maker: Acme, class_prefix: Acme}
manual: {title: Base manual}
models: {Small: {}, Large: {}}
protocol: {functions: [3, 6, 16], limits: {read_words: 20, write_words: 20}}
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
      - {at: 4, name: Limit, range: 0..10, special: {99: "off"}}
      - {at: 5, name: Status, access: r, flags: {0: hot, 1: cold}}
      - {at: 6, name: Fan, models: [Large]}
      - {at: 7, name: Pump, models: [Large]}
      - {at: 8, name: Door, models: [Small]}
      - id: steps
        name: Step
        repeat: 1..3
        stride: 2
        source: 4.2
        registers: [{at: 20, name: Level}, {at: 21, name: Action, id: step_action, enum: action}]
commands:
  clear: {name: Clear, source: "7.1", steps: [{at: 90, words: [1]}]}
"""
EXTENSION = """\
format: 1
map: {id: sharing/extension, title: Extension, maker: Zenith, class_prefix: Zenith}
manual: {title: Extension manual}
extends: sharing/base
models: {S: {from: Small}, L: {from: Large}}
renumber: {"4": "6"}
drop: {registers: [{id: pump, reason: it has none}]}
override:
  - {register: setpoint, reason: another default, set: {default: 25}}
  - {register: action, reason: other words, set: {enum: {0: none, 1: high}}}
"""
THIRD = """\
format: 1
map: {id: sharing/third, title: Third, maker: Third, class_prefix: Third}
manual: {title: Third manual}
extends: sharing/extension
models: {T: {from: S}}
renumber: {"6": "8"}
override: [{register: limit, reason: another, set: {range: 0..20}}]
"""
FILES = {
    "common.library": LIBRARY,
    "first": USER.format(name="first", prefix="First"),
    "second": USER.format(name="second", prefix="Second"),
    "base": BASE,
    "extension": EXTENSION,
    "third": THIRD,
}


@pytest.fixture(scope="module")
def maps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with all files above."""
    folder = tmp_path_factory.mktemp("sharing") / "maps" / "sharing"
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
    for name in ("first", "second", "third"):
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
        return importlib.import_module(f"regscribe_devices.sharing.{name}")

    yield load
    regscribe_devices.__path__.pop()
    for name in [name for name in sys.modules if name.startswith("regscribe_devices.sharing")]:
        del sys.modules[name]


def test_an_enum_of_a_library_is_one_type_in_all_drivers(module: Callable[[str], Any]) -> None:
    assert module("first").Mode is module("second").Mode is module("common").Mode
    assert "Mode" in module("first").__all__
    assert module("first").Mode.RUN.description == "until it is stopped"


def test_an_enum_that_a_model_has_differently_stays_its_own(module: Callable[[str], Any]) -> None:
    first, common = module("first"), module("common")
    assert first.FirstAlpha.speed.decode((1,)) is common.Speed.FAST
    assert [member.name for member in common.Speed] == ["SLOW", "FAST"]
    assert first.FirstBeta.speed.decode((2,)) is first.SpeedBeta.FASTER
    assert first.SpeedBeta is not module("second").SpeedBeta


def test_an_extension_has_the_types_of_its_base_and_repeats_no_declaration(
    module: Callable[[str], Any], out: Path
) -> None:
    base, extension = module("base"), module("extension")
    for name in ("Kind", "LimitSpecial", "Status", "Step", "AsyncStep"):
        assert getattr(extension, name) is getattr(base, name), name
        assert name in extension.__all__
    declared = re.findall(r"^    (\w+) = Read", (out / PACKAGE / "extension.py").read_text(), flags=re.MULTILINE)
    assert sorted(declared) == ["action", "fan", "setpoint"]  # two overrides, and what stood beside the dropped pump


def test_a_dropped_register_cannot_be_reached(module: Callable[[str], Any]) -> None:
    large = module("extension").ZenithL
    assert hasattr(module("base").AcmeLarge, "pump")
    assert not hasattr(large, "pump")
    assert "pump" not in large.registers
    assert hasattr(large, "fan")


def test_a_model_has_exactly_the_registers_of_its_map_in_its_order(module: Callable[[str], Any], maps: Path) -> None:
    for name, prefix in (("base", "Acme"), ("extension", "Zenith"), ("third", "Third")):
        for model in compiled(maps, name).models:
            for driver in (f"{prefix}{model.name}", f"Async{prefix}{model.name}"):
                assert list(getattr(module(name), driver).registers) == [one.path for one in model.registers]


def test_overrides_win_and_leave_the_base_alone(module: Callable[[str], Any]) -> None:
    base, extension = module("base"), module("extension")
    assert (base.AcmeSmall.setpoint.default, extension.ZenithS.setpoint.default) == (77, 25)
    assert extension.ZenithS.action.decode((1,)) is extension.ActionSL.HIGH
    assert base.AcmeSmall.action.decode((1,)) is base.Action.LOW


def test_elements_keep_the_enum_that_only_a_register_overrides(module: Callable[[str], Any]) -> None:
    step = module("extension").ZenithS.registers["steps[2].step_action"]
    assert step.decode((1,)) is module("extension").Action.LOW
    assert module("extension").Action is module("base").Action


def test_sections_are_those_of_the_own_manual_wherever_a_register_is_met(module: Callable[[str], Any]) -> None:
    driver = module("extension").ZenithS
    unit = driver(object(), unit=1)
    found = {
        driver.kind.section,
        driver.registers["kind"].section,
        unit.kind.register.section,
        driver.setpoint.section,  # declared anew, so not to be renumbered again
    }
    assert found == {"6.1"}
    assert {unit.steps[2].level.register.section, driver.registers["steps[2].level"].section} == {"6.2"}
    assert {one.section for one in unit.steps[2].placed().values()} == {"6.2"}
    assert driver.kind is driver.registers["kind"]
    assert (module("base").AcmeSmall.kind.section, module("base").Step.level.section) == ("4.1", "4.2")


def test_an_extension_of_an_extension_takes_the_best_of_both(module: Callable[[str], Any]) -> None:
    driver = module("third").ThirdT
    assert driver.kind.section == driver.limit.section == "8.1"
    assert driver.registers["steps[1].level"].section == "8.2"
    assert driver.setpoint.default == 25
    assert module("third").Kind is module("base").Kind


def test_documentation_says_whose_sections_inherited_docstrings_cite(module: Callable[[str], Any]) -> None:
    for owner in (module("extension"), module("extension").ZenithS):
        assert "Inherited docstrings cite sections as the manual of Base has them." in owner.__doc__
    assert "Inherited" not in module("base").__doc__ + module("first").__doc__


def test_commands_and_groups_come_from_the_base(module: Callable[[str], Any]) -> None:
    base, extension = module("base"), module("extension")
    assert extension.ZenithS.commands.part is base.BaseCommands
    assert extension.ZenithS.groups is base.BaseGroups
    large = extension.ZenithL
    read = [register.path for register in large.groups.control.registers(large)]
    assert read[-3:] == ["steps[2].step_action", "steps[3].level", "steps[3].step_action"]
    assert "fan" in read


def test_a_base_is_rendered_the_same_with_its_extension_as_alone(maps: Path) -> None:
    alone = python.render(compiled(maps, "base"))
    below = python.render(compiled(maps, "third"))
    assert alone.items() <= below.items()
    assert sorted(below) == [f"{PACKAGE}/base.py", f"{PACKAGE}/extension.py", f"{PACKAGE}/third.py"]


def test_no_hash_seed_shows_in_what_is_shared(maps: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from regscribe.emit import python\n"
        "from regscribe.pipeline import compile_map\n"
        "for name in sys.argv[1:]: print(python.render(compile_map(Path(name)).map))"
    )
    command = [sys.executable, "-c", code, str(maps / "third.yaml"), str(maps / "second.yaml")]
    texts = {
        subprocess.run(  # noqa: S603 (our own code)
            command, env=os.environ | {"PYTHONHASHSEED": seed}, capture_output=True, text=True, check=True
        ).stdout
        for seed in ("1", "2", "3")
    }
    assert len(texts) == 1


USE = """\
from regscribe_devices.sharing.extension import ActionSL, AsyncZenithS, Kind, ZenithL, ZenithS
from regscribe_devices.sharing.first import FirstAlpha, Mode
from regscribe_devices.sharing.second import SecondBeta


async def use(alpha: FirstAlpha, beta: SecondBeta, small: ZenithS, large: ZenithL, later: AsyncZenithS) -> None:
    mode: Mode = beta.mode.read()
    alpha.mode.write(mode)
    kind: Kind = small.kind.read()
    action: ActionSL = small.action.read()
    level: int = (await later.steps[1].level.read()) + large.fan.read()
    small.status.write(0)  # refused
    large.pump.read()  # refused
    small.action.write(kind)  # refused
    small.commands.clear()
    print(action, level)
"""


@pytest.mark.parametrize("checker", ["mypy", "pyright"])
def test_type_checkers_accept_what_is_shared_and_refuse_what_was_dropped(out: Path, checker: str) -> None:
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
    assert {int(line) for line in re.findall(r"use\.py:(\d+):(?:\d+ -)? error", done.stdout)} == set(refused), (
        done.stdout + done.stderr
    )
    assert not re.findall(r"sharing/\w+\.py:\d+.*error", done.stdout), done.stdout


def test_shared_modules_are_formatted_and_pass_the_linter(out: Path) -> None:
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


def test_givens_are_asked_for_by_the_class_of_the_base(tmp_path: Path) -> None:
    givens = dedent("""\
        givens: {linear: {type: codes, register: kind, description: d, reason: r}}
        conditions: {is_linear: {kind: {in: linear}}}
    """)
    base = BASE.replace("enums:\n", f"{givens}enums:\n", 1).replace(
        "name: Limit, range: 0..10", "name: Limit, range: [{when: is_linear, is: 0..5}, {is: 0..10}]"
    )
    folder = tmp_path / "maps" / "sharing"
    folder.mkdir(parents=True)
    (folder / "base.yaml").write_text(base, encoding="utf-8")
    (folder / "extension.yaml").write_text(EXTENSION, encoding="utf-8")
    code = python.render(compiled(folder, "extension"))[f"{PACKAGE}/extension.py"]
    assert re.search(r"class ZenithS\([^)]*, _BaseDevice\):", code)
    assert re.search(r"class AsyncZenithS\([^)]*, _AsyncBaseDevice\):", code)
    assert "def __init__" not in code
