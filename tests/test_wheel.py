"""The wheel holds everything that regscribe needs, and works where nothing of the source tree is."""

import os
import subprocess
import sys
import sysconfig
import venv
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def run(*command: str | Path, cwd: Path) -> str:
    """Standard output of a command that must succeed, without what would let it see the source tree."""
    env = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    done = subprocess.run(  # noqa: S603 - our own commands
        list(map(str, command)), cwd=cwd, env=env, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    run(sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", folder, cwd=ROOT)
    (path,) = folder.glob("*.whl")
    return path


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The bin folder of an environment with the wheel and, by a .pth file, the libraries of this one.

    A .pth file that stands in a folder named by a .pth file is not read, so the editable source tree is not there.
    """
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder, with_pip=False, symlinks=True)
    libraries = sysconfig.get_path("purelib")
    (site,) = folder.glob("lib/python*/site-packages")
    (site / "libraries.pth").write_text(f"{libraries}\n")
    run(sys.executable, "-m", "pip", "--python", folder / "bin/python", "install", "--no-deps", wheel, cwd=folder)
    return folder / "bin"


def source_files(folder: str, pattern: str) -> Iterator[str]:
    for path in sorted((ROOT / folder).rglob(pattern)):
        yield path.relative_to(ROOT / folder).as_posix()


def test_the_wheel_holds_packages_schema_templates_examples_maps_and_drivers(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    expected = {
        *(
            f"regscribe/{name}"
            for kind in ("*.py", "*.j2", "*.yaml", "py.typed")
            for name in source_files("generator/regscribe", kind)
        ),
        *(
            f"regscribe_devices/{name}"
            for kind in ("*.py", "py.typed")
            for name in source_files("generated/regscribe_devices", kind)
        ),
        *(f"regscribe/data/maps/{name}" for name in source_files("maps", "*.yaml")),
        *(f"regscribe/data/schema/{name}" for name in source_files("schema", "*.json")),
    }
    assert expected - names == set()
    assert {"regscribe/data/maps/fdc/series-100.yaml", "regscribe/data/schema/map.schema.json"} <= names
    assert {"regscribe/py.typed", "regscribe_devices/py.typed", "regscribe_devices/fdc/series_100.py"} <= names
    assert any(name.endswith(".j2") for name in names)
    assert any("/examples/" in name for name in names)


def test_the_wheel_holds_nothing_else(wheel: Path) -> None:
    tops = {name.split("/")[0] for name in zipfile.ZipFile(wheel).namelist()}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"regscribe", "regscribe_devices"}


def test_an_installed_regscribe_stands_on_its_own(installed: Path, tmp_path: Path) -> None:
    assert run(installed / "regscribe", "--version", cwd=tmp_path).startswith("regscribe 0.")
    where = run(installed / "python", "-c", "import regscribe; print(regscribe.__file__)", cwd=tmp_path)
    assert Path(where).is_relative_to(installed.parent)


def test_an_installed_regscribe_checks_compiles_and_starts_maps(installed: Path, tmp_path: Path) -> None:
    assert "1 map checked" in run(installed / "regscribe", "check", "fdc/series-100", cwd=tmp_path)
    run(installed / "regscribe", "new", "acme/oven", cwd=tmp_path)
    assert "1 map, 2 models" in run(installed / "regscribe", "generate", cwd=tmp_path)
    assert "RS0109" in run(installed / "regscribe", "explain", "RS0109", cwd=tmp_path)


def test_an_installed_driver_can_be_imported(installed: Path, tmp_path: Path) -> None:
    script = "from regscribe_devices.fdc.series_100 import FdcC21; print(FdcC21.model)"
    assert run(installed / "python", "-c", script, cwd=tmp_path) == "C21\n"
