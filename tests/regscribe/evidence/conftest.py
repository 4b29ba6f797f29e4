"""A small map of two models with what a comparison can meet: views, an alias, an enum, bits, coils, a notation."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.evidence.compare import compare_table
from regscribe.evidence.differences import Comparison
from regscribe.evidence.table import read
from regscribe.export.csv import csv_text
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map

KILN = """\
format: 1
map: {id: acme/kiln, title: Kiln, maker: Acme, class_prefix: Kiln}
manual: {title: Kiln manual, number: K-1}
models: {K1: {}, K2: {}}
notations:
  - {name: JBUS, space: holding, offset: 1}
  - {name: JBUS, space: coil, offset: 1}
protocol: {functions: [1, 3, 5, 6, 16]}
reserved: [{at: 8..9}]
givens:
  linear: {type: codes, register: sensor, description: linear codes, reason: in another manual}
views:
  fraction:
    base: {type: int16, rounding: half_up}
    x10: {offset: 1000, type: int16, factor: 10, rounding: half_up}
groups:
  - id: control
    name: Control
    source: 3.1.2
    each: {access: rw}
    registers:
      - {at: 0, name: Process Value, access: r, views: fraction, aliases: [64, 128], unit: °C}
      - {at: 1, name: "Set-Point (RAM)", symbol: S.P, views: fraction, range: {from: 0, to: {open: sensor span}},
         default: 25, writable: {when: {sensor: {in: linear}}, reason: linear only}, unit: °C}
      - {at: 2, name: Sensor, enum: {0: J, 1: type K}, default: 1}
      - {at: 3, name: Status, access: r, flags: {0: alarm, 3: open loop}}
      - {at: 4, name: Serial Number, type: uint32}
      - {at: 6, name: Gain, decimals: not_stated, except: [K2], inferred: [{what: a gain, why: its place}]}
      - {id: steps, repeat: 1..2, stride: 1, name: Step,
         registers: [{at: 20, name: Level, decimals: not_stated, range: 0..99}]}
      - {at: 0, name: Heating, space: coil, type: bit}
commands:
  reset: {name: Reset, steps: [{at: 6, words: [1]}, {at: 30, words: [2]}]}
examples:
  - {source: "4", register: set_point_ram, words: [25], value: 25}
"""


@pytest.fixture(scope="session")
def load(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], RegisterMap]:
    """Compile a text; it must be free of errors."""

    def compiled(text: str) -> RegisterMap:
        path = tmp_path_factory.mktemp("map") / "map.yaml"
        path.write_text(text, encoding="utf-8")
        found = compile_map(path)
        assert found.map is not None, [f"{each.span.line}: {each.message}" for each in found.diagnostics]
        return found.map

    return compiled


@pytest.fixture(scope="session")
def kiln(load: Callable[[str], RegisterMap]) -> RegisterMap:
    return load(KILN)


@pytest.fixture(scope="session")
def text() -> str:
    """The small map as a user writes it."""
    return KILN


@pytest.fixture(scope="session")
def exported(kiln: RegisterMap) -> str:
    return csv_text([kiln])


@pytest.fixture
def held(kiln: RegisterMap) -> Callable[..., Comparison]:
    """Hold the map against a text of CSV."""

    def compare(table: str | bytes, **options: Any) -> Comparison:
        content = table if isinstance(table, bytes) else table.encode()
        return compare_table(kiln, read(content, "t.csv"), **options)

    return compare
