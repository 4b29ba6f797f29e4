"""Templates of Wiren Board; expected values follow from the documentation of wb-mqtt-serial, by hand."""

from collections.abc import Callable
from fractions import Fraction

import pytest

from regscribe.importers.wiren_board import likeness
from regscribe.importers.wiren_board.conditions import ConditionError, Reference, condition_of
from regscribe.plugins import Likeness

from .conftest import Import

TEMPLATE = """\
// a template with comments, as some have
{
  "device_type": "OVEN",
  "device": {
    "name": "oven_name", "id": "oven", "max_read_registers": 20, "response_timeout_ms": 500,
    "groups": [{"title": "Readings", "id": "g1"}],
    "translations": {"en": {"oven_name": "Oven 3", "mode_title": "Mode"}, "ru": {"oven_name": "Печь"}},
    "parameters": {
      "mode": {"title": "mode_title", "address": 30, "enum": [0, 1, 2], "enum_titles": ["off", "heat", "fan"]},
      "in1_count": {"title": "Inputs", "default": 2},
      "unused": {"title": "Nobody asks"}
    },
    "setup": [{"title": "Enable", "address": "0x40", "value": 1}],
    "channels": [
      {"name": "Temperature", "group": "g1", "reg_type": "input", "address": 1, "type": "temperature",
       "format": "s16", "scale": 0.1, "offset": -40, "error_value": "0x8000", "round_to": 0.5},
      {"name": "Energy", "reg_type": "input", "address": 2, "format": "u32", "word_order": "little_endian"},
      {"name": "Flow", "reg_type": "input", "address": 4, "format": "float", "byte_order": "little_endian",
       "error_value": "0x7FC00000", "unsupported_value": "0x3F800000"},
      {"name": "Wide", "reg_type": "input", "address": 6, "format": "u64"},
      {"name": "Setpoint", "reg_type": "holding", "address": 10, "min": 5, "max": 30.5, "scale": 0.1,
       "write_address": 12},
      {"name": "Single", "reg_type": "holding_single", "address": 13, "readonly": false, "read_period_ms": 1500},
      {"name": "Low nibble", "reg_type": "holding", "address": "0x14:0:4", "readonly": true},
      {"name": "Bit 7", "reg_type": "holding", "address": "20:7:1", "readonly": true},
      {"name": "Heater", "reg_type": "coil", "address": 5, "type": "switch", "condition": "mode==1"},
      {"name": "Fan level", "reg_type": "holding", "address": 21, "condition": "mode!=1&&(mode>1||in1_count>=2)"},
      {"name": "Level", "reg_type": "holding", "address": 22, "condition": "isDefined(mode)&&mode!=0"},
      {"name": "Reset", "reg_type": "coil", "address": 6, "type": "pushbutton"},
      {"name": "Serial", "reg_type": "input", "address": 50, "format": "string", "string_data_size": 3},
      {"name": "Name", "reg_type": "input", "address": 53, "format": "string8", "string_data_size": 2},
      {"name": "Digits", "reg_type": "input", "address": 55, "format": "bcd16"},
      {"name": "Strange", "reg_type": "input", "address": 56, "format": "bcd24"},
      {"name": "Mode again", "reg_type": "holding", "address": 30},
      {"name": "Other", "device_type": "X", "id": "o"},
      {"name": "Obis", "reg_type": "holding", "address": "1.0.1.8.0.255"}
    ]
  }
}
"""


def test_a_value_is_the_scaled_number_and_the_offset(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    assert found.value("temperature", 0xFF38) == Fraction("-60")
    assert found.value("temperature", 0x8000) == "fault"
    assert found.register("temperature").unit[0].then == "°C"
    assert found.value("energy", 2, 1) == 65538
    assert found.value("digits", 0x1234) == 1234


def test_an_error_value_is_a_pattern(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    assert found.value("flow", 0xC07F, 0) == "fault"  # NaN, the bytes of each word turned
    assert found.value("flow", 0x803F, 0) == "fault"  # 1.0 is what is not supported
    assert found.value("flow", 0x4841, 0) == Fraction("12.5")


def test_a_part_of_a_word_has_its_bits(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    assert found.bits("word_holding_20") == {"Low nibble": (0, 3), "Bit 7": (7, 7)}


def test_how_it_is_written(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    setpoint = found.register("setpoint")
    assert (setpoint.address, setpoint.views[1].address(setpoint.at)) == (10, 12)
    assert "range: 5..30.5" in found.text
    assert set(found.register("single").base.functions) == {3, 6}
    assert found.register("single").reading.poll == Fraction("1.5")
    assert found.register("reset").stays == "momentary"
    assert found.register("temperature").access == "r"
    assert found.map.protocol.read_words == 20


def test_a_condition_asks_the_register_that_a_parameter_is(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    assert "when: {mode: 1}" in found.text
    assert "isDefined" in found.left_out["Level"]


def test_a_condition_over_a_setting_asks_a_given(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    (given,) = found.map.givens
    assert (given.id, given.default, given.description) == ("in1_count", 2, "Inputs")
    assert "given.in1_count: {from: 2}" in found.text


def test_texts_have_one_or_two_characters_a_word(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    assert found.value("serial", 0x0041, 0x0042, 0x0043) == "ABC"
    assert found.value("name", 0x4142, 0x4344) == "ABCD"


def test_texts_keep_the_order_of_their_words_and_bytes(imported: Import) -> None:
    texts = """{"device_type": "A", "device": {"name": "A", "channels": [
      {"name": "Turned", "address": 1, "format": "string8", "string_data_size": 2, "byte_order": "little_endian"},
      {"name": "Last", "address": 3, "format": "string8", "string_data_size": 2, "word_order": "little_endian"},
      {"name": "High", "address": 5, "format": "string", "string_data_size": 2, "byte_order": "little_endian"}
    ]}}"""
    found = imported("wiren-board", texts)
    assert found.value("turned", 0x4241, 0x4443) == "ABCD"
    assert found.value("last", 0x4344, 0x4142) == "ABCD"
    assert found.value("high", 0x4100, 0x4200) == "AB"


def test_names_and_groups_are_those_in_english(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    assert found.draft.title == "Oven 3"
    assert found.members("mode") == {0: "off", 1: "heat", 2: "fan"}
    assert [group.name for group in found.map.models[0].groups][:2] == ["Parameters", "Readings"]


def test_what_is_left_out_or_said_again_is_told(imported: Import) -> None:
    found = imported("wiren-board", TEMPLATE)
    assert {*found.left_out} == {"Level", "Strange", "Other", "Obis"}
    assert (found.codes("Mode again"), found.outcomes["Mode again"]) == (["same-register"], "whole")
    assert found.codes("Enable") == ["setup-value"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('{"device_type": "a", "device": {% for i in x %}{}{% endfor %}}', "1: a template of Jinja (`{%`)"),
        ('{\n"a": "{{ x }}"}', "2: a template of Jinja (`{{`)"),
        ("{}", "there is no `device`"),
        ('{"device": {"protocol": "dlms"}}', "the device speaks dlms"),
        ('{"device": {', "no JSON"),
    ],
)
def test_what_is_no_template_is_one_message(refusal: Callable[..., str], text: str, said: str) -> None:
    assert said in refusal("wiren-board", text)


def test_two_parameters_of_one_register_are_one_for_conditions(imported: Import) -> None:
    found = imported(
        "wiren-board",
        """{"device_type": "A", "device": {"name": "A", "parameters": {
             "first": {"title": "First", "reg_type": "coil", "address": 1},
             "second": {"title": "Second", "reg_type": "coil", "address": 1}},
           "channels": [{"name": "C", "reg_type": "input", "address": 2, "condition": "second==1"}]}}""",
    )
    assert found.outcomes == {"First": "whole", "Second": "whole", "C": "whole"}
    assert "when: {first: 1}" in found.text


KNOWN = {"a": Reference("a"), "B": Reference("b", given=True)}


@pytest.mark.parametrize(
    ("text", "when"),
    [
        ("a==1", {"a": 1}),
        ("a != -2", {"a": {"not": -2}}),
        ("a>=1&&B<3", [{"a": {"from": 1}}, {"given.b": {"not": {"from": 3}}}]),
        ("(a==1)||(a==2)&&B<=5", {"any": [{"a": 1}, [{"a": 2}, {"given.b": {"to": 5}}]]}),
        ("a>0x10", {"a": {"not": {"to": 16}}}),
    ],
)
def test_conditions(text: str, when: object) -> None:
    assert condition_of(text, KNOWN)[0] == when


@pytest.mark.parametrize("text", ["", "a", "a==", "a==b", "c==1", "(a==1", "a==1)", "a=1", "((((" * 20, "a==1 b"])
def test_a_condition_that_is_none_is_refused(text: str) -> None:
    with pytest.raises(ConditionError):
        condition_of(text, KNOWN)


def test_it_is_recognised() -> None:
    assert likeness(TEMPLATE.encode(), "x.json") is Likeness.SURE
    assert likeness(b'{"device": {}}', "x.json") is Likeness.NO
