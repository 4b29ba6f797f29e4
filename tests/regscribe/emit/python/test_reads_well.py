"""Shipped drivers are short and name their constants after what they come from."""

import ast
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from regscribe.emit import python
from regscribe.pipeline import compile_map

ROOT = Path(__file__).parents[4]
DRIVERS = sorted(path for path in (ROOT / "generated/regscribe_devices").glob("*/*.py") if path.stem != "__init__")
DECLARED = {"ReadOnly", "ReadWrite", "WriteOnly"}
MOST_LINES = 3.0
"""Lines of a declaration and its docstring, on average over all maps."""
MOST_OF_ONE_MAP = 3.5
WIDTH = 120


def parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def declarations(module: ast.Module) -> Iterator[tuple[ast.Assign, int]]:
    """The declarations of registers with their lines, docstring included."""
    for owner in (node for node in ast.walk(module) if isinstance(node, ast.ClassDef)):
        for node, following in zip(owner.body, [*owner.body[1:], None], strict=True):
            if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call):
                documented = following if isinstance(following, ast.Expr) else node
                if isinstance(node.value.func, ast.Name) and node.value.func.id in DECLARED:
                    yield node, (documented.end_lineno or 0) - node.lineno + 1


@pytest.fixture
def rendered(tmp_path: Path) -> Callable[[str], str]:
    """The driver of a map."""

    def render(text: str) -> str:
        path = tmp_path / "named.yaml"
        path.write_text(text, encoding="utf-8")
        found = compile_map(path)
        assert found.map is not None, found.diagnostics
        (code,) = python.render(found.map).values()
        return code

    return render


def test_a_register_takes_three_lines_on_average() -> None:
    lines = {path.stem: [count for _, count in declarations(parsed(path))] for path in DRIVERS}
    means = {name: sum(counts) / len(counts) for name, counts in lines.items() if counts}
    every = [count for counts in lines.values() for count in counts]
    assert len(every) > 900
    assert sum(every) / len(every) <= MOST_LINES, means
    assert max(means.values()) <= MOST_OF_ONE_MAP, means


@pytest.mark.parametrize("path", DRIVERS, ids=lambda path: path.stem)
def test_no_line_is_too_long(path: Path) -> None:
    assert [line for line in path.read_text(encoding="utf-8").splitlines() if len(line) > WIDTH] == []


@pytest.mark.parametrize("path", DRIVERS, ids=lambda path: path.stem)
def test_constants_bear_names_and_not_numbers(path: Path) -> None:
    """What a map names has its name; else it is `_<REGISTER>_<USE>`."""
    code = path.read_text(encoding="utf-8")
    constants = re.findall(r"^_([A-Z0-9_]+)(?:: [^=]+)? = ", code, re.MULTILINE)
    used = "RANGE|SCALE|UNIT|DANGER|GOVERNS|SENTINELS|WRITABLE|VIEWS"
    assert [name for name in constants if re.fullmatch(rf"({used})(_\d+)?|.*_({used})_\d+", name)] == []
    members = set(re.findall(r"^    (\w+) = ", code, re.MULTILINE))
    made = [name.lower() for name in constants if re.fullmatch(rf".*_({used})", name)]
    assert [name for name in made if not any(name.startswith((f"{one}_", f"_{one}_")) for one in members)] == []


def test_groups_refer_to_registers_that_stand_before_them() -> None:
    for path in DRIVERS:
        for call in (node for node in ast.walk(parsed(path)) if isinstance(node, ast.Call)):
            if isinstance(call.func, ast.Name) and call.func.id == "Group":
                assert all(isinstance(member, ast.Attribute) for member in call.args[1:]), (path.stem, call.lineno)


MAP = """\
format: 1
map: {id: test/named, title: Named, maker: Acme, class_prefix: Named}
manual: {title: Manual}
models: {One: {}, Two: {}}
conditions: {running: {mode: 1}}
decimals: {tenths: {register: places, when: running}}
units: {heat: [{when: running, symbol: °C}, {symbol: °F}]}
views:
  both: {base: {type: int16}, ieee: {type: float32, offset: 1000, stride: 2, functions: [3]}}
groups:
  - id: main
    name: Main
    source: "1.1"
    each: {access: rw}
    registers:
      - {at: 0, name: Mode, enum: {0: idle, 1: run}}
      - {at: 1, name: Places, type: int16, range: 0..3}
      - at: 10
        name: Ramp
        views: both
        decimals: tenths
        unit: heat
        range: [{when: running, is: 0..5}, {is: 0..9}]
      - {at: 11, name: Level, symbol: Lvl, type: int16, range: [{when: running, is: 0..5}, {is: 0..9}]}
      - at: 12
        name: Limit
        type: int16
        variants:
          - {models: [One], range: [{when: running, is: 0..1}, {is: 0..2}]}
          - {models: [Two], range: [{when: running, is: 0..3}, {is: 0..4}]}
"""


def test_constants_are_called_after_the_rule_or_the_first_register(rendered: Callable[[str], str]) -> None:
    code = rendered(MAP)
    assert "ramp = ReadWrite(10, _BOTH, number, scale=_TENTHS, range=_RAMP_RANGE, unit=_HEAT" in code
    assert "level = ReadWrite(11, _INT16, integer, range=_RAMP_RANGE" in code
    assert "range=_LIMIT_RANGE," in code
    assert "range=_LIMIT_RANGE_TWO," in code
    assert "(_RUNNING, " in code.partition("_RAMP_RANGE = ")[2]


def test_a_docstring_says_more_than_the_name(rendered: Callable[[str], str]) -> None:
    code = rendered(MAP)
    assert '"""Level (Lvl): 1.1."""' in code
    assert '"""Places: 0 to 3; 1.1."""' in code
    assert '"""Mode' not in code.partition("class _Named:")[2]


OFFSET = """\
      - at: {at}
        name: Calibration offset {at}
        type: int16
        default: {at}
        danger: a wrong value makes every later measurement wrong
        stays: calibration
        persistence: eeprom
        endurance: 100
"""


def test_long_declarations_of_a_group_unpack_what_they_have_in_common(rendered: Callable[[str], str]) -> None:
    code = rendered(MAP + OFFSET.format(at=20) + OFFSET.format(at=21))
    assert "    calibration_offset_20 = ReadWrite(20, _INT16, integer, default=20, **_MAIN)\n" in code
    assert "_MAIN: dict[str, Any] = {" in code
    assert "from typing import Any" in code


CLASHING = """\
      - id: pid
        name: PID
        repeat: 1..2
        stride: 10
        registers:
          - {at: 30, name: Gain, type: int16, decimals: pid}
          - {at: 31, name: Share, type: int16, decimals: protocol}
"""


def test_no_constant_takes_the_name_of_a_class_or_of_the_protocol(rendered: Callable[[str], str]) -> None:
    rules = "decimals: {pid: {register: places}, protocol: {register: places, at_most: 2}, "
    code = rendered(MAP.replace("decimals: {", rules, 1) + CLASHING)
    defined = re.findall(r"^(?:class )?(\w+)(?: = |[(:])", code, re.MULTILINE)
    assert sorted(set(defined)) == sorted(defined)
    assert "scale=_PID_SCALE" in code
    assert "scale=_PROTOCOL_SCALE" in code
