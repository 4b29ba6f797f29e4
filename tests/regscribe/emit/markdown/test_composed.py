"""What a page says of a base, of enum columns, of codes as printed, of unused addresses and of functions alike."""

from collections.abc import Callable
from pathlib import Path

import pytest

from regscribe.emit.markdown import render
from regscribe.model import RegisterMap

BASE = """\
format: 1
map: {id: acme/base, title: Base, maker: Acme, class_prefix: Base}
manual: {title: Base Manual, number: B-1}
models: {B1: {}, B2: {}}
protocol:
  functions: [1, 2, 3, 4, 6, 16]
  alike: [[1, 2], [3, 4]]
  latency: {3: {fixed: 5..6, characters: 3, note: longer | while it saves}}
  faults: {unused_write: 7}
  exceptions: {7: {name: refused, meaning: no such thing}}
enums:
  timer:
    columns: [launch, op3_status]
    0: {cells: [by key, "OFF"]}
    1: {cells: [at | once, "ON"], label: at once, description: the fast one}
    2: {invalid: never fitted}
groups:
  - id: main
    name: Main
    source: "4.1"
    each: {access: rw}
    registers:
      - {at: 0, name: Setpoint, symbol: S.P. 1, printed: "5P.1", default: 5}
      - {at: 1, name: Hysteresis, symbol: HY, printed: HY}
      - {at: 2, name: Timer, enum: timer}
      - {at: 3, name: Third}
      - {id: steps, name: Step, repeat: 1..2, stride: 1, registers: [{at: 10, name: "Step {i} Time", symbol: "t{i}"}]}
unused: [{at: 16..28}, {at: 5, space: coil, models: [B2]}]
errata: [{where: 4.1, printed: a, read: b, why: c}]
"""

EXTENSION = """\
format: 1
map: {id: other/own, title: Own, maker: Other, class_prefix: Own}
extends: acme/base
models: {O1: {from: B1}, O2: {from: B2}}
drop: {registers: [{id: third, reason: not | printed}], errata: all}
override:
  - {register: setpoint, reason: another <table>, set: {default: 6, description: a | b}}
  - {enum: timer, reason: no such, set: {2: null}}
"""


@pytest.fixture(scope="module")
def base_page(tmp_path_factory: pytest.TempPathFactory, load: Callable[[Path], RegisterMap]) -> str:
    path = tmp_path_factory.mktemp("maps") / "acme" / "base.yaml"
    path.parent.mkdir()
    path.write_text(BASE)
    return render(load(path))["docs/acme/base.md"]


@pytest.fixture(scope="module")
def own_page(tmp_path_factory: pytest.TempPathFactory, load: Callable[[Path], RegisterMap]) -> str:
    folder = tmp_path_factory.mktemp("maps")
    for name, text in (("acme/base.yaml", BASE), ("other/own.yaml", EXTENSION)):
        (folder / name).parent.mkdir()
        (folder / name).write_text(text)
    return render(load(folder / "other" / "own.yaml"))["docs/other/own.md"]


def test_cells_stand_under_the_heads_of_their_columns(base_page: str) -> None:
    assert "| Code | Meaning | In Python | launch | op3 status | Remark |" in base_page
    assert "| 0 |  | `BY_KEY_OFF` | by key | OFF |  |" in base_page
    assert "| 1 | at once | `AT_ONCE` | at &#124; once | ON | the fast one |" in base_page.replace("\\|", "&#124;")
    assert "| 2 | invalid |  |  |  | never fitted |" in base_page


def test_a_code_as_printed_is_shown_where_the_reading_differs(base_page: str) -> None:
    assert "S.P. 1 (printed 5P.1)" in base_page
    assert "printed HY" not in base_page


def test_an_array_is_named_once_for_all_elements(base_page: str) -> None:
    assert "</a>Step {i} Time\n" in base_page
    assert "Step 1 Time" not in base_page


def test_functions_that_do_the_same_are_named(base_page: str) -> None:
    assert "| Functions that do the same | 01 and 02; 03 and 04 |" in base_page


def test_a_latency_says_its_characters_and_its_remark(base_page: str) -> None:
    row = next(line for line in base_page.splitlines() if line.startswith("| 03 read holding registers | 5 to 6 ms"))
    assert "| 3 |" in row
    assert "while it saves" in row


def test_unused_addresses_are_listed_with_their_models_and_the_answer_to_a_write(base_page: str) -> None:
    listed = base_page.split("Listed as unused by the manual")[1].split('<a id="registers">', maxsplit=1)[0]
    assert "| Holding registers | 16 to 28 (0x10 to 0x1C) |  |" in listed
    assert "| Coils | 5 (0x5) | B2 |" in listed
    assert "| write to an address listed as unused | exception 07 (refused) |" in base_page


def test_a_map_that_stands_alone_has_no_differences(base_page: str) -> None:
    assert "#differences" not in base_page


def test_differences_from_the_base_are_listed_with_their_reasons(own_page: str) -> None:
    listed = own_page.split('<a id="differences">')[1].split("\n## ", maxsplit=1)[0]
    assert "[acme/base](../acme/base.md)" in listed
    rows = [line for line in listed.splitlines() if line.startswith("| ")][2:]
    assert len(rows) == 4
    assert rows[0].startswith("| register `third` | is not there | not \\| printed |")
    assert rows[1].startswith("| errata | not taken over |")
    assert rows[2].startswith("| register [`setpoint`](#register-setpoint) | default: 5 -&gt; 6<br>other description |")
    assert rows[2].endswith("| another &lt;table&gt; |")
    assert rows[3].startswith("| enum `timer` | 2: ")


def test_an_extension_says_what_it_inherits_like_any_map(own_page: str) -> None:
    assert "S.P. 1 (printed 5P.1)" in own_page
    assert "| Coils | 5 (0x5) | O2 |" in own_page
