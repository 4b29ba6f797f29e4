from collections.abc import Callable
from typing import Any

Vectors = Callable[..., Any]

LINEAR = """\
    givens:
      linear_inputs: {type: codes, register: kind, description: linear kinds, reason: stands elsewhere}
    scales:
      process:
        - {when: {kind: {not_in: linear_inputs}}, from: -1999.9, to: 4553.6}
        - {when: [{kind: {in: linear_inputs}}, {dp: 0}], from: -19999, to: 45536}
        - {when: [{kind: {in: linear_inputs}}, {dp: 2}], from: -199.99, to: 455.36}
    """


def test_each_case_of_a_scale_is_tried_and_one_where_none_holds(vectors_of: Vectors) -> None:
    lines = """
    - {at: 1, id: sp, name: SP, type: uint16, scale: process}
    - {at: 2, id: kind, name: Kind}
    - {at: 3, id: dp, name: DP, range: 0..3}
    """
    found = vectors_of(lines, tables=LINEAR)
    lowest = {one["value"] for one in found.vectors("sp", "decode") if one["words"] == [0] and "value" in one}
    assert lowest == {"-1999.9", "-19999", "-199.99"}
    assert any(one.get("outcome") == "not_decodable" for one in found.vectors("sp", "decode"))
    assert "condition" in found.reasons("sp").values()
    assert all(case["givens"] == {"linear_inputs": ["1"]} for case in found.cases("sp"))


def test_both_ends_of_a_condition_what_lies_beside_and_the_ends_of_the_type_are_tried(vectors_of: Vectors) -> None:
    lines = """
    - {at: 1, id: sp, name: SP, range: [{when: {kind: 3..5}, is: 0..10}, {is: 0..20}]}
    - {at: 2, id: kind, name: Kind, type: uint16}
    """
    found = vectors_of(lines)
    limits = {kind: "20" in found.words("sp", kind=kind) or "11" in found.words("sp", kind=kind) for kind in "03"}
    states = {case["state"]["kind"] for case in found.cases("sp")}
    assert states == {"0", "2", "3", "5", "6", "65535"}
    assert limits["0"] is True
    assert limits["3"] is False


def test_each_number_of_decimals_is_tried(vectors_of: Vectors) -> None:
    lines = "- {at: 1, id: sp, name: SP, decimals: digits}\n- {at: 3, id: places, name: Places, range: 0..3}"
    found = vectors_of(lines, tables="decimals: {digits: {register: places}}\n")
    found_values = {places: found.values("sp", places=places)[32767,] for places in "0123"}
    assert found_values == {"0": "32767", "1": "3276.7", "2": "327.67", "3": "32.767"}


def test_more_decimals_than_the_rule_takes_count_as_its_most(vectors_of: Vectors) -> None:
    lines = "- {at: 1, id: sp, name: SP, decimals: digits}\n- {at: 3, id: places, name: Places}"
    found = vectors_of(lines, tables="decimals: {digits: {register: places, at_most: 2}}\n")
    assert next(iter(found.values("sp", places="3").items())) == ((9029,), "90.29")


def test_limits_in_other_registers_are_given_a_value_and_tried_on_both_sides(vectors_of: Vectors) -> None:
    lines = """
    - {at: 1, id: sp, name: SP, range: {from: low, to: high}}
    - {at: 2, id: low, name: Low}
    - {at: 3, id: high, name: High}
    """
    found = vectors_of(lines)
    state = next(found.cases("sp"))["state"]
    low, high = int(state["low"]), int(state["high"])
    assert low < high
    assert {str(low), str(high)} <= set(found.words("sp"))
    assert {str(low - 1), str(high + 1)} <= set(found.reasons("sp"))


def test_an_open_limit_refuses_nothing_on_its_side(vectors_of: Vectors) -> None:
    found = vectors_of("- {at: 1, id: sp, name: SP, range: {from: 0, to: {open: sensor limit}}}")
    assert found.words("sp")["32767"] == [32767]
    assert found.reasons("sp")["-1"] == "range"


def test_a_condition_of_writing_is_told_with_the_word_that_holds_the_field(vectors_of: Vectors) -> None:
    lines = """
    - {at: 1, id: output, name: Output, writable: {when: {mode.operation: manual}, reason: only by hand}}
    - at: 2
      id: mode
      name: Mode
      type: uint16
      fields: {operation: {bits: 8..11, label: operation, enum: {0: normal, 3: manual}}}
    """
    writable = vectors_of(lines).set_of("output")["writable"]
    assert {one["state"]["mode"]: one["allowed"] for one in writable} == {"0": False, "768": True}


def test_a_boolean_given_is_tried_both_ways(vectors_of: Vectors) -> None:
    tables = """\
    givens: {cooled: {type: boolean, description: has a cooler, reason: stands elsewhere}}
    """
    lines = "- {at: 1, id: sp, name: SP, range: [{when: {given: cooled}, is: -50..50}, {is: 0..50}]}"
    cases = vectors_of(lines, tables=tables).set_of("sp")["cases"]
    low = {case["givens"]["cooled"]: case["domain"][0]["low"] for case in cases}
    assert low == {True: "-50", False: "0"}
