"""Telegraf: fields that its input plug-in modbus takes (metric style), and what it cannot say."""

import tomllib
from collections.abc import Callable
from typing import Any

import pytest

from regscribe.losses import Exported

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Lost = Callable[[Exported], set[tuple[str, str, str]]]
AT = "10.0.0.7:1502"


@pytest.fixture
def toml(exported_text: Text, small: Small) -> Callable[..., dict[str, Any]]:
    """The configuration of a map of these registers, as any reader of TOML takes it."""
    return lambda *registers, **more: tomllib.loads(exported_text("telegraf", small(*registers, **more), at=AT))


@pytest.fixture
def fields(toml: Callable[..., dict[str, Any]]) -> Callable[..., list[dict[str, Any]]]:
    """The fields of all blocks, in their order."""

    def found(*registers: str, **more: str) -> list[dict[str, Any]]:
        inputs = toml(*registers, **more)["inputs"]["modbus"]
        return [field for one in inputs for block in one["metric"] for field in block["fields"]]

    return found


def test_a_register_is_a_field_with_its_wire_address(fields: Callable[..., Any]) -> None:
    assert fields("at: 9, name: Level, type: uint16") == [
        {"register": "holding", "address": 9, "name": "level", "type": "UINT16"}
    ]


def test_the_connection_names_device_unit_and_interval(exported_text: Text, small: Small) -> None:
    text = exported_text("telegraf", small("at: 0, name: A"), at=AT, unit="7", every="30", name="oven")
    (one,) = tomllib.loads(text)["inputs"]["modbus"]
    assert (one["name"], one["controller"], one["interval"]) == ("oven", "tcp://10.0.0.7:1502", "30s")
    assert one["configuration_type"] == "metric"
    assert [block["slave_id"] for block in one["metric"]] == [7]


def test_the_head_names_the_map_and_that_no_telegraf_read_it(exported_text: Text, small: Small) -> None:
    head = exported_text("telegraf", small("at: 0, name: A"), at=AT).splitlines()[:3]
    assert head[0] == "# Controller, model A1, map example/controller"
    assert "one state of the device" in head[1]
    assert head[2] == "# telegraf: not verified with the real program"


def test_a_serial_device_has_its_line(exported_text: Text, small: Small) -> None:
    text = exported_text("telegraf", small("at: 0, name: A"), at="/dev/ttyUSB0")
    (one,) = tomllib.loads(text)["inputs"]["modbus"]
    assert one["controller"] == "file:///dev/ttyUSB0"
    assert (one["baud_rate"], one["data_bits"], one["parity"], one["stop_bits"]) == (9600, 8, "N", 1)
    assert one["transmission_mode"] == "RTU"


def test_a_scaled_number_is_a_float_and_one_without_a_scale_keeps_its_type(fields: Callable[..., Any]) -> None:
    scaled, plain = fields("at: 0, name: A, decimals: 1", "at: 1, name: B")
    assert (scaled["scale"], scaled["output"]) == (0.1, "FLOAT64")
    assert "scale" not in plain
    assert "output" not in plain


def test_a_whole_factor_is_written_as_a_float(exported_text: Text, small: Small) -> None:
    assert "scale = 10.0," in exported_text("telegraf", small("at: 0, name: A, multiply: 10"), at=AT)


def test_an_offset_is_added_by_a_processor_for_these_fields_alone(toml: Callable[..., dict[str, Any]]) -> None:
    made = toml("at: 0, name: A, multiply: 0.5, add: -40", "at: 1, name: B")
    (processor,) = made["processors"]["scale"]
    measurements = {block["measurement"] for block in made["inputs"]["modbus"][0]["metric"]}
    assert set(processor["namepass"]) == measurements
    assert processor["scaling"] == [{"factor": 1.0, "offset": -40.0, "fields": ["a"]}]


def test_a_factor_without_an_end_is_told_as_rounded(export: Export, small: Small, lost: Lost) -> None:
    made = export("telegraf", small("at: 0, name: A, multiply: 1/3"), at=AT)
    assert ("a", "scale-rounded", "COSMETIC") in lost(made)
    assert "scale = 0.33333333333333333," in str(made.texts[""])


def test_a_scaled_number_of_64_bits_loses_digits_in_a_double(export: Export, small: Small, lost: Lost) -> None:
    made = export("telegraf", small("at: 0, name: A, type: int64, decimals: 1", "at: 4, name: B, type: int64"), at=AT)
    assert {one for one in lost(made) if one[1].startswith("precision")} == {("a", "precision-float64", "LOST")}


@pytest.mark.parametrize(
    ("order", "name"),
    [("", "ABCD"), ("word_order: little", "CDAB"), ("byte_order: little", "BADC"), ("both", "DCBA")],
)
def test_an_order_is_that_of_its_block(toml: Callable[..., dict[str, Any]], order: str, name: str) -> None:
    said = "word_order: little, byte_order: little" if order == "both" else order
    made = toml(f"at: 0, name: A, type: float32, {said}".rstrip(", "))
    assert [one["byte_order"] for one in made["inputs"]["modbus"][0]["metric"]] == [name]


def test_each_order_and_unit_is_a_block(toml: Callable[..., dict[str, Any]]) -> None:
    made = toml("at: 0, name: A, type: int32, unit: °C", "at: 2, name: B, type: int32, word_order: little, unit: °C")
    blocks = made["inputs"]["modbus"][0]["metric"]
    assert [(one["byte_order"], one["tags"]) for one in blocks] == [("ABCD", {"unit": "°C"}), ("CDAB", {"unit": "°C"})]


def test_flags_are_bits_also_beside_wider_parts(fields: Callable[..., Any]) -> None:
    found = fields("at: 5, name: S, type: uint16, access: r, flags: {0: on, 15: bad}")
    assert [(one["name"], one["type"], one["bit"]) for one in found] == [("s_on", "BIT", 0), ("s_bad", "BIT", 15)]
    word, flag = fields("at: 5, name: S, type: uint16, access: r, fields: {on: {bits: 4..4}, mode: {bits: 0..3}}")
    assert (word["name"], word["type"]) == ("s", "UINT16")
    assert (flag["name"], flag["type"], flag["bit"]) == ("s_on", "BIT", 4)


@pytest.mark.parametrize(("order", "address"), [("big", 5), ("little", 6)])
def test_a_flag_of_a_second_word_stands_in_that_word(fields: Callable[..., Any], order: str, address: int) -> None:
    (found,) = fields(f"at: 5, name: S, type: uint32, word_order: {order}, access: r, flags: {{17: bad}}")
    assert (found["address"], found["bit"]) == (address, 1)


@pytest.mark.parametrize(("byte", "type_"), [("low", "INT8L"), ("high", "INT8H")])
def test_a_byte_of_a_word_has_a_type_of_its_own(fields: Callable[..., Any], byte: str, type_: str) -> None:
    (found,) = fields(f"at: 5, name: S, type: int8, byte: {byte}, access: r")
    assert found["type"] == type_


def test_coils_and_discrete_inputs_have_no_type(fields: Callable[..., Any]) -> None:
    found = fields("at: 3, name: C, space: coil, type: bit", "at: 4, name: D, space: discrete, type: bit, access: r")
    assert found == [
        {"register": "coil", "address": 3, "name": "c"},
        {"register": "discrete", "address": 4, "name": "d"},
    ]


def test_a_text_has_a_length_in_registers_and_neither_scale_nor_output(fields: Callable[..., Any]) -> None:
    assert fields("at: 8, name: Tag, type: string, length: 4, access: r") == [
        {"register": "holding", "address": 8, "name": "tag", "type": "STRING", "length": 4}
    ]


def test_a_text_keeps_its_filling_and_that_is_told(export: Export, small: Small, lost: Lost) -> None:
    made = export("telegraf", small("at: 8, name: Tag, type: string, length: 4, access: r"), at=AT)
    assert ("tag", "padding", "LOST") in lost(made)


def test_texts_of_one_byte_a_register_stand_in_a_connection_of_their_own(toml: Callable[..., dict[str, Any]]) -> None:
    made = toml(
        "at: 0, name: A, access: r",
        "at: 8, name: L, type: string, length: 4, access: r, text: {one_per_register: low}",
        "at: 12, name: H, type: string, length: 4, access: r, text: {one_per_register: high}",
    )
    found = [one.get("workarounds", {}).get("string_register_location") for one in made["inputs"]["modbus"]]
    assert found == [None, "lower", "upper"]


def test_a_text_whose_words_are_turned_is_left_out(export: Export, small: Small) -> None:
    text = small("at: 0, name: A", "at: 8, name: Tag, type: string, length: 4, access: r, word_order: little")
    (loss,) = [one for one in export("telegraf", text, at=AT).losses if one.fact == "register"]
    assert loss.register == "tag"
    assert "least significant word first" in loss.done


def test_a_text_in_other_characters_than_utf_8_is_left_out(export: Export, small: Small) -> None:
    text = small("at: 0, name: A", "at: 8, name: Tag, type: string, length: 4, access: r, text: {encoding: latin-1}")
    (loss,) = [one for one in export("telegraf", text, at=AT).losses if one.fact == "register"]
    assert "latin-1" in loss.done


def test_the_most_words_of_a_request_are_those_of_the_device(toml: Callable[..., dict[str, Any]]) -> None:
    top = "protocol: {functions: [1, 3], limits: {read_words: 20, read_bits: 64}, pause: 50}"
    (one,) = toml("at: 0, name: A, access: r", top=top)["inputs"]["modbus"]
    assert one["workarounds"] == {
        "max_word_registers_per_request": 20,
        "max_bit_registers_per_request": 64,
        "pause_between_requests": "50ms",
    }


def test_what_is_longer_than_a_request_is_left_out(export: Export, small: Small) -> None:
    top = "protocol: {functions: [3], limits: {read_words: 20}}"
    text = small("at: 0, name: A, access: r", "at: 8, name: Tag, type: string, length: 24, access: r", top=top)
    (loss,) = [one for one in export("telegraf", text, at=AT).losses if one.fact == "register"]
    assert loss.done == "left out: it has 24 words, of which the device answers 20 in a request"


def test_the_last_register_is_refused_by_the_plug_in_and_so_left_out(export: Export, small: Small) -> None:
    text = small("at: 65533, name: A, type: int32", "at: 65535, name: B", "at: 65534, name: C, access: r")
    made = export("telegraf", text, at=AT)
    assert {one.register for one in made.losses if one.fact == "register"} == {"b"}


def test_a_name_is_given_once(fields: Callable[..., Any]) -> None:
    found = fields("at: 0, name: S on", "at: 1, name: S, type: uint16, access: r, flags: {0: on}")
    assert [one["name"] for one in found] == ["s_on", "s_on_2"]


def test_what_a_map_says_cannot_break_out_of_its_text(toml: Callable[..., dict[str, Any]]) -> None:
    made = toml("at: 0, name: A, unit: 'x\"] [agent]'", top="""units: {'x"] [agent]': {description: no unit}}""")
    assert set(made) == {"inputs"}


def test_what_it_cannot_say_is_told(export: Export, small: Small, lost: Lost) -> None:
    made = export(
        "telegraf",
        small("at: 0, name: A, sentinels: {-1: bad}, range: 0..9"),
        at=AT,
    )
    assert {("a", "sentinel", "WRONG"), ("a", "write", "LOST")} <= lost(made)


def test_a_word_that_is_neither_0_nor_1_is_told_as_it_is(export: Export, small: Small, lost: Lost) -> None:
    made = export("telegraf", small("at: 0, name: A, type: uint16, kind: boolean, access: r"), at=AT)
    assert ("a", "truth-of-words", "LOST") in lost(made)


def test_a_coil_with_a_scale_is_scaled_by_the_processor(toml: Callable[..., dict[str, Any]]) -> None:
    made = toml("at: 3, name: C, space: coil, kind: number, multiply: 0.1, add: 2")
    (processor,) = made["processors"]["scale"]
    assert processor["scaling"] == [{"factor": 0.1, "offset": 2.0, "fields": ["c"]}]
