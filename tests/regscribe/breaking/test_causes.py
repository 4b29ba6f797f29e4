"""One cause is one change, at its definition, with all that it affects."""

from typing import Any

from regscribe.breaking.examples import BASE
from regscribe.breaking.report import sentence


def told(found: Any) -> list[tuple[str, str]]:
    return [(one.rule.id, sentence(one)) for one in found]


def test_a_group_that_moved_is_one_change_with_the_first_and_the_last_address(edited: Any) -> None:
    found = edited("at: 3, name: Power", "at: 503, name: Power", "at: 4, name: Total", "at: 504, name: Total")
    words = "address holding 3 to 5 -> holding 503 to 505 (each +500) (affects 2 registers of 2 models)"
    assert told(found) == [("RS0701", f"`power` and `total`: {words}")]


def test_registers_that_moved_by_different_distances_are_different_changes(edited: Any) -> None:
    found = edited("at: 3, name: Power", "at: 503, name: Power", "at: 4, name: Total", "at: 505, name: Total")
    assert [one.after for one in found] == ["holding 503", "holding 505"]


def test_views_move_with_their_register(edited: Any) -> None:
    found = edited("at: 20, name: Level", "at: 25, name: Level")
    assert told(found) == [("RS0701", "`level`: address holding 20 -> holding 25 (on 2 models)")]


def test_a_view_may_move_alone(edited: Any) -> None:
    found = edited("offset: 8000", "offset: 9000")
    assert told(found) == [("RS0701", "`level`: address of view `ieee` holding 8040 -> holding 9040 (on 2 models)")]


def test_a_view_set_with_another_stride_is_one_change_for_all_its_registers(bench: Any) -> None:
    old = BASE.replace(
        "      - {at: 22, name: Bank", "      - {at: 21, name: Depth, views: both}\n      - {at: 22, name: Bank"
    )
    (found,) = bench.compared(old, old.replace("stride: 2, type: float32", "stride: 4, type: float32")).changes
    assert (found.before, found.after) == ("holding 8040 to 8043", "holding 8080 to 8085")


def test_elements_of_an_array_move_where_a_view_has_another_stride(bench: Any) -> None:
    old = BASE.replace(
        "registers: [{at: 50, name: Target}", "registers: [{at: 0, name: Phase, views: both}, {at: 50, name: Target}"
    )
    old = old.replace(
        "type: int16}\n    registers:\n      - {at: 40, name: Start",
        "stays: operation}\n    registers:\n      - {at: 40, name: Start",
    )
    old = old.replace("views:\n", "views:\n  far:\n    base: {offset: 500, type: int16}\n").replace(
        "views: both}, {at: 50", "views: far}, {at: 50"
    )
    (found,) = bench.compared(
        old, old.replace("{offset: 500, type: int16}", "{offset: 500, stride: 3, type: int16}")
    ).changes
    assert (found.rule.id, found.before, found.after) == ("RS0701", "holding 502 to 504", "holding 506 to 512")


def test_aliases_that_move_with_their_register_are_no_change_of_their_own(edited: Any) -> None:
    found = edited("at: 1, name: Setpoint", "at: 30, name: Setpoint", "[901]", "[930]")
    assert told(found) == [("RS0701", "`setpoint`: address holding 1 -> holding 30 (on 2 models)")]


def test_aliases_that_stay_where_they_are_are_no_change(edited: Any) -> None:
    assert [one.rule.id for one in edited("at: 1, name: Setpoint", "at: 30, name: Setpoint")] == ["RS0701"]


def test_a_wider_array_is_one_change(edited: Any) -> None:
    found = edited("repeat: 1..4", "repeat: 1..6")
    assert told(found) == [
        ("RS0708", "`zones[]`: number of elements 4 elements -> 6 elements (affects 12 registers of 2 models)")
    ]


def test_an_array_with_another_stride_is_one_change(edited: Any) -> None:
    found = edited("stride: 2\n        registers: [{set", "stride: 3\n        registers: [{set")
    assert told(found) == [("RS0708", "`zones[]`: stride 2 steps -> 3 steps (affects 8 registers of 2 models)")]


def test_an_array_that_moved_is_one_change(edited: Any) -> None:
    (found,) = edited("shift: 100", "shift: 110")
    assert (found.rule.id, found.before, found.after) == (
        "RS0701",
        "holding 100 to 107",
        "holding 110 to 117 (each +10)",
    )
    assert found.subjects == ("zones[].low", "zones[].high")


def test_an_array_may_move_and_get_another_stride(edited: Any) -> None:
    found = edited(
        "shift: 100", "shift: 110", "stride: 2\n        registers: [{set", "stride: 3\n        registers: [{set"
    )
    assert [(one.rule.id, one.what) for one in found] == [("RS0701", "address"), ("RS0708", "stride")]


def test_a_change_in_the_each_of_a_group_is_one_change(edited: Any) -> None:
    (found,) = edited(
        '    source: "10"\n    each: {access: rw, type: int16}',
        '    source: "10"\n    each: {access: rw, type: int16, danger: it heats}',
    )
    assert found.rule.id == "RS0733"
    assert found.subjects == ("start", "segments[].target", "segments[].time")


def test_a_set_that_changed_is_one_change_wherever_it_is_used(bench: Any) -> None:
    more = """\
  - id: more
    name: More
    source: "7"
    each: {access: rw}
    registers:
      - {id: further, name: Zone, repeat: 1..2, stride: 2, registers: [{set: limits, shift: 300}]}
commands:
"""
    old = BASE.replace("commands:\n", more)
    new = old.replace("name: Low, type: int16", "name: Low, type: int16, unit: s")
    (found,) = bench.compared(old, new).changes
    assert (found.rule.id, found.subjects, len(found.registers)) == ("RS0712", ("zones[].low", "further[].low"), 6)


def test_an_enum_that_changed_stands_at_its_definition(edited: Any) -> None:
    (found,) = edited("2: cool}", "2: cool, 3: dry}", "at: 13, name: Offset,", "at: 13, name: Offset,")
    assert (found.rule.id, found.place.line, found.place.column) == ("RS0717", 21, 3)


def test_a_group_that_is_gone_takes_its_registers_with_it_in_one_change(edited: Any) -> None:
    whole = BASE[BASE.index("  - id: program\n") : BASE.index("commands:\n")]
    program = BASE[BASE.index("programs:\n") : BASE.index("identify:\n")]
    found = edited(whole, "", program, "")
    assert sorted((one.rule.id, one.what, one.before) for one in found) == [
        ("RS0741", "registers of a group", "group `program`"),
        ("RS0752", "group", "program"),
        ("RS0752", "program", "recipe"),
        ("RS0771", "names of the driver module", "AsyncSegment, Segment, Start"),
    ]


def test_a_condition_that_changed_is_one_change(edited: Any) -> None:
    found = edited(
        "name: Fan, models", "name: Fan, when: hot, models", "hot: {mode: heat}", "hot: {mode: [heat, cool]}"
    )
    ids = [(one.rule.id, one.subjects, one.what) for one in found]
    assert ids == [("RS0732", ("hot",), "condition `hot`"), ("RS0732", ("fan",), "condition of existence")]


def test_a_change_on_one_model_names_that_model(edited: Any) -> None:
    (found,) = edited("name: Fan, models", "name: Fan, unit: rpm, models")
    assert (found.rule.id, found.models) == ("RS0712", ("M2",))


def test_a_view_set_that_changed_is_one_change_in_all_groups(bench: Any) -> None:
    old = BASE.replace(
        "      - {at: 40, name: Start", "      - {at: 42, name: Depth, views: both}\n      - {at: 40, name: Start"
    )
    old = old.replace('source: "10"\n    each: {access: rw, type: int16}', 'source: "10"\n    each: {access: rw}')
    (found,) = bench.compared(old, old.replace("type: float32}", "type: float32, preferred: true}")).changes
    assert (found.rule.id, found.subjects) == ("RS0706", ("level", "depth"))


def test_a_scale_rule_that_changed_is_one_change_in_all_groups(bench: Any) -> None:
    old = BASE.replace("chains:\n", "scales: {tenths: [{decimals: 1}]}\nchains:\n")
    old = old.replace("name: Offset, type: int16", "name: Offset, type: int16, scale: tenths")
    old = old.replace("name: Target}", "name: Target, scale: tenths}")
    (found,) = bench.compared(old, old.replace("[{decimals: 1}]", "[{decimals: 2}]")).changes
    assert (found.rule.id, found.subjects) == ("RS0711", ("offset", "segments[].target"))


def test_a_condition_that_only_commands_use_is_told_too(bench: Any) -> None:
    old = BASE.replace("when: hot, ", "").replace("words: [85]}]", "words: [85]}], when: hot")
    (found,) = bench.compared(old, old.replace("hot: {mode: heat}", "hot: {mode: cool}")).changes
    assert (found.rule.id, found.subjects, found.registers) == ("RS0732", ("hot",), ())
