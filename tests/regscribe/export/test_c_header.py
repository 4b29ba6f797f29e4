"""C headers: constants of C99 and C++11 that say what the map says, and texts that cannot break out of a comment."""

import re
from collections.abc import Callable

import pytest

from regscribe.export.c_header.spelling import literal, remark, signed, unsigned
from regscribe.losses import Exported

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Lost = Callable[[Exported], set[tuple[str, str, str]]]
DEFINE = re.compile(r"^#define (\w+)(\(\w[^)]*\))? (.+?)(?: /\*.*)?$", re.MULTILINE)


@pytest.fixture
def constants(exported_text: Text, small: Small) -> Callable[..., dict[str, str]]:
    """The constants of the registers by name without the prefix, as they are spelled."""

    def found(*registers: str, **more: str) -> dict[str, str]:
        text = exported_text("c-header", small(*registers, **more))
        assert text.count("\n") > 10
        return {name.removeprefix("EXAMPLEA1_"): value for name, _, value in DEFINE.findall(text)}

    return found


def test_a_register_has_address_words_space_type_order_and_access(constants: Callable[..., dict[str, str]]) -> None:
    found = constants("at: 9, name: Level, type: int32, word_order: little, access: r")
    assert {name: found[f"LEVEL_{name}"] for name in ("ADDR", "WORDS", "SPACE", "TYPE", "ORDER", "ACCESS")} == {
        "ADDR": "9u",
        "WORDS": "2u",
        "SPACE": "EXAMPLEA1_SPACE_HOLDING",
        "TYPE": "EXAMPLEA1_TYPE_INT32",
        "ORDER": "EXAMPLEA1_ORDER_CDAB",
        "ACCESS": "1u",
    }


def test_a_record_of_a_file_has_its_number_there_and_that_of_the_file(constants: Callable[..., dict[str, str]]) -> None:
    found = constants(
        "at: 7, name: Record, space: file, file: 4, access: r", top="protocol: {functions: [3, 6, 16, 20]}"
    )
    assert (found["RECORD_ADDR"], found["RECORD_FILE"]) == ("7u", "4u")


def test_a_value_of_a_queue_has_its_place_there_and_the_address_of_the_queue(
    constants: Callable[..., dict[str, str]],
) -> None:
    top = "protocol: {functions: [3, 6, 16, 24]}"
    found = constants("at: 1, name: Event, space: queue, queue: 1246, access: r", top=top)
    assert (found["EVENT_ADDR"], found["EVENT_QUEUE"]) == ("1u", "1246u")


def test_codes_that_want_the_name_of_an_order_or_a_type_get_another(exported_text: Text, small: Small) -> None:
    rows = ("at: 0, name: Order, enum: {5: ABCD, 6: middle}", "at: 1, name: Type, enum: {7: int16}")
    text = exported_text("c-header", small(*rows))
    assert "#define EXAMPLEA1_ORDER_ABCD 0u" in text
    assert "    EXAMPLEA1_ORDER_ABCD_2 = 5, /* ABCD */" in text
    assert "    EXAMPLEA1_ORDER_MIDDLE = 6 /* middle */" in text
    assert "    EXAMPLEA1_TYPE_INT16_2 = 7 /* int16 */" in text


def test_a_scale_is_an_exact_ratio_of_whole_numbers(constants: Callable[..., dict[str, str]]) -> None:
    found = constants("at: 0, name: Third, divide: 3, add: -0.25")
    keys = ("SCALE_NUM", "SCALE_DEN", "OFFSET_NUM", "OFFSET_DEN")
    assert [found[f"THIRD_{key}"] for key in keys] == ["1", "3", "(-1)", "4"]


def test_a_number_whose_scale_is_not_stated_has_none(exported_text: Text, small: Small) -> None:
    text = exported_text("c-header", small("at: 0, name: Raw, decimals: not_stated"))
    assert "RAW_SCALE" not in text
    assert "the manual does not state its scale" in text


def test_the_scale_of_another_register_stands_in_a_comment_and_is_a_loss_that_may_be_wrong(
    export: Export, small: Small, lost: Lost
) -> None:
    top = "decimals: {d: {register: dp}}"
    registers = ("at: 0, name: DP, range: 0..3, default: 1", "at: 1, name: Value, decimals: d")
    made = export("c-header", small(*registers, top=top))
    assert " * fixed for the device as stated: its scale depends on dp */" in str(made.texts[""])
    assert "#define EXAMPLEA1_VALUE_SCALE_DEN 10\n" in made.texts[""]
    assert ("value", "scale-register", "WRONG") in lost(made)


def test_the_ends_of_a_range_are_numbers_on_the_wire_that_lie_within(constants: Callable[..., dict[str, str]]) -> None:
    found = constants("at: 0, name: Level, multiply: 0.3, range: -1..1")
    assert (found["LEVEL_RAW_MIN"], found["LEVEL_RAW_MAX"]) == ("(-3)", "3")


def test_the_ends_of_a_falling_scale_are_turned_round(constants: Callable[..., dict[str, str]]) -> None:
    found = constants("at: 0, name: Level, multiply: -0.5, range: 0..10")
    assert (found["LEVEL_RAW_MIN"], found["LEVEL_RAW_MAX"]) == ("(-20)", "0")


def test_an_open_limit_is_told_and_not_guessed(export: Export, small: Small, lost: Lost) -> None:
    made = export("c-header", small("at: 0, name: Level, range: {from: {open: sensor limit}, to: 10}"))
    assert "LEVEL_RAW" not in made.texts[""]
    assert ("level", "range", "LOST") in lost(made)


@pytest.mark.parametrize(
    ("number", "spelled"),
    [
        (5, "5"),
        (-5, "(-5)"),
        (2147483647, "2147483647"),
        (-2147483647, "(-2147483647)"),
        (-2147483648, "(-2147483647 - 1)"),
        (2147483648, "INT64_C(2147483648)"),
        (-2147483649, "(-INT64_C(2147483649))"),
        (-9223372036854775808, "(-INT64_C(9223372036854775807) - 1)"),
        (18446744073709551615, "UINT64_C(18446744073709551615)"),
    ],
)
def test_whole_numbers_are_constants_of_their_width(number: int, spelled: str) -> None:
    assert signed(number) == spelled


@pytest.mark.parametrize(
    ("number", "spelled"),
    [(0x8000, "0x8000u"), (0x10000, "UINT32_C(0x10000)"), (1 << 63, "UINT64_C(0x8000000000000000)")],
)
def test_masks_are_unsigned(number: int, spelled: str) -> None:
    assert unsigned(number, hexadecimal=True) == spelled


def test_flags_are_masks_and_parts_are_masks_with_a_shift(constants: Callable[..., dict[str, str]]) -> None:
    found = constants(
        "at: 0, name: Status, type: uint16, flags: {0: heating, 15: alarm}",
        "at: 1, name: Parts, type: uint16, fields: {zone: {bits: 4..6}}",
    )
    assert (found["STATUS_HEATING_MASK"], found["STATUS_ALARM_MASK"]) == ("0x0001u", "0x8000u")
    assert (found["PARTS_ZONE_MASK"], found["PARTS_ZONE_SHIFT"]) == ("0x0070u", "4u")


def test_a_word_beyond_64_bits_is_left_out_and_told(export: Export, small: Small, lost: Lost) -> None:
    made = export("c-header", small("at: 0, name: A", "at: 10, name: Alarms, length: 5, flags: {0: low, 64: far}"))
    assert "ALARMS" not in made.texts[""]
    assert ("alarms", "register", "LOST") in lost(made)


def test_codes_are_an_enum_with_their_values(exported_text: Text, small: Small) -> None:
    text = exported_text("c-header", small("at: 0, name: Trend, enum: {-1: falling, 0: steady}"))
    assert "enum examplea1_trend {\n    EXAMPLEA1_TREND_FALLING = (-1), /* falling */\n" in text
    assert "    EXAMPLEA1_TREND_STEADY = 0 /* steady */\n};\n" in text
    assert "typedef enum examplea1_trend examplea1_trend_code;" in text


def test_codes_beyond_an_int_are_constants(constants: Callable[..., dict[str, str]]) -> None:
    found = constants("at: 0, name: Mode, type: uint32, enum: {0: off, 4294967295: all}")
    assert (found["MODE_OFF"], found["MODE_ALL"]) == ("0", "INT64_C(4294967295)")


def test_an_enum_of_several_registers_is_written_once(exported_text: Text, small: Small) -> None:
    top = "enums: {on_off: {0: off, 1: on}}"
    text = exported_text("c-header", small("at: 0, name: A, enum: on_off", "at: 1, name: B, enum: on_off", top=top))
    assert text.count("enum examplea1_on_off {") == 1
    assert "typedef enum examplea1_on_off examplea1_b_code;" in text


def test_faults_are_numbers_on_the_wire(constants: Callable[..., dict[str, str]]) -> None:
    found = constants(
        "at: 0, name: Level, decimals: 1, sentinels: {-32768: broken, 32760..32767: range}",
        "at: 1, name: Flow, type: float32, sentinels: {nan: absent, -9999.9: off}",
    )
    assert found["LEVEL_FAULT_BROKEN"] == "(-32768)"
    assert (found["LEVEL_FAULT_RANGE_MIN"], found["LEVEL_FAULT_RANGE_MAX"]) == ("32760", "32767")
    assert found["FLOW_FAULT_ABSENT_IS_NAN"] == "1"


def test_a_special_value_is_the_number_on_the_wire(constants: Callable[..., dict[str, str]]) -> None:
    assert constants("at: 0, name: Delay, decimals: 1, range: 1..9, special: {0.5: auto}")["DELAY_SPECIAL_AUTO"] == "5"


def test_registers_of_an_array_are_one_macro_with_an_index(constants: Callable[..., dict[str, str]]) -> None:
    found = constants(
        "id: loops, name: Loop, repeat: 1..3, stride: 10, "
        "registers: [{at: 5, name: Value, type: uint32}, {at: 7, name: Gain}]"
    )
    assert found["LOOPS_VALUE_ADDR"] == "(5u + 10u * ((unsigned)(i) - 1u))"
    assert (found["LOOPS_VALUE_FIRST"], found["LOOPS_VALUE_LAST"]) == ("1u", "3u")
    assert found["LOOPS_GAIN_ADDR"] == "(7u + 10u * ((unsigned)(i) - 1u))"


def test_some_elements_alone_stand_for_themselves(exported_text: Text, small: Small) -> None:
    array = "id: loops, name: Loop, repeat: 1..3, stride: 10, registers: [{at: 5, name: Value}, {at: 7, name: Gain}]"
    text = exported_text("c-header", small(array), register="loops[1].value\nloops[3].value")
    assert "#define EXAMPLEA1_LOOPS_1_VALUE_ADDR 5u\n" in text
    assert "#define EXAMPLEA1_LOOPS_3_VALUE_ADDR 25u\n" in text


def test_names_that_collide_get_a_number(exported_text: Text, small: Small) -> None:
    text = exported_text("c-header", small("at: 0, name: Mode, enum: {0: Addr, 1: on}", "at: 1, name: Mode Addr"))
    names = re.findall(r"^(?:#define |    )(EXAMPLEA1_MODE\w*)", text, re.MULTILINE)
    assert len(names) == len(set(names))
    assert "    EXAMPLEA1_MODE_ADDR_2 = 0, /* Addr */" in text


def test_what_exists_under_a_condition_is_in_the_header_with_it(export: Export, small: Small, lost: Lost) -> None:
    made = export("c-header", small("at: 0, name: Mode, default: 0", "at: 1, name: Extra, when: {mode: 1}"))
    assert " * exists only while mode is 1 */\n#define EXAMPLEA1_EXTRA_ADDR 1u\n" in made.texts[""]
    assert ("extra", "condition", "LOST") in lost(made)


@pytest.mark.parametrize(
    ("text", "harmless"),
    [
        ("ends */ here", "ends * / here"),
        ("opens /* here", "opens / * here"),
        ("what??/", "what? ?/"),
        ("a????b", "a? ? ? ?b"),
        ("goes on \\", "goes on"),
        ("two\nlines", "two lines"),
        ("turned \u202e", "turned \\u202e"),
        ("/*/", "/ * /"),
    ],
)
def test_a_comment_stays_one(text: str, harmless: str) -> None:
    made = remark(text)
    assert made == harmless
    assert not re.search(r"\*/|/\*|\?\?|\\$|\n", made)


def test_a_text_is_ascii_with_octal_escapes() -> None:
    assert literal('°C "a" \\ ??/') == '"\\302\\260C \\042a\\042 \\134 \\077\\077/"'


def test_the_header_says_of_which_map_it_is_and_is_the_same_every_time(exported_text: Text, small: Small) -> None:
    one, other = (exported_text("c-header", small("at: 0, name: A")) for _ in range(2))
    assert one == other
    assert one.splitlines()[1] == " * Controller, model A1, map example/controller"
    assert "#ifndef EXAMPLEA1_H\n#define EXAMPLEA1_H\n" in one
