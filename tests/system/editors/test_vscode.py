"""The extension for Visual Studio Code, as it is packed, with the real server; a stand-in is the editor alone."""

import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.editors

ROOT = Path(__file__).parents[3]
BUILT = ROOT / ".cache" / "editors" / "vscode" / "dist"
MAPS = ["**/maps/**/*.yaml"]
PATIENCE = 60
"""Seconds for the server to start and answer, on a slow machine too."""

MAP = """\
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
manual: {title: Oven manual, number: A-1}
models: {O1: {}}
enums: {mode: {0: idle, 1: heating}}
groups:
  - {id: all, name: All, source: "1", registers: [{at: 1, name: Mode, enum: mood, access: r}]}
"""


@pytest.fixture(autouse=True)
def _built() -> None:
    if not BUILT.is_dir() or shutil.which("node") is None:
        pytest.skip("the extension is not built: `make test-editors` does that")


def told(folder: Path, command: list[str]) -> list[dict[str, Any]]:
    """What the extension tells, with this setting of the program, where a map is open that has a mistake in line 7."""
    path = folder / "maps" / "acme" / "oven.yaml"
    path.parent.mkdir(parents=True)
    path.write_text(MAP, encoding="utf-8")
    settings = json.dumps({"command": command, "maps": MAPS})
    stub = str(Path(__file__).with_name("vscode_stub.cjs"))
    done = subprocess.run(  # noqa: S603 - our own extension
        ["node", stub, str(BUILT / "extension.js"), settings, str(path)],  # noqa: S607 - node of the system
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=True,
    )
    return [json.loads(line) for line in done.stdout.splitlines()]


def test_a_mistake_in_a_map_is_shown_where_it_stands(tmp_path: Path) -> None:
    events = told(tmp_path, [sys.executable, "-m", "regscribe", "lsp"])
    (findings,) = [event["findings"] for event in events if "findings" in event]
    assert [one["line"] for one in findings] == [6]  # editors count from 0
    assert "there is no enum `mood`" in findings[0]["message"]


def test_a_program_in_the_folder_is_found_there(tmp_path: Path) -> None:
    program = tmp_path / "tools" / "regscribe"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m regscribe "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    assert any("findings" in event for event in told(tmp_path, ["tools/regscribe", "lsp"]))


@pytest.mark.parametrize("program", ["regscribe-that-is-not-there", "./nowhere/regscribe"])
def test_a_missing_program_is_named_with_what_to_do(tmp_path: Path, program: str) -> None:
    (error,) = [event["error"] for event in told(tmp_path, [program, "lsp"]) if "could not" in event.get("error", "")]
    assert "pip install 'regscribe[lsp]'" in error
    assert "regscribe.command" in error


def test_the_package_holds_the_bundle_and_nothing_else() -> None:
    with zipfile.ZipFile(BUILT / "regscribe.vsix") as package:
        names = {name for name in package.namelist() if name.startswith("extension/")}
        manifest = json.loads(package.read("extension/package.json"))
    parts = {"package.json", "readme.md", "LICENSE.txt", "dist/extension.js"}
    assert names == {f"extension/{part}" for part in parts}
    assert manifest["main"] == "./dist/extension.js"
    assert manifest["contributes"]["configuration"]["properties"]["regscribe.command"]["default"] == [
        "regscribe",
        "lsp",
    ]


def test_the_lock_names_no_registry() -> None:
    text = (ROOT / "editors" / "vscode" / "package-lock.json").read_text(encoding="utf-8")
    assert "resolved" not in text
    assert (
        json.loads(text)["version"] == json.loads((ROOT / "editors/vscode/package.json").read_text("utf-8"))["version"]
    )
