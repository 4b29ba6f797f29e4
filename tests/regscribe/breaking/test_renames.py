"""What was renamed is one change, whoever refers to it; what cannot be proven stays two."""

from typing import Any

from regscribe.breaking.examples import BASE
from regscribe.breaking.renames import Renames


def told(found: Any) -> list[tuple[str, tuple[str, ...], str, str]]:
    return [(one.rule.id, one.subjects, one.before, one.after) for one in found]


def test_who_refers_to_a_renamed_register_does_not_change(edited: Any) -> None:
    found = edited(
        "name: Mode, enum",
        "id: state, name: Mode, enum",
        "hot: {mode: heat}",
        "hot: {state: heat}",
        "name: Total,",
        "id: sum, name: Total,",
        "[total, 2]",
        "[sum, 2]",
        "name: Power,",
        "id: watts, name: Power,",
        "value: power",
        "value: watts",
    )
    assert told(found) == [
        ("RS0742", ("state",), "mode", "state"),
        ("RS0742", ("watts",), "power", "watts"),
        ("RS0742", ("sum",), "total", "sum"),
    ]


def test_a_renamed_selector_of_a_page_leaves_the_page_as_it_is(edited: Any) -> None:
    found = edited("name: Bank", "name: Shelf", "page: {bank: 3}", "page: {shelf: 3}", "{bank: 0..5}", "{shelf: 0..5}")
    assert told(found) == [("RS0742", ("shelf",), "bank", "shelf")]


def test_a_renamed_array_is_one_change(edited: Any) -> None:
    found = edited("id: zones\n        name: Zone", "id: areas\n        name: Zone")
    assert told(found) == [("RS0742", ("areas[].low", "areas[].high"), "zones[]", "areas[]")]
    assert len(found[0].registers) == 8


def test_a_renamed_member_of_an_array_is_one_change(edited: Any) -> None:
    found = edited("{at: 1, name: High, type: int16}", "{at: 1, name: Top, type: int16}")
    assert told(found) == [("RS0742", ("zones[].top",), "zones[].high", "zones[].top")]


def test_a_renamed_array_of_a_program_leaves_the_program_as_it_is(edited: Any) -> None:
    found = edited("id: segments\n", "id: steps\n", "{array: segments,", "{array: steps,")
    assert told(found) == [("RS0742", ("steps[].target", "steps[].time"), "segments[]", "steps[]")]


def test_a_renamed_command_leaves_who_names_it_as_it_is(bench: Any) -> None:
    old = BASE.replace("name: Offset,", "name: Offset, apply: restart,")
    new = old.replace("  restart: {", "  reboot: {").replace("apply: restart", "apply: reboot")
    assert told(bench.compared(old, new).changes) == [("RS0753", ("reboot",), "restart", "reboot")]


def test_a_renamed_group_does_not_move_its_registers(edited: Any) -> None:
    found = edited("  - id: paged\n    name: Paged", "  - id: leaves\n    name: Paged")
    assert told(found) == [("RS0753", ("leaves",), "paged", "leaves")]


def test_a_renamed_register_is_the_same_in_examples_effects_and_identification(bench: Any) -> None:
    old = BASE.replace("words: [85]}]", "words: [85]}], effects: [{set: {mode: 0}}]").replace(
        "{bank: 0..5}", "{mode: 0..1}"
    )
    old = old.replace("words: [200]", "with: {mode: 1}, words: [200]").replace("hot: {mode: heat}", "hot: {mode: 1}")
    new = old.replace("name: Mode", "name: State").replace("{mode:", "{state:")
    found = bench.compared(old, new).changes
    assert told(found) == [("RS0742", ("state",), "mode", "state")]


def test_a_text_that_is_as_a_renamed_path_stays_a_text(bench: Any) -> None:
    old = BASE.replace("{when: {bank: 0..5}, models", "{text: {serial: mode}, models")
    new = old.replace("name: Mode, enum", "name: State, enum").replace("hot: {mode: heat}", "hot: {state: heat}")
    assert told(bench.compared(old, new).changes) == [("RS0742", ("state",), "mode", "state")]


def test_a_renamed_given_does_not_change_what_depends_on_it(edited: Any) -> None:
    found = edited("  ratio: {type", "  turns: {type", "{given: ratio}", "{given: turns}")
    assert told(found) == [("RS0753", ("turns",), "ratio", "turns")]


def test_a_renamed_block_does_not_move_its_registers(edited: Any) -> None:
    found = edited("  inverter: {chain", "  pump: {chain", "    block: inverter", "    block: pump")
    assert told(found) == [("RS0753", ("pump",), "inverter", "pump")]


def test_a_renamed_flag_is_found_by_its_bit(edited: Any) -> None:
    assert told(edited("1: alarm}", "1: {label: alarm, id: alert}}")) == [("RS0753", ("status",), "alarm", "alert")]


def test_a_moved_and_renamed_register_is_found_by_its_name(edited: Any) -> None:
    found = edited("at: 13, name: Offset", "at: 15, id: shift, name: Offset")
    assert told(found) == [
        ("RS0701", ("shift",), "holding 13", "holding 15"),
        ("RS0742", ("shift",), "offset", "shift"),
    ]


def test_a_register_that_is_renamed_and_changed_is_not_guessed(edited: Any) -> None:
    found = edited("name: Offset, type: int16", "name: Gain, type: int16, unit: s")
    assert told(found) == [
        ("RS0741", ("offset",), "at holding 13", "none"),
        ("RS0740", ("gain",), "none", "at holding 13"),
        ("RS0744", ("gain",), "offset at holding 13", "gain at holding 13"),
    ]


def test_two_alike_registers_that_go_are_not_taken_for_two_that_come(bench: Any) -> None:
    def version(*registers: tuple[int, str]) -> str:
        lines = [f"      - {{at: {at}, id: {name}, name: Spare}}\n" for at, name in registers]
        return BASE.replace("      - {at: 22, name: Bank", f"{''.join(lines)}      - {{at: 22, name: Bank")

    found = bench.compared(version((30, "a"), (31, "b")), version((32, "c"), (33, "d"))).changes
    assert sorted(one.rule.id for one in found) == ["RS0740", "RS0740", "RS0741", "RS0741"]
    (moved, renamed) = bench.compared(version((30, "a")), version((32, "c"))).changes
    assert (moved.rule.id, renamed.rule.id) == ("RS0701", "RS0742")


def test_models_under_other_names_are_found_by_their_registers(edited: Any) -> None:
    names = "      - {at: 23, name: Fan, models: [M2]}\n"
    found = edited(
        "{M1: {}, M2: {",
        "{N1: {}, N2: {",
        "[M1, M2]",
        "[N1, N2]",
        "model: M1",
        "model: N1",
        names,
        names.replace("M2", "N2"),
    )
    renamed = [(one.before, one.after) for one in found if one.rule.id == "RS0747"]
    assert sorted(renamed) == [("M1", "N1"), ("M2", "N2")]


def test_registers_that_swap_their_addresses_both_moved(edited: Any) -> None:
    found = edited("at: 3, name: Power", "at: 13, name: Power", "at: 13, name: Offset", "at: 3, name: Offset")
    assert told(found) == [
        ("RS0701", ("power",), "holding 3", "holding 13"),
        ("RS0701", ("offset",), "holding 13", "holding 3"),
    ]


def test_paths_of_the_other_elements_follow_an_array_that_was_renamed_as_a_whole() -> None:
    renames = Renames().with_paths({"zones[1].low": "areas[1].low", "status.alarm": "status.alert"})
    assert renames.path("zones[{i}].low") == "areas[{i}].low"
    assert renames.path("zones[].low") == "areas[].low"
    assert renames.path("status.alarm") == "status.alert"
    assert renames.path("zones[1].low.part") == "areas[1].low.part"
    assert renames.path("zones[1].high") == "zones[1].high"


def test_paths_of_the_other_elements_stay_where_one_left_its_array() -> None:
    renames = Renames().with_paths({"zones[1].low": "first_low"})
    assert (renames.path("zones[1].low"), renames.path("zones[2].low")) == ("first_low", "zones[2].low")


def test_what_else_differs_of_a_renamed_register_is_told(edited: Any) -> None:
    found = edited("name: Offset, type: int16", "name: Shift, description: It is added., type: int16")
    assert [(one.rule.id, one.what) for one in found] == [("RS0742", "path"), ("RS0773", "description")]


def test_another_name_of_the_same_id_is_a_text(edited: Any) -> None:
    found = edited("name: Offset", "id: offset, name: Offset of the sensor")
    assert told(found) == [("RS0773", ("offset",), '"Offset"', '"Offset of the sensor"')]


def test_a_register_that_was_renamed_in_a_group_that_moved_is_found_where_it_moved_to(bench: Any) -> None:
    old = BASE.replace("unit: V}]", "unit: V}, {at: 201, name: First, access: r}, {at: 202, name: Second, access: r}]")
    new = old.replace("at: 200, name: Voltage", "at: 250, name: Voltage").replace(
        "at: 201, name: First", "at: 251, name: One"
    )
    new = new.replace("at: 202, name: Second", "at: 252, name: Two")
    found = bench.compared(old, new).changes
    assert sorted(told(found)) == [
        ("RS0701", ("voltage", "one", "two"), "holding 200 to 202", "holding 250 to 252 (each +50)"),
        ("RS0742", ("one",), "first", "one"),
        ("RS0742", ("two",), "second", "two"),
    ]
