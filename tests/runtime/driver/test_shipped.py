"""A map of one's own can build on what comes with regscribe; its driver imports what is installed."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from regscribe.emit import python
from regscribe.emit.write import write
from regscribe.pipeline import Compiled, compile_map

ROOT = Path(__file__).parents[3]
OWN = """\
format: 1
map: {id: athena/own, title: Own, maker: Acme, class_prefix: Own}
manual: {title: Own manual}
uses: [athena/platinum-common]
models: {P: {}}
groups:
  - {id: page, name: Page, source: "5.1", registers: [{set: locks}]}
"""
EXTENSION = """\
format: 1
map: {id: acme/twin, title: Twin, maker: Acme, class_prefix: Twin}
manual: {title: Twin manual}
extends: athena/platinum-m300
models: {T3: {from: M300}}
renumber: {"8": "2"}
"""
USE = """\
from regscribe_devices.athena.own import LockState, OwnP
from regscribe_devices.athena.platinum_m300 import AthenaM300


def use(own: OwnP, other: AthenaM300) -> None:
    state: LockState = other.keypad_lock.read()
    own.keypad_lock.write(state)
    own.baud_rate.read()  # refused
"""


def compiled(folder: Path, map_id: str, text: str) -> Compiled:
    """A map in a `maps` folder of its own."""
    path = folder / "maps" / f"{map_id}.yaml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return compile_map(path)


def generated(folder: Path, map_id: str, text: str) -> list[str]:
    """The drivers that are written for a map below `generated`."""
    found = compiled(folder, map_id, text)
    assert found.map is not None, found.diagnostics
    return list(write(python.render(found.map), folder / "generated").written)


def run(folder: Path, *command: str, own_first: bool = True) -> "subprocess.CompletedProcess[str]":
    """A command that finds the own drivers before or behind those that are installed."""
    folders = [folder / "generated", ROOT / "generator", ROOT / "generator" / "runtime", ROOT / "generated"]
    path = os.pathsep.join(map(str, folders if own_first else reversed(folders)))
    return subprocess.run(  # noqa: S603 (our own command)
        [sys.executable, *command],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": path, "MYPYPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )


def test_what_is_installed_is_imported_and_not_written_again(tmp_path: Path) -> None:
    modules = [
        path for path in generated(tmp_path, "athena/own", OWN) if not path.endswith(("__init__.py", "py.typed"))
    ]
    assert modules == ["regscribe_devices/athena/own.py"]
    code = (
        "from regscribe_devices.athena import own, platinum_common, platinum_m300\n"
        "print(own.LockState is platinum_common.LockState is platinum_m300.LockState)\n"
        "print(own.OwnP.keypad_lock.section, platinum_m300.AthenaM300.keypad_lock.section)"
    )
    done = run(tmp_path, "-c", code)
    assert done.stdout == "True\n5.1 8.1\n", done.stderr


def test_own_drivers_are_found_behind_those_that_are_installed(tmp_path: Path) -> None:
    generated(tmp_path, "athena/own", OWN)
    done = run(tmp_path, "-c", "import regscribe_devices.fdc.series_100, regscribe_devices.athena.own", own_first=False)
    assert done.returncode == 0, done.stderr


def test_an_extension_of_a_shipped_map_cites_its_own_manual(tmp_path: Path) -> None:
    modules = generated(tmp_path, "acme/twin", EXTENSION)
    assert not any("athena" in path for path in modules)
    code = (
        "from regscribe_devices.acme.twin import TwinT3\n"
        "print(TwinT3.keypad_lock.section, TwinT3.local_setpoint.section, TwinT3.registers['product_code'].section)"
    )
    done = run(tmp_path, "-c", code)
    assert done.stdout == "2.1 2.3 2.4\n", done.stderr


@pytest.mark.parametrize("checker", ["mypy", "pyright"])
def test_type_checkers_see_both_folders_of_drivers(tmp_path: Path, checker: str) -> None:
    generated(tmp_path, "athena/own", OWN)
    (tmp_path / "use.py").write_text(USE, encoding="utf-8")
    folders = f'["generated", "{ROOT}/generator", "{ROOT}/generator/runtime", "{ROOT}/generated"]'
    (tmp_path / "pyrightconfig.json").write_text(f'{{"extraPaths": {folders}, "typeCheckingMode": "standard"}}')
    options = {
        "mypy": ["--strict", f"--cache-dir={tmp_path / 'cache'}", "--config-file=", "--explicit-package-bases"],
        "pyright": ["--pythonpath", sys.executable],
    }[checker]
    done = run(tmp_path, "-m", checker, *options, "use.py")
    errors = [line for line in done.stdout.splitlines() if " error" in line and "use.py" in line]
    assert len(errors) == 1, done.stdout
    assert "baud_rate" in done.stdout


def test_a_library_of_ones_own_comes_before_one_of_the_same_id(tmp_path: Path) -> None:
    library = tmp_path / "maps" / "athena" / "platinum-common.library.yaml"
    library.parent.mkdir(parents=True)
    library.write_text(
        "format: 1\nlibrary: {id: athena/platinum-common, title: Own}\n"
        "sets: {locks: [{at: 1, name: Own lock, access: r, enum: {0: free, 1: locked}}]}\n"
    )
    modules = generated(tmp_path, "athena/own", OWN)
    assert "regscribe_devices/athena/platinum_common.py" in modules
    assert "class OwnLock(" in (tmp_path / "generated/regscribe_devices/athena/platinum_common.py").read_text()


def test_a_shipped_map_does_not_see_libraries_of_ones_own(tmp_path: Path) -> None:
    library = tmp_path / "maps" / "athena" / "platinum-common.library.yaml"
    library.parent.mkdir(parents=True)
    library.write_text("format: 1\nlibrary: {id: athena/platinum-common, title: Own}\nenums: {other: {0: none}}\n")
    assert compiled(tmp_path, "acme/twin", EXTENSION).map is not None


def test_what_neither_folder_has_is_said_to_be_in_neither(tmp_path: Path) -> None:
    for wrong, meant, text in (("m30", "platinum-m300", EXTENSION), ("comon", "platinum-common", OWN)):
        (found,) = compiled(tmp_path, "acme/twin", text.replace(meant, f"platinum-{wrong}")).diagnostics
        assert found.rule == "RS0501"
        assert f"`athena/platinum-{wrong}`: no file " in found.message
        assert found.message.endswith(", and none comes with regscribe")
        assert f"did you mean `athena/{meant}`?" in found.help
