"""Facts of the Platinum controllers with setpoint programs (M5000, X100, X400, X5000), each as a sentence.

Names, codes and states are held to the tables' JBUS columns, with each place where the map mends them.
"""

import csv
import re
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest

from regscribe.model import Kind, Model, Register, RegisterMap, Space
from regscribe.pipeline import compile_map

ATHENA = Path(__file__).parents[2] / "maps" / "athena"
TABLES = ["platinum-m5000", "platinum-x100-x400", "platinum-x5000"]

RENAMED = {
    "platinum-m5000": {39, 124, 200, 201},  # "shoot"; release code; segment F, whose names are shifted
    "platinum-x100-x400": {27, 47},  # "satrt", "Strat-up"
    "platinum-x5000": {122, 124, *range(404, 453)},  # bytes for words; "Prog. 3" for the fourth program
}
"""JBUS addresses of words whose names the maps mend (errata)."""

TWO_TEXTS = {("platinum-x100-x400", Space.COIL, 1)}
"""Remote or program: one bit with two texts."""

RECODED = {("platinum-m5000", 189)}
"""Codes that the maps mend (errata): 5P11 without its point."""


@cache
def _map(name: str) -> RegisterMap:
    compiled = compile_map(ATHENA / f"{name}.yaml")
    assert compiled.map is not None, [f"{each.span.line}: {each.message}" for each in compiled.diagnostics]
    return compiled.map


def _model(name: str) -> Model:
    return _map(name).models[0]


def _codes(name: str, path: str) -> dict[int, str]:
    enum = _model(name).register(path).enum
    assert enum is not None
    return {member.code: member.label for member in enum.members}


def _address(name: str, path: str) -> int:
    return _model(name).register(path).address


@cache
def _named(name: str) -> list[tuple[int, dict[str, str], Register]]:
    known = {(each.base.space, each.address + 1): each for each in _model(name).registers}
    with (ATHENA / f"{name}.jbus.csv").open(newline="", encoding="utf-8") as file:
        rows = [each for each in csv.DictReader(file) if each["space"] != Space.STATUS and each["name"] != "-"]
    places = [(Space(each["space"]), int(each["jbus_address"].partition("..")[0])) for each in rows]
    return [(place[1], row, known[place]) for place, row in zip(places, rows, strict=True) if place in known]


def _normalised(text: str) -> str:
    return re.sub(r"[^a-z0-9]", "", text.lower())


@pytest.mark.parametrize("name", TABLES)
def test_names_begin_as_the_tables_print_them(name: str) -> None:
    for jbus, row, register in _named(name):
        if (name, register.base.space, jbus) not in TWO_TEXTS and not (
            register.base.space is Space.HOLDING and jbus in RENAMED[name]
        ):
            assert _normalised(row["name"]).startswith(_normalised(register.name)), register.path


@pytest.mark.parametrize("name", TABLES)
def test_codes_are_what_the_tables_print(name: str) -> None:
    for jbus, row, register in _named(name):
        if (name, jbus) not in RECODED:
            printed = (register.printed or register.symbol).replace(" ", "")
            assert printed == row["code"].replace(" ", ""), register.path


@pytest.mark.parametrize("name", TABLES)
def test_states_are_what_the_tables_print_beside_the_name(name: str) -> None:
    for jbus, row, register in _named(name):
        states = re.findall(r"\b(\d) ?= ?([A-Za-z]+(?: [a-z]+)?)", row["name"])
        if states and (name, register.base.space, jbus) not in TWO_TEXTS:
            assert register.enum is not None, register.path
            assert [(str(member.code), member.label) for member in register.enum.members] == states


@pytest.mark.parametrize("name", TABLES)
def test_bits_of_the_status_are_those_that_its_table_names(name: str) -> None:
    with (ATHENA / f"{name}.jbus.csv").open(newline="", encoding="utf-8") as file:
        rows = [each for each in csv.DictReader(file) if each["space"] == Space.STATUS]
    printed = [(int(row["jbus_address"]), row["name"].partition(" (")[0]) for row in rows]
    for model in _map(name).models:
        assert [(bit.low + 1, bit.label) for bit in model.register("status").fields] == printed


def test_run_is_2_and_hold_1_but_on_the_x5000_it_is_the_other_way_round() -> None:
    others = [_codes("platinum-m5000", "program_status"), _codes("platinum-x100-x400", "program_status")]
    assert [(codes[1], codes[2]) for codes in others] == [("Hold", "Run")] * 2
    codes = _codes("platinum-x5000", "running_program_status")
    assert (codes[1], codes[2]) == ("Run", "Hold")


def test_the_m5000_disables_its_keys_by_1_where_the_others_lock_them_by_0() -> None:
    assert _codes("platinum-m5000", "keys_enable") == {0: "Enabled", 1: "Disabled"}
    locks = [_codes(name, "keypad_lock") for name in ("platinum-x100-x400", "platinum-x5000")]
    assert locks == [{0: "locked", 1: "unlocked"}] * 2


def test_thermocouples_k_and_l_change_places_between_m5000_and_x5000() -> None:
    m5000, x5000 = _codes("platinum-m5000", "input_configuration"), _codes("platinum-x5000", "input_type")
    assert ((m5000[1], m5000[2]), (x5000[1], x5000[2])) == (("TC L", "TC K"), ("TC K", "TC L"))


def test_an_output_of_a_segment_has_a_table_of_its_own_in_each_chapter() -> None:
    tables = [
        _codes("platinum-m5000", "segments[0].digital_output"),
        _codes("platinum-x100-x400", "segments[0].digital_output"),
        _codes("platinum-x5000", "programs[1].segments[0].op3_digital_output"),
    ]
    assert tables == [
        {0: "OFF", 1: "Open", 2: "Close"},
        {0: "No action", 1: "Open", 2: "Closed"},
        {0: "Closed", 1: "Open", 2: "disabled"},
    ]


def test_the_m5000_has_one_program_of_15_segments_of_three_words_and_a_final_one_of_two() -> None:
    for segment in range(15):
        words = [_address("platinum-m5000", f"segments[{segment}].{part}") for part in ("time", "setpoint")]
        words.append(_address("platinum-m5000", f"segments[{segment}].digital_output"))
        assert words == [154 + 3 * segment, 155 + 3 * segment, 156 + 3 * segment]
    final = [_address("platinum-m5000", part) for part in ("final_setpoint", "final_digital_output")]
    assert final == [199, 200]


def test_the_x100_has_seven_segments_and_an_end() -> None:
    times = [_address("platinum-x100-x400", f"segments[{segment}].time") for segment in range(7)]
    assert times == [70, 73, 76, 79, 82, 85, 88]
    assert _address("platinum-x100-x400", "end_setpoint") == 91
    assert _address("platinum-x100-x400", "end_digital_output") == 92


def test_the_x5000_has_four_programs_of_68_words_with_15_segments_of_four() -> None:
    parts = ("time", "setpoint", "op3_digital_output", "op4_digital_output")
    for program in range(1, 5):
        first = 180 + 68 * (program - 1)
        assert _address("platinum-x5000", f"programs[{program}].power_failure") == first
        for segment in range(15):
            path = f"programs[{program}].segments[{segment}]"
            words = [_address("platinum-x5000", f"{path}.{part}") for part in parts]
            assert words == [first + 5 + 4 * segment + word for word in range(4)]
        assert _address("platinum-x5000", f"programs[{program}].final_op4_digital_output") == first + 67


def test_the_last_word_of_the_x5000_is_451() -> None:
    assert max(register.base.last(register.at) for register in _model("platinum-x5000").registers) == 451


def test_the_local_setpoint_stands_twice_on_m5000_and_x5000() -> None:
    for name in ("platinum-m5000", "platinum-x5000"):
        assert (_address(name, "local_setpoint_3"), _address(name, "local_setpoint")) == (3, 4)


@pytest.mark.parametrize("name", TABLES)
def test_the_output_can_be_written_in_manual_mode_only(name: str) -> None:
    writable = _model(name).register("main_output").writable
    assert writable is not None
    (test,) = writable.when.tests
    assert (_address(name, test.subject), test.codes[0][0]) == (1, Fraction(1))


def test_only_the_x100_and_x400_need_55aah_and_only_for_seven_words() -> None:
    applied = {name: [each.address for each in _model(name).registers if each.apply] for name in TABLES}
    assert applied == {"platinum-m5000": [], "platinum-x100-x400": [*range(100, 107)], "platinum-x5000": []}
    (command,) = _model("platinum-x100-x400").commands
    assert [(step.address, step.words) for step in command.steps] == [(120, (0x55AA,))]
    assert not _model("platinum-m5000").commands
    assert not _model("platinum-x5000").commands


def test_the_product_code_tells_an_x100_from_an_x400() -> None:
    texts = {model: dict(each.identity.texts) for each in _map("platinum-x100-x400").identity for model in each.models}
    assert texts == {"X100": {"product_code": "X1"}, "X400": {"product_code": "X3"}}


@pytest.mark.parametrize("name", TABLES)
def test_a_word_of_a_code_holds_its_second_character_in_the_high_byte(name: str) -> None:
    for path in ("product_code", "release_code"):
        code = _model(name).register(path)
        assert (code.kind, code.base.words, code.base.byte_order.value) == (Kind.STRING, 2, "little")


def test_a_timer_action_says_launch_output_and_unit() -> None:
    enum = _model("platinum-x100-x400").register("timer_action").enum
    assert enum is not None
    assert enum.columns == ("launch", "op3_status", "time_unit")
    assert enum.members[6].cells == ("Key + at power on", "OFF", "Minute")


def test_a_heat_cool_control_of_the_x5000_has_a_medium_in_the_column_of_the_action() -> None:
    enum = _model("platinum-x5000").register("control_type").enum
    assert enum is not None
    assert [member.cells for member in enum.members[5:7]] == [
        ("Valve drive P.I.D.", "Reverse"),
        ("Heat/Cool", "Linear"),
    ]


def test_the_safety_output_of_the_m5000_is_off_at_101() -> None:
    output = _model("platinum-m5000").register("safety_output")
    (interval,) = output.range[0].then.intervals
    assert (interval.low, interval.high) == (Fraction(-100), Fraction(100))
    assert [(special.code, special.label) for special in output.specials] == [(Fraction(101), "OFF")]


@pytest.mark.parametrize("name", TABLES)
def test_cycles_and_segments_have_inferred_limits_and_say_so(name: str) -> None:
    counted = [each for each in _model(name).registers if each.symbol in {"Cyc.", "n.Seg"}]
    assert counted
    assert all(each.inferred for each in counted)


@pytest.mark.parametrize("name", TABLES)
def test_a_raw_number_has_no_range(name: str) -> None:
    assert not [each.path for each in _model(name).registers if each.kind is Kind.RAW and each.range]


def test_the_x7000_has_no_map_and_the_map_of_the_x5000_says_so() -> None:
    assert any("X7000" in note for note in _map("platinum-x5000").notes)
    assert not list(ATHENA.glob("*x7000*"))
