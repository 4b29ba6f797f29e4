"""Another spelling of the same facts is no change."""

from typing import Any

import pytest

from regscribe.breaking.examples import BASE

CONTROL = """\
      - {at: 1, name: Setpoint, type: int16, decimals: 1, unit: °C, range: 0..400, default: 20, aliases: [901]}
      - {at: 2, name: Mode, enum: modes, default: 0}
"""
FIRST, SECOND = CONTROL.splitlines(keepends=True)
ENUMS = """\
enums:
  modes: {0: stop, 1: heat, 2: cool}
"""
LIBRARY = f"""\
format: 1
library: {{id: acme/common, title: Common}}
{ENUMS}sets:
  limits:
    - {{at: 0, name: Low, type: int16}}
    - {{at: 1, name: High, type: int16}}
"""
SETS = LIBRARY[LIBRARY.index("sets:") :]
DERIVED = """\
format: 1
map: {id: acme/oven, title: Oven, maker: Acme, class_prefix: Acme}
extends: acme/base
manual: {title: Oven manual, number: X1}
models: {M1: {from: M1}, M2: {from: M2, description: with a second loop}}
"""


@pytest.mark.parametrize(
    ("old", "new"),
    [
        (CONTROL, SECOND + FIRST),
        (FIRST, FIRST.replace("at: 1, name: Setpoint, type: int16", "type: int16, name: Setpoint, at: 1")),
        (FIRST, f"      # the setpoint\n{FIRST}"),
        (FIRST, FIRST.replace("at: 1", "at: 0x1")),
        (FIRST, FIRST.replace("0..400", "{from: 0.0, to: 400.00}")),
        (FIRST, FIRST.replace("decimals: 1", "multiply: 0.1")),
        ("{0: stop, 1: heat, 2: cool}", "{2: cool, 1: heat, 0: stop}"),
        ("{0: stop, 1: heat, 2: cool}", "\n    0: stop\n    1: {label: heat}\n    2: cool"),
        ("when: hot", "when: {mode: heat}"),
        ("unit: W, access: r", "access: r, unit: W"),
        ("functions: [3, 6, 16]", "functions: [16, 3, 6]"),
        ("models: [M1, M2]", "models: [M2, M1]"),
        ("description: with a second loop", "description: with  a second loop"),
        ("commands:\n", "commands: # what it does\n"),
        ("flags: {0: running, 1: alarm}", "flags: {1: alarm, 0: running}"),
        ("{product: [total, 2]}", "{product: [2, total]}"),
        ("flags: {0: running, 1: alarm}", "flags: {0: {label: running}, 1: alarm}"),
        (
            "    each: {access: rw, type: int16}\n    registers:\n      - {at: 40",
            "    each: {type: int16, access: rw}\n    registers:\n      - {at: 40",
        ),
    ],
)
def test_another_spelling_is_no_change(old: str, new: str, edited: Any) -> None:
    assert edited(old, new) == []


def test_an_enum_without_a_name_of_its_own_is_another_class_and_the_same_codes(edited: Any) -> None:
    found = edited("enum: modes", "enum: {0: stop, 1: heat, 2: cool}")
    assert [(one.rule.id, one.before, one.after) for one in found] == [
        ("RS0771", "Modes", "none"),
        ("RS0772", "none", "Mode"),
    ]


def test_a_fact_may_move_to_the_each_of_its_group_and_back(edited: Any) -> None:
    found = edited(
        "    each: {access: rw}\n    registers:\n      - {at: 1,",
        "    each: {access: rw, type: int16}\n    registers:\n      - {at: 1,",
        ", type: int16, decimals: 1",
        ", decimals: 1",
        "name: Timer, unit",
        "name: Timer, type: uint16, unit",
        "name: Status, access",
        "name: Status, type: uint16, access",
        "name: Output, range",
        "name: Output, type: uint16, range",
        "name: Mode, enum",
        "name: Mode, type: uint16, enum",
        "name: Bank, stays",
        "name: Bank, type: uint16, stays",
        "name: Fan, models",
        "name: Fan, type: uint16, models",
    )
    assert [(one.rule.id, one.subjects) for one in found] == []


def test_registers_may_move_into_a_set(edited: Any) -> None:
    found = edited(
        CONTROL, "      - {set: front}\n", "sets:\n", f"sets:\n  front:\n{CONTROL.replace('      -', '    -')}"
    )
    assert found == []


def test_a_set_may_be_written_out(edited: Any) -> None:
    whole = "[{at: 100, name: Low, type: int16}, {at: 101, name: High, type: int16}]"
    assert edited("[{set: limits, shift: 100}]", whole, SETS, "") == []


def test_a_map_may_be_split_into_a_library(bench: Any) -> None:
    new = BASE.replace(ENUMS, "").replace(SETS, "").replace("manual:", "uses: [acme/common]\nmanual:")
    assert bench.compared(BASE, new, common=LIBRARY).changes == ()


def test_a_map_may_be_split_into_a_base_and_what_extends_it(bench: Any) -> None:
    base = BASE.replace("acme/oven", "acme/base")
    found = bench.compared(BASE, DERIVED, base=base).changes
    assert [(one.rule.id, one.what, one.before, one.after) for one in found] == []


def test_a_condition_may_get_a_name_and_lose_it(edited: Any) -> None:
    assert (
        edited("  hot: {mode: heat}\n", "  hot: {mode: heat}\n  warm: {mode: heat}\n", "when: hot", "when: warm") == []
    )


def test_a_page_may_come_before_others(edited: Any) -> None:
    first = (
        "  - {id: other, name: Other, source: '4', page: {bank: 2}, registers: [{at: 200, name: Phase, access: r}]}\n"
    )
    found = edited("  - id: paged\n", f"{first}  - id: paged\n")
    assert {one.rule.id for one in found} == {"RS0740", "RS0751"}


def test_codes_of_a_condition_may_stand_in_another_order(bench: Any) -> None:
    old = BASE.replace("hot: {mode: heat}", "hot: {mode: [stop, cool]}")
    assert bench.compared(old, old.replace("[stop, cool]", "[cool, stop]")).changes == ()


def test_a_register_that_counts_twice_is_not_one_that_counts_once(bench: Any) -> None:
    old = BASE.replace("{product: [total, 2]}", "{sum: [total, total]}")
    found = bench.compared(old, BASE.replace("{product: [total, 2]}", "{sum: [total, offset]}")).changes
    assert [(one.rule.id, one.before, one.after) for one in found] == [("RS0756", "total + total", "total + offset")]
