"""Arrays that a map has from its base, and sets of a library inside arrays: siblings are those of the element."""

import importlib
import re
import sys
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any

import pytest

import regscribe_devices
from regscribe.emit import python
from regscribe.pipeline import compile_map
from regscribe_runtime.values.views import scale_needs

LIBRARY = """\
format: 1
library: {id: rows/common, title: Common}
decimals: {digits: {register: places}}
sets:
  reading:
    - {at: 0, name: Value, access: rw, type: int16, decimals: digits}
    - {at: 1, name: Places, access: rw, type: int16, range: 0..3}
    - {at: 2, name: Other, access: rw, type: int16}
"""
BASE = """\
format: 1
map: {id: rows/base, title: Base, maker: Acme, class_prefix: Base}
manual: {title: Base manual}
uses: [rows/common]
models: {One: {}}
groups:
  - id: main
    name: Main
    source: "4.1"
    registers:
      - {set: reading, shift: 900}
      - {id: left, name: Left, repeat: 1..2, stride: 10, registers: [{set: reading}]}
      - {id: right, name: Right, repeat: 0..2, stride: 10, registers: [{set: reading, shift: 100}]}
      - id: rows
        name: Row
        repeat: 1..2
        stride: 100
        source: "4.2"
        registers:
          - {at: 300, name: Places, access: rw, type: int16, range: 0..3}
          - id: cells
            name: Cell
            repeat: 1..2
            stride: 10
            registers: [{at: 310, name: Level, access: rw, type: int16, decimals: digits}]
"""
EXTENSION = """\
format: 1
map: {id: rows/extension, title: Extension, maker: Zenith, class_prefix: Extension}
manual: {title: Extension manual}
extends: rows/base
models: {Two: {from: One}}
renumber: {"4": "6"}
override: [{register: other, reason: another range, set: {range: 0..9}}]
"""
FILES = {"common.library": LIBRARY, "base": BASE, "extension": EXTENSION}


@pytest.fixture(scope="module")
def module(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[str], Any]]:
    """Compile all maps to one package and import one of the drivers."""
    out = tmp_path_factory.mktemp("rows")
    folder = out / "maps" / "rows"
    folder.mkdir(parents=True)
    for name, text in FILES.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    for name in ("base", "extension"):
        found = compile_map(folder / f"{name}.yaml")
        assert found.map is not None, found.diagnostics
        for path, text in python.render(found.map).items():
            (out / path).parent.mkdir(parents=True, exist_ok=True)
            (out / path).write_text(text, encoding="utf-8")
    before = regscribe_devices.__path__
    regscribe_devices.__path__ = [*before, str(out / "regscribe_devices")]

    def load(name: str) -> ModuleType:
        return importlib.import_module(f"regscribe_devices.rows.{name}")

    yield load
    regscribe_devices.__path__ = before
    for name in [name for name in sys.modules if name.startswith("regscribe_devices.rows")]:
        del sys.modules[name]


@pytest.mark.parametrize(("name", "driver"), [("base", "BaseOne"), ("extension", "ExtensionTwo")])
def test_a_set_in_an_array_has_its_siblings_in_the_element(
    module: Callable[[str], Any], name: str, driver: str
) -> None:
    registers = getattr(module(name), driver).registers

    for path, register in registers.items():
        if path.endswith("value"):
            assert scale_needs(register) == (path.replace("value", "places"),)
        if path.endswith("level"):
            assert scale_needs(register) == (re.sub(r"\.cells.*", ".places", path),)
    assert registers["value"].decode((100,), state={"places": 1}) == 10
    for path, digits in (("left[2]", 2), ("right[0]", 0), ("right[2]", 3)):
        others = {f"{one}.places": 1 for one in ("left[1]", "left[2]", "right[0]", "right[1]", "right[2]")}
        state = others | {"places": 1, f"{path}.places": digits}
        assert registers[f"{path}.value"].decode((100,), state=state) == 100 / 10**digits


def test_an_extension_has_the_arrays_of_its_base_in_the_sections_of_its_own_manual(
    module: Callable[[str], Any],
) -> None:
    extension = module("extension").ExtensionTwo

    assert scale_needs(extension.registers["rows[2].cells[1].level"]) == ("rows[2].places",)
    assert extension.registers["rows[2].cells[1].level"].section == "6.2"
