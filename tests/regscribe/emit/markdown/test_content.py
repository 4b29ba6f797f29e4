"""What the page says about registers, models, arrays, commands and faults."""

from collections.abc import Callable

import pytest

from regscribe.emit.markdown import render
from regscribe.model import RegisterMap

Section = Callable[[str], str]


def test_a_member_that_one_model_has_names_its_model(section: Section) -> None:
    found = section("register-input_type")
    assert "| 1 | K | `K` |  | A1 |" in found
    assert "| 0 | J | `J` |  |  |" in found


def test_a_code_that_the_manual_calls_invalid_is_listed_with_the_reason(section: Section) -> None:
    assert "| 2 | invalid |  | never fitted |  |" in section("register-input_type")


def test_a_long_list_of_values_is_shown_once_and_linked_afterwards(section: Section) -> None:
    assert "| 5 | T | `T` |" in section("register-input_type")
    found = section("register-second_type")
    assert "Values: the same as of [Input Type](#register-input_type)." in found
    assert "| Code |" not in found


def test_a_difference_between_models_is_stated_at_the_register(section: Section) -> None:
    assert "| Range | **A1, A2:** 0 to 3<br>**B1:** 0 to 1 |" in section("register-dp")


def test_what_is_equal_on_all_models_is_said_once_without_model_names(section: Section) -> None:
    found = section("register-setpoint")
    assert "A1" not in found
    assert "| Default | 77.5 |" in found


def test_a_register_that_some_models_lack_says_which_have_it(section: Section, text: str) -> None:
    assert "only A1, A2" in section("register-second_type")
    assert text.count('### <a id="register-second_type"></a>') == 1


def test_an_array_shows_the_formula_and_every_address(section: Section) -> None:
    found = section("register-segments-ramp_time")
    assert "`4200 + 3*(i - 1)`, i = 1 to 4" in found
    assert "<details>" in found
    assert "| `segments[4].ramp_time` | 4209 (0x1071, absolute 44210) |" in found


def test_a_view_with_a_stride_of_its_own_moves_by_it(section: Section) -> None:
    found = section("register-segments-soak_level")
    assert "`8100 + 6*(i - 1)`" in found
    assert "| `segments[2].soak_level` | 53 (0x35, absolute 40054) | 8106 (0x1FAA, absolute 48107) |" in found


def test_the_overview_shows_all_notations_and_views(text: str) -> None:
    assert "| Address | absolute | ieee | Also at | Name | Id | Access | Range | Default | Unit | Models |" in text
    assert "| 1 (0x1) | 40002 | 8002 (0x1F42) |  | [Setpoint](#register-setpoint) | `setpoint` | R/W |" in text
    assert "| 4004 (0xFA4) | 44005 |  | 4100 (0x1004) | [Status](#register-status) |" in text
    assert "| 4200 to 4209 (0x1068 to 0x1071) | 44201 to 44210 |" in text


def test_the_overview_is_ordered_by_address_and_not_by_group(text: str) -> None:
    overview = text[text.index('<a id="overview">') : text.index('<a id="registers">')]
    rows = [overview.index(f"| {address} (") for address in ("1", "2", "4000", "4001", "4004")]

    assert rows == sorted(rows)


def test_scale_by_condition_names_the_condition_and_the_register(section: Section, text: str) -> None:
    assert "| [linear](#condition-linear) | `x/10^dp` |" in section("register-setpoint")
    assert (
        '| <a id="condition-linear"></a>linear | [`input_type`](#register-input_type) is one of linear_inputs |' in text
    )


def test_a_unit_by_condition_is_explained_once(section: Section, text: str) -> None:
    assert "| Unit | °F / °C ([temperature](#unit-temperature)) |" in section("register-setpoint")
    assert '<a id="unit-temperature"></a>temperature' in text


def test_special_values_and_sentinels_are_told_apart(section: Section) -> None:
    assert "| Special values | 0 = off |" in section("register-segments-ramp_time")
    assert "| Faults instead of a value | -32768 = low |" in section("register-value")


def test_bits_name_the_models_that_have_them(section: Section) -> None:
    found = section("register-status")
    assert "| 0 | alarm | `ALARM` |  |" in found
    assert "| 3 | door open | `DOOR_OPEN` | A2 |" in found


def test_dangers_stand_above_the_facts(section: Section) -> None:
    found = section("register-scale_unit")
    assert found.index("> **Danger:** values change") < found.index("| Property |")


def test_commands_show_steps_models_and_danger(section: Section) -> None:
    found = section("command-load_defaults")
    assert "only A1, A2" in found
    assert "> **Danger:** all settings are lost" in found
    assert "| 1 | write | 16 | 7000 (0x1B58, absolute 47001) | 85 92 | 0055 005C |" in found
    assert "wait 2000 ms" in found


def test_arguments_of_a_command_say_how_they_are_sent(section: Section) -> None:
    found = section("command-take")
    assert "| `level` | whole number<br>21 = none |" in found
    assert "uint32, 2 words; word order: least significant word first; `2*x + 1`, x being the stored number" in found
    assert "uint8; the high byte of the word" in found


def test_the_view_sets_give_address_formulas(text: str) -> None:
    assert "| `ieee` (preferred) | `8000 + 2*n` |" in text
    assert "functions 3, 16 only; address and count multiples of 2" in text


def test_faults_are_told_in_words_with_their_code(text: str) -> None:
    assert "| function code that the device does not have | **no answer** |" in text
    assert "| address of no register | exception 02 (bad address) (as Modbus has it; not stated here) |" in text
    assert "the words after the last good one mean nothing" in text


def test_the_quick_start_reads_a_measured_value_and_asks_for_the_givens(text: str) -> None:
    assert "from regscribe_devices.acme.big_oven import AcmeA1\n" in text
    assert 'with AcmeA1.tcp("192.0.2.10", unit=1, linear_inputs=...) as controller:' in text
    assert "controller.value.read()" in text
    assert "async with AsyncAcmeA1.tcp(" in text


@pytest.mark.parametrize("keys", ["danger: it stops", "stays: operation", "governs: address, stays: address"])
def test_the_quick_start_writes_nothing_that_has_consequences(
    keys: str, small: Callable[..., str], model_of: Callable[[str], RegisterMap]
) -> None:
    plain = "at: 1, name: Hours, default: 2, persistence: eeprom"
    text = render(model_of(small(f"at: 0, name: Speed, unit: s, default: 1, {keys}", plain)))[
        "docs/example/controller.md"
    ]

    assert "controller.hours.write(2)" in text
    assert "controller.speed.write(" not in text


def test_limits_line_latency_errata_and_notes_are_there(text: str) -> None:
    for part in (
        "24 to read, 20 to write",
        "5 to 100 ms",
        "9600 baud, 8N1",
        "| 2.1 | \\$1E2 | 4082 |",
        "- All values are",
    ):
        assert part in text


def test_worked_examples_show_words_in_both_bases(text: str) -> None:
    assert "| 20.5 | 21 | 0015 |" in text
    assert "`9C 06 0F A9 00 32 C7 66`" in text
    assert "| 4.17 | 14.17 | 20.5 |" in text


def test_reserved_addresses_and_identification_are_listed(text: str) -> None:
    assert "| Holding registers | 77 to 79 (0x4D to 0x4F) |" in text
    assert "| [`dp`](#register-dp) is 0 | A1 or A2 |" in text
