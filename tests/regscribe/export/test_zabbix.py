"""Zabbix: items of agent 2 with the steps before a value is stored, value maps, and what it cannot say.

The scripts themselves are run with the values by hand in tests/system/interop/test_zabbix.py.
"""

import re
from collections.abc import Callable
from typing import Any

import pytest

from regscribe import source
from regscribe.losses import Exported
from regscribe.plugins import OptionError

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Lost = Callable[[Exported], set[tuple[str, str, str]]]
Template = Callable[..., dict[str, Any]]
AT = "10.0.0.7:1502"
KEY = 'modbus.get["{$MODBUS.AT}","{$MODBUS.UNIT}",'


@pytest.fixture
def template(exported_text: Text, small: Small) -> Template:
    """The template made of these registers, as a reader of YAML takes it."""

    def made(*registers: str, **more: str) -> dict[str, Any]:
        document, found = source.parse(
            exported_text("zabbix", small(*registers, **more), at=AT).encode(), name="t", escapes=True
        )
        assert document is not None, found
        (one,) = document.data["zabbix_export"]["templates"]
        return dict(one)

    return made


@pytest.fixture
def item(template: Template) -> Template:
    """The first item."""
    return lambda *registers, **more: dict(template(*registers, **more)["items"][0])


@pytest.mark.parametrize(
    ("said", "ending"),
    [
        ("type: uint16", "3,9,1,uint16,be]"),
        ("type: int16, byte_order: little", "3,9,1,int16,le]"),
        ("type: uint32", "3,9,1,uint32,be]"),
        ("type: uint32, word_order: little", "3,9,1,uint32,mbe]"),
        ("type: int32, byte_order: little", "3,9,1,int32,mle]"),
        ("type: int32, word_order: little, byte_order: little", "3,9,1,int32,le]"),
        ("type: uint64", "3,9,1,uint64,be]"),
        ("type: uint64, word_order: little", "3,9,1,uint64,mle]"),
        ("type: uint64, byte_order: little", "3,9,1,uint64,mbe]"),
        ("type: float32, word_order: little", "3,9,1,uint32,mbe]"),
        ("type: float64, word_order: little", "3,9,4,uint16,be]"),
        ("type: int64, byte_order: little", "3,9,4,uint16,le]"),
        ("type: uint16, space: input, access: r", "4,9,1,uint16,be]"),
        ("type: bit, space: coil", "1,9,1,bit]"),
        ("type: bit, space: discrete, access: r", "2,9,1,bit]"),
    ],
)
def test_trap_1_middle_endians_change_places_between_32_and_64_bits(item: Template, said: str, ending: str) -> None:
    assert item(f"at: 9, name: A, {said}")["key"] == KEY + ending


def test_macros_say_where_the_device_answers(exported_text: Text, small: Small) -> None:
    for at, endpoint in ((AT, "tcp://10.0.0.7:1502"), ("/dev/ttyUSB0", "rtu:///dev/ttyUSB0:9600:8n1")):
        text = exported_text("zabbix", small("at: 0, name: A"), at=at, unit="7")
        assert f"value: {endpoint}\n" in text
        assert 'macro: "{$MODBUS.UNIT}"\n          value: "7"' in text.replace("'", '"')


def test_a_scale_is_a_multiplier_and_its_value_a_float(item: Template) -> None:
    made = item("at: 9, name: A, type: uint16, decimals: 1, unit: °C")
    assert made["preprocessing"] == [{"type": "MULTIPLIER", "parameters": ["0.1"]}]
    assert (made["value_type"], made["units"]) == ("FLOAT", "!°C")


def test_an_offset_is_added_by_one_division_of_whole_numbers(item: Template) -> None:
    (step,) = item("at: 9, name: A, multiply: 0.1, add: -40")["preprocessing"]
    assert step == {"type": "JAVASCRIPT", "parameters": ["var v = Number(value); return (v - 400) / 10;"]}


def test_a_plain_number_is_unsigned_or_a_float_and_has_no_steps(item: Template) -> None:
    unsigned, signed = item("at: 9, name: A, type: uint16"), item("at: 9, name: A")
    assert (unsigned["value_type"], signed["value_type"]) == ("UNSIGNED", "FLOAT")
    assert "preprocessing" not in unsigned
    assert "preprocessing" not in signed


def test_each_fault_word_is_an_error_in_its_own_words(item: Template) -> None:
    (step,) = item("at: 9, name: A, decimals: 1, sentinels: {-32768: broken, 32767: short}")["preprocessing"]
    assert step["parameters"] == [
        'var v = Number(value); if (v === -32768) throw "broken"; if (v === 32767) throw "short"; return (v) / 10;'
    ]


def test_an_enum_has_its_labels_in_a_value_map_that_registers_share(template: Template) -> None:
    made = template("at: 0, name: A, enum: m", "at: 1, name: B, enum: m", top="enums: {m: {0: off, 3: slow}}")
    (found,) = made["valuemaps"]
    assert found["mappings"] == [{"value": "0", "newvalue": "off"}, {"value": "3", "newvalue": "slow"}]
    assert [one["valuemap"]["name"] for one in made["items"]] == [found["name"]] * 2


def test_a_special_value_has_its_label(template: Template) -> None:
    (found,) = template("at: 0, name: A, range: 1..9, special: {0: off}")["valuemaps"]
    assert found["mappings"] == [{"value": "0", "newvalue": "off"}]


def test_a_special_value_that_stands_for_another_number_is_told(export: Export, small: Small, lost: Lost) -> None:
    made = export(
        "zabbix", small("at: 0, name: A, range: 1..9, special: {0: {label: least, means: 0.2}}, decimals: 1"), at=AT
    )
    assert ("a", "special-value", "WRONG") in lost(made)


def test_parts_of_a_word_depend_on_the_word(template: Template) -> None:
    word, flag, part = template(
        "at: 5, name: S, type: uint16, access: r, fields: {on: {bits: 4..4}, mode: {bits: 0..3, enum: {1: run}}}"
    )["items"]
    assert [one["master_item"] for one in (flag, part)] == [{"key": word["key"]}] * 2
    assert [one["type"] for one in (flag, part)] == ["DEPENDENT"] * 2
    assert flag["preprocessing"][0]["parameters"] == ["var v = Math.floor(Number(value) / 16) % 2; return v;"]
    assert (flag["key"], part["key"]) == ("modbus.part[s.on]", "modbus.part[s.mode]")


def test_two_registers_with_the_same_words_have_two_keys(template: Template) -> None:
    first, second = template("at: 5, name: A, access: r", "at: 5, name: B, access: r, rereads: a")["items"]
    assert first["key"].replace(" ", "") == second["key"].replace(" ", "")
    assert first["key"] != second["key"]


def test_a_text_is_made_of_its_words(item: Template) -> None:
    made = item("at: 8, name: Tag, type: string, length: 4, access: r")
    assert (made["key"], made["value_type"], made["trends"]) == (f"{KEY}3,8,4,uint16,be]", "TEXT", "0")


def test_whole_numbers_of_64_bits_with_a_sign_lose_digits(export: Export, small: Small, lost: Lost) -> None:
    made = export(
        "zabbix",
        small(
            "at: 0, name: A, type: int64", "at: 4, name: B, type: uint64", "at: 8, name: C, type: uint64, decimals: 1"
        ),
        at=AT,
    )
    found = {one for one in lost(made) if one[1] == "precision-float64"}
    assert found == {("a", "precision-float64", "LOST"), ("c", "precision-float64", "LOST")}


def test_a_label_longer_than_zabbix_has_room_for_is_cut_and_told(export: Export, small: Small, lost: Lost) -> None:
    made = export("zabbix", small(f"at: 0, name: A, enum: {{0: {'x' * 65}}}"), at=AT)
    assert ("a", "label-cut", "COSMETIC") in lost(made)
    assert f"newvalue: {'x' * 63}…\n" in str(made.texts[""])


def test_the_same_map_gives_the_same_identities_in_the_form_of_version_4(template: Template) -> None:
    one, again = (template("at: 0, name: A", "at: 1, name: B") for _ in range(2))
    assert one == again
    found = [one["uuid"], *(item["uuid"] for item in one["items"])]
    assert len(set(found)) == 3
    assert all(len(text) == 32 and text[12] == "4" and text[16] in "89ab" for text in found)


def test_a_label_is_no_code_and_no_macro(item: Template) -> None:
    made = item("""at: 0, name: A, sentinels: {-1: '";return 1;//{$SECRET}'}""")
    (script,) = made["preprocessing"][0]["parameters"]
    assert "{$SECRET}" not in script
    assert 'throw "\\";return 1;//{\\u0024SECRET}";' in script


def test_words_with_too_many_bits_are_left_out(export: Export, small: Small) -> None:
    text = small("at: 0, name: A", "at: 1, name: F, type: uint64, access: r, flags: {40: on}")
    (loss,) = [one for one in export("zabbix", text, at=AT).losses if one.fact == "register"]
    assert loss.done == "left out: its bits are 64, and a script takes 32 apart at most"


def test_zabbix_asks_once_a_day_at_least(export: Export, small: Small) -> None:
    with pytest.raises(OptionError, match="86400"):
        export("zabbix", small("at: 0, name: A"), at=AT, every="86401")


def test_a_coil_with_a_scale_is_a_float(item: Template) -> None:
    made = item("at: 3, name: C, space: coil, kind: number, multiply: 0.1")
    assert (made["value_type"], made["preprocessing"][0]["parameters"]) == ("FLOAT", ["0.1"])


def test_no_text_of_the_map_is_a_macro(exported_text: Text, small: Small) -> None:
    text = exported_text(
        "zabbix",
        small(
            "at: 0, name: 'A {$SECRET}', description: '{#LLD} {{HOST.IP}}', enum: {0: 'x {$SECRET}'}",
            "at: 1, name: B, unit: '{$SECRET}'",
            top="units: {'{$SECRET}': {description: none}}",
        ),
        at=AT,
    )
    assert set(re.findall(r"\{[$#{][^}]*\}?", text)) == {"{$MODBUS.AT}", "{$MODBUS.UNIT}"}
