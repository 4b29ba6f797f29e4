"""The modules of libraries are written, kept and removed like any other generated file."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

LIBRARY = "format: 1\nlibrary: {id: acme/common, title: Common}\nenums: {mode: {0: one, 1: two}}\n"
EXTENSION = """\
format: 1
map: {id: other/oven, title: Other, maker: Other, class_prefix: Other}
extends: acme/oven
uses: [acme/common]
models: {M2: {from: M1}}
groups: [{id: extra, name: Extra, source: "9", registers: [{at: 900, name: Own Mode, access: r, enum: mode}]}]
"""
SHARED = Path("generated/regscribe_devices/acme/common.py")
BASE = Path("generated/regscribe_devices/acme/oven.py")


@pytest.fixture
def extension(oven: Path) -> Path:
    """A map that extends the oven and uses a library."""
    (oven.parent / "common.library.yaml").write_text(LIBRARY)
    path = oven.parents[1] / "other" / "oven.yaml"
    path.parent.mkdir()
    path.write_text(EXTENSION)
    return path


def test_a_run_over_one_map_writes_what_its_driver_imports_and_no_other_driver(
    cli: Callable[..., Any], extension: Path
) -> None:
    assert cli("generate", extension).code == 0
    assert "class Mode(Choice)" in SHARED.read_text()
    assert not BASE.exists()


@pytest.mark.usefixtures("extension")
def test_shared_modules_are_up_to_date_whichever_map_is_generated_last(cli: Callable[..., Any], oven: Path) -> None:
    cli("generate")
    assert ": 0 written" in cli("generate").out
    assert cli("generate", "--check").code == 0
    assert ": 0 written" in cli("generate", oven).out
    assert cli("generate", "--check").code == 0


@pytest.mark.usefixtures("extension")
def test_a_damaged_shared_module_is_found_and_mended(cli: Callable[..., Any]) -> None:
    cli("generate")
    before = SHARED.read_text()
    SHARED.write_text(before + "# by hand\n")
    assert cli("generate", "--check").code == 1
    assert ": 1 written" in cli("generate").out
    assert SHARED.read_text() == before


def test_a_change_in_a_library_reaches_its_module(cli: Callable[..., Any], extension: Path) -> None:
    cli("generate")
    library = extension.parents[1] / "acme" / "common.library.yaml"
    library.write_text(LIBRARY.replace("two", "three"))
    assert cli("generate").code == 0
    assert "THREE = 1" in SHARED.read_text()


def test_the_module_of_a_library_goes_with_the_last_map_that_uses_it(cli: Callable[..., Any], extension: Path) -> None:
    cli("generate")
    extension.write_text(EXTENSION.replace("uses: [acme/common]\n", "").replace("enum: mode", "type: uint16"))
    cli("generate", extension)
    assert SHARED.exists()  # a run over one map removes nothing that others may use
    cli("generate")
    assert not SHARED.exists()


def test_a_map_that_claims_the_module_of_a_library_is_refused(cli: Callable[..., Any], extension: Path) -> None:
    text = (extension.parents[1] / "acme" / "oven.yaml").read_text()
    (extension.parents[1] / "acme" / "common.yaml").write_text(text.replace("acme/oven", "acme/common"))
    result = cli("generate")
    assert result.code == 1
    assert "both make regscribe_devices/acme/common.py" in result.err
