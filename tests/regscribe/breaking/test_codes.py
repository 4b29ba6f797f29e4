"""Codes whose meaning depends on a case or a condition, special values and faults."""

from typing import Any

import pytest

from regscribe.breaking.change import Effect, Effects
from regscribe.breaking.examples import BASE

N, C, H, B = Effect
SPOT = "      - {at: 22, name: Bank"
BY_CASE = "[{when: {mode: heat}, is: {0: low, 1: full}}, {is: {0: fan, 1: auto}}]"


def with_line(line: str) -> str:
    return BASE.replace(SPOT, f"      - {{at: 300, name: Extra, {line}}}\n{SPOT}")


def told(bench: Any, old: str, new: str) -> list[tuple[str, str, Effects]]:
    found = bench.compared(with_line(old), with_line(new)).changes
    return [(one.rule.id, one.what, one.effects) for one in found if one.rule.id not in {"RS0771", "RS0772"}]


def test_a_code_of_one_case_is_compared_with_that_of_the_same_case(bench: Any) -> None:
    new = BY_CASE.replace("1: full}", "1: full, 2: boost}")
    assert told(bench, f"enum: {BY_CASE}", f"enum: {new}") == [("RS0717", "code", Effects(N, H))]


def test_cases_under_other_conditions_give_the_codes_another_meaning(bench: Any) -> None:
    new = BY_CASE.replace("{mode: heat}", "{mode: cool}")
    found = told(bench, f"enum: {BY_CASE}", f"enum: {new}")
    assert found == [("RS0720", "cases of the codes", Effects(H, B))]


def test_codes_that_depend_on_a_case_from_now_on_have_another_meaning(bench: Any) -> None:
    found = told(bench, "enum: {0: low, 1: full}", f"enum: {BY_CASE}")
    assert found == [("RS0720", "cases of the codes", Effects(H, B))]


def test_numbers_that_get_codes_are_values_of_another_kind(bench: Any) -> None:
    assert told(bench, "access: r", "access: r, enum: {0: low, 1: full}") == [
        ("RS0710", "kind of value", Effects(N, B))
    ]


def test_a_name_at_another_code_has_another_meaning(bench: Any) -> None:
    found = told(bench, "enum: {0: low, 1: full}", "enum: {0: low, 2: full}")
    assert found == [("RS0720", "code of FULL", Effects(B, N))]


def test_a_code_that_takes_over_a_name_has_another_meaning(bench: Any) -> None:
    found = told(bench, "enum: {0: low, 1: full}", "enum: {0: full, 1: top}")
    assert found == [
        ("RS0720", "name of code 0", Effects(B, B)),
        ("RS0720", "name of code 1", Effects(B, B)),
    ]


def test_a_code_with_another_name_is_told_with_its_number_once(bench: Any) -> None:
    found = bench.compared(with_line("enum: {0: low, 1: full}"), with_line("enum: {0: low, 1: top}")).changes
    (change,) = (one for one in found if one.rule.id == "RS0719")
    assert (change.what, change.before, change.after) == ("name of code 1", 'FULL "full"', 'TOP "top"')


@pytest.mark.parametrize(
    ("old", "new", "rule", "effects"),
    [
        ("special: {0: off}", "special: {0: off, 1: auto}", "RS0721", Effects(N, C)),
        ("special: {0: off}", "special: {0: {label: off, means: 9}}", "RS0721", Effects(N, B)),
        ("special: {0: off}", "special: {0: idle}", "RS0721", Effects(N, B)),
        ("special: {0: off}", 'special: {0: {label: switched off, id: "OFF"}}', "RS0773", Effects(N, N)),
    ],
)
def test_special_values(old: str, new: str, rule: str, effects: Effects, bench: Any) -> None:
    (found,) = [one for one in told(bench, f"range: 5..9, {old}", f"range: 5..9, {new}") if one[0] == rule]
    assert found[2] == effects


@pytest.mark.parametrize(
    ("old", "new", "rules"),
    [
        ("sentinels: {9: broken}", "sentinels: {8: broken}", ["RS0723", "RS0722"]),
        ("sentinels: {9: broken}", "sentinels: {9: cut}", ["RS0719", "RS0773"]),
        ("sentinels: {9: broken}", "sentinels: {9: {label: a broken wire, id: broken}}", ["RS0773"]),
    ],
)
def test_faults(old: str, new: str, rules: list[str], bench: Any) -> None:
    assert sorted(one[0] for one in told(bench, f"access: r, {old}", f"access: r, {new}")) == sorted(rules)


def test_another_label_of_the_same_name_is_a_text(bench: Any) -> None:
    found = told(bench, "enum: {0: low}", "enum: {0: {label: lowest, id: LOW}}")
    assert found == [("RS0773", "label of code 0", Effects(N, N))]


def test_what_else_differs_of_a_renamed_code_is_told(bench: Any) -> None:
    found = told(bench, "enum: {0: low}", "enum: {0: {label: least, description: a third}}")
    assert sorted(one[:2] for one in found) == [("RS0719", "name of code 0"), ("RS0773", "description of code 0")]
