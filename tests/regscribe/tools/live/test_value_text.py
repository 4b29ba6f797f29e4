from contextlib import suppress
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.tools.live import catalogue, value_text
from regscribe_runtime import Choice, Flags, ReadWrite, Register, ValueRefused, WireType, Word, choice, word
from regscribe_runtime.driver.identify import Known

OVEN = catalogue.find("16C").driver.registers
PRESS = catalogue.find("BTC-9100").driver.registers
TIMER = catalogue.find("M300").driver.registers
NAMED = {"enum", "flags", "fields", "boolean"}


def possible(register: Register[Any]) -> list[Any]:
    kind = register.value_type
    if kind.kind == "boolean":
        return [False, True]
    if kind.kind == "fields":
        return [kind.make(code) for code in (0, 0x0101, 0x0303, 0xFFFF)]
    members: Any = kind.special or kind.make
    return [*members, *([members(0), members(0xFFFF)] if issubclass(members, Flags) else [])]


@pytest.mark.parametrize("known", catalogue.models(), ids=catalogue.full_name)
def test_what_is_shown_is_read_back_as_the_same_value(known: Known) -> None:
    named = [one for one in known.driver.registers.values() if one.kind in NAMED or one.value_type.special]
    for register in named:
        for value in possible(register):
            shown = value_text.show(register, value)
            unknown = isinstance(value, Word) and any(isinstance(part, Choice) and not part.known for _, part in value)
            if not unknown:
                assert value_text.parse(register, shown) == value, (register.path, shown)
    assert named


@pytest.mark.parametrize(
    ("text", "value"), [("150.5", 150.5), ("-5", -5), ("+1e2", 100), (".5", 0.5), (77, 77), (150.5, 150.5)]
)
def test_a_number_is_a_number_however_it_is_written(text: Any, value: float) -> None:
    assert value_text.parse(OVEN["setpoint_ram"], text) == value


def test_whole_numbers_may_be_hexadecimal() -> None:
    assert value_text.parse(OVEN["controller_id"], "0x1F") == 31


@pytest.mark.parametrize("text", ["150.5 °F", "150.5°F", "150.5 F", "150.5 degF", "150.5 ℉"])
def test_a_number_may_carry_the_unit_that_the_device_works_in(text: str) -> None:
    assert value_text.parse(OVEN["setpoint_ram"], text, current_unit="°F") == 150.5


@pytest.mark.parametrize(
    ("text", "unit", "current", "said"),
    [
        ("150.5 °C", "", "°F", "given in °C, but the device works in °F"),
        ("150.5", "°C", "°F", "given in °C, but the device works in °F"),
        ("5 s", "", "", "the register has no unit"),
        ("5 °C", "°F", "°F", "which one is meant?"),
        ("5 mS", "", "ms", "given in mS"),
    ],
)
def test_a_value_in_another_unit_is_refused(text: str, unit: str, current: str, said: str) -> None:
    with pytest.raises(ValueRefused) as caught:
        value_text.parse(OVEN["setpoint_ram"], text, unit=unit, current_unit=current)
    assert said in str(caught.value)


@pytest.mark.parametrize("text", ["warm", "", "1..5", "--5", "nan", "1e999", "0.10000000000000000001", [], True])
def test_what_is_no_number_of_use_is_refused(text: Any) -> None:
    with pytest.raises(ValueRefused):
        value_text.parse(OVEN["setpoint_ram"], text)


@pytest.mark.parametrize("text", ["J_THERMOCOUPLE", "j_thermocouple", "J thermocouple", "J", "3", 3])
def test_a_member_is_named_by_its_name_label_first_word_or_code(text: str | int) -> None:
    assert value_text.parse(OVEN["input_type"], text).name == "J_THERMOCOUPLE"


def test_a_member_that_is_none_says_which_was_meant() -> None:
    with pytest.raises(ValueRefused, match="did you mean `J_THERMOCOUPLE`"):
        value_text.parse(OVEN["input_type"], "J_TERMOCOUPLE")


class Range(Choice):
    LOW = 0, "1"
    HIGH = 1, "10"


def test_a_text_that_is_the_code_of_one_member_and_the_label_of_another_is_not_guessed() -> None:
    register = ReadWrite(0, word(WireType.INT16), choice(Range))
    with pytest.raises(ValueRefused, match=r"LOW \(0 1\) or HIGH \(1 10\): write the name"):
        value_text.parse(register, "1")
    assert value_text.parse(register, "10") is Range.HIGH


def test_a_code_that_the_manual_does_not_list_is_shown_and_not_taken() -> None:
    register = OVEN["input_type"]
    assert value_text.show(register, register.value_type.make(99)) == "UNKNOWN_99"
    with pytest.raises(ValueRefused):
        value_text.parse(register, "UNKNOWN_99")


def test_a_special_value_is_named_beside_numbers() -> None:
    register = OVEN["segments[1].ramp_time"]
    assert value_text.parse(register, "disabled").name == "DISABLED"
    assert value_text.parse(register, "12") == 12


def test_flags_are_names_with_commas_and_a_wrong_one_says_which_was_meant() -> None:
    register = TIMER["status"]
    both = value_text.parse(register, "AUTO_TUNE, OUT_OF_RANGE")
    assert (value_text.show(register, both), int(both)) == (["OUT_OF_RANGE", "AUTO_TUNE"], 0xC0)
    assert int(value_text.parse(register, "none")) == 0
    with pytest.raises(ValueRefused, match="did you mean `AUTO_TUNE`"):
        value_text.parse(register, "AUTOTUNE")


def test_bits_without_a_name_are_shown() -> None:
    register = TIMER["status"]
    assert value_text.show(register, register.value_type.make(0x81 | 1 << 9)) == [
        "TIMER_FUNCTION_STATUS",
        "AUTO_TUNE",
        "bit_9",
    ]


def test_fields_are_parts_with_their_values() -> None:
    register = PRESS["mode"]
    shown = value_text.show(register, register.value_type.make(0x0301))
    assert "operation=MANUAL_CONTROL_MODE" in shown  # type: ignore[operator]  # a list of parts
    with pytest.raises(ValueRefused, match="did you mean `operation`"):
        value_text.parse(register, "operatoin=3")


def test_a_version_and_a_text_stay_texts() -> None:
    assert value_text.parse(OVEN["software_version"], "01.31.00") == "01.31.00"
    with pytest.raises(ValueRefused, match="put it in quotes"):
        value_text.parse(OVEN["software_version"], 13100)


def test_for_people_numbers_are_short_and_nothing_set_is_said() -> None:
    assert value_text.as_text(OVEN["setpoint_ram"], 77.0) == "77"
    assert value_text.as_text(OVEN["setpoint_ram"], 1099511627777.0) == "1099511627777"
    assert value_text.as_text(OVEN["setpoint_ram"], 1234567890123.4) == "1234567890123.4"
    assert value_text.as_text(OVEN["setpoint_ram"], 1e300) == "1e+300"
    assert value_text.as_text(TIMER["status"], TIMER["status"].value_type.make(0)) == "none"


@given(
    st.sampled_from([*OVEN.values(), *PRESS.values(), *TIMER.values()]),
    st.text() | st.floats() | st.integers() | st.lists(st.text()),
)
def test_any_text_or_number_is_a_value_or_refused(register: Register[Any], plain: Any) -> None:
    with suppress(ValueRefused):
        value_text.parse(register, plain)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_number_of_use_is_read_as_it_is_shown(number: float) -> None:
    shown = value_text.show(OVEN["setpoint_ram"], number)
    assert value_text.parse(OVEN["setpoint_ram"], str(shown)) == number


@pytest.mark.parametrize(
    "text", ["1e5000", "1e+5000", "1_0", "1_0 °C", "1,5", "1 000", "1.2.3", "0x" + 501 * "1", "12'000"]
)
def test_what_is_no_number_of_use_is_not_taken_for_a_unit(text: str) -> None:
    for name in ("setpoint_ram", "input_filter"):
        with pytest.raises(ValueRefused) as refused:
            value_text.parse(OVEN[name], text)
        assert f"`{text[:60]}` is no number of use: they look like 1500, 150.5, 2e-7 or 0x1F" in str(refused.value)
