"""Three wheels (what drivers need, the drivers, the compiler): each is whole, and works without the source tree."""

import tomllib
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from .distributions import FOLDERS, ROOT, run

SOURCES = {
    "regscribe_runtime": "generator/runtime/regscribe_runtime",
    "regscribe_devices": "generated/regscribe_devices",
    "regscribe": "generator/regscribe",
}


def project(package: str) -> dict[str, Any]:
    path = ROOT / FOLDERS[package] / "pyproject.toml"
    found: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))["project"]
    return found


def source_files(folder: str, pattern: str) -> Iterator[str]:
    for path in sorted((ROOT / folder).rglob(pattern)):
        yield path.relative_to(ROOT / folder).as_posix()


@pytest.mark.parametrize("package", FOLDERS)
def test_a_wheel_holds_its_package_whole_and_nothing_of_another(package: str, wheels: dict[str, Path]) -> None:
    names = set(zipfile.ZipFile(wheels[package]).namelist())
    kinds = ("*.py", "*.j2", "*.yaml", "*py.typed")
    expected = {f"{package}/{name}" for kind in kinds for name in source_files(SOURCES[package], kind)}
    assert expected - names == set()
    assert expected & {f"{package}/py.typed", f"{package}/fdc/py.typed"}
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith((".dist-info", ".data"))} == {package}
    shared = {name.partition(".data/")[2].rpartition("/")[0] for name in names if ".data/" in name}
    assert shared <= {"data/share/man/man1"}


def test_the_compiler_carries_maps_and_schemas(wheels: dict[str, Path]) -> None:
    names = set(zipfile.ZipFile(wheels["regscribe"]).namelist())
    expected = {
        *(f"regscribe/data/maps/{name}" for name in source_files("maps", "*.yaml")),
        *(f"regscribe/data/schema/{name}" for name in source_files("schema", "*.json")),
    }
    assert expected - names == set()
    assert {"regscribe/data/maps/fdc/series-100.yaml", "regscribe/data/schema/map.schema.json"} <= names


def test_the_three_are_released_together() -> None:
    import regscribe  # noqa: PLC0415 - the version that the command prints

    versions = {project(package)["version"] for package in FOLDERS}
    assert versions == {regscribe.__version__}
    pinned = [one for package in FOLDERS for one in project(package)["dependencies"] if one.startswith("regscribe-")]
    assert {one.split("==")[1] for one in pinned} == versions
    assert len(pinned) == 3


def test_the_runtime_imports_alone(environment: Callable[[set[str], set[str]], Path], tmp_path: Path) -> None:
    alone = environment({"regscribe_runtime"}, {"pymodbus", "serial"})
    script = (
        "import importlib, pkgutil, sys\n"
        "import regscribe_runtime as package\n"
        "names = [one.name for one in pkgutil.walk_packages(package.__path__, 'regscribe_runtime.')]\n"
        "[importlib.import_module(name) for name in names]\n"
        "print(package.__file__, 'regscribe' in sys.modules, 'regscribe_devices' in sys.modules, len(names) > 50)"
    )
    place, *rest = run(alone / "python", "-c", script, cwd=tmp_path).split()
    assert Path(place).is_relative_to(alone.parent)
    assert rest == ["False", "False", "True"]


def test_drivers_need_the_runtime_alone(environment: Callable[[set[str], set[str]], Path], tmp_path: Path) -> None:
    production = environment({"regscribe_runtime", "regscribe_devices"}, {"pymodbus", "serial"})
    script = (
        "import importlib.util\n"
        "from regscribe_devices.fdc.series_100 import FdcC21\n"
        "from regscribe_runtime import known_models\n"
        "heavy = ('regscribe', 'yaml', 'jinja2', 'click', 'rich', 'jsonschema')\n"
        "print(FdcC21.model, len(known_models()), [one for one in heavy if importlib.util.find_spec(one)])"
    )
    assert run(production / "python", "-c", script, cwd=tmp_path) == "C21 21 []\n"


def test_an_installed_driver_reads_a_simulated_device_of_another_process(
    environment: Callable[[set[str], set[str]], Path], installed: Path, tmp_path: Path
) -> None:
    production = environment({"regscribe_runtime", "regscribe_devices"}, {"pymodbus", "serial"})
    simulator = """
import subprocess, sys
from regscribe.simulate import simulate

with simulate("athena/series-c", "16C") as device:
    device.poke("output_2_type", "inactive_disabled")
    reader = subprocess.run([*sys.argv[1:], str(device.port)], capture_output=True, text=True, timeout=60)
    print(reader.stdout + reader.stderr, end="")
"""
    reader = """
import sys
from regscribe_devices.athena.series_c import Athena16C

with Athena16C.tcp("127.0.0.1", port=int(sys.argv[1]), unit=1) as controller:
    print(controller.output_2_type.read().name)
"""
    read = run(installed / "python", "-c", simulator, production / "python", "-c", reader, cwd=tmp_path)
    assert read == "INACTIVE_DISABLED\n"


def test_an_installed_regscribe_stands_on_its_own(installed: Path, tmp_path: Path) -> None:
    assert run(installed / "regscribe", "--version", cwd=tmp_path).startswith("regscribe 0.")
    where = run(installed / "python", "-c", "import regscribe; print(regscribe.__file__)", cwd=tmp_path)
    assert Path(where).is_relative_to(installed.parent)


def test_an_installed_regscribe_checks_compiles_and_starts_maps(installed: Path, tmp_path: Path) -> None:
    assert "1 map checked" in run(installed / "regscribe", "check", "fdc/series-100", cwd=tmp_path)
    run(installed / "regscribe", "new", "acme/oven", cwd=tmp_path)
    assert "1 map, 2 models" in run(installed / "regscribe", "generate", cwd=tmp_path)
    assert "RS0109" in run(installed / "regscribe", "explain", "RS0109", cwd=tmp_path)


def test_an_installed_regscribe_finds_its_own_plugins(installed: Path, tmp_path: Path) -> None:
    assert "address" in run(installed / "regscribe", "export", "fdc/series-100", "--format", "csv", cwd=tmp_path)
    (tmp_path / "list.csv").write_text("Address;Name;Type;Access\n1;Speed;U16;R\n")
    run(installed / "regscribe", "import", "list.csv", "-o", "maps/acme/fan.yaml", cwd=tmp_path)
    assert "1 map checked" in run(installed / "regscribe", "check", cwd=tmp_path)
