"""Wiren Board: channels of a device template, and what wb-mqtt-serial cannot say or would show otherwise."""

import json
import re
from collections.abc import Callable
from typing import Any

import pytest

from regscribe.losses import Exported

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Made = Callable[..., Any]
Lost = Callable[..., dict[str, str]]
FORM = "wiren-board"
READ = "access: r"


@pytest.fixture
def template(exported_text: Text, small: Small) -> Made:
    """The template of a map of these registers, without the comments that stand above it."""

    def found(*registers: str, top: str = "", **more: str) -> Any:
        text = exported_text(FORM, small(*registers, top=top), **more)
        return json.loads(re.sub("^//.*\n", "", text, flags=re.MULTILINE))

    return found


@pytest.fixture
def channels(template: Made) -> Made:
    """The channels of a map of these registers."""
    return lambda *registers, **more: template(*registers, **more)["device"]["channels"]


@pytest.fixture
def one(channels: Made) -> Made:
    """The one channel of a map of one register."""

    def found(*registers: str, **more: str) -> dict[str, Any]:
        (channel,) = channels(*registers, **more)
        return dict(channel)

    return found


@pytest.fixture
def losses(export: Export, small: Small) -> Lost:
    """Grade and what was done of each loss, by its code."""

    def found(*registers: str, top: str = "", **more: str) -> dict[str, str]:
        made = export(FORM, small(*registers, top=top), **more)
        return {each.fact: f"{each.grade.name}: {each.done}" for each in made.losses}

    return found


def test_a_register_is_a_channel_with_its_wire_address(one: Made) -> None:
    assert one(f"at: 9, name: Level, type: uint16, {READ}") == {
        "name": "Level",
        "id": "level",
        "group": "control",
        "reg_type": "holding",
        "address": 9,
        "readonly": True,
        "type": "value",
        "format": "u16",
    }


def test_the_device_has_its_groups_and_limits(template: Made) -> None:
    top = "protocol: {limits: {read_words: 24}, pause: 2.5, latency: {3: {fixed: 0..1500}}}"
    found = template("at: 0, name: A", top=top)
    assert (found["device_type"], found["title"]) == ("ExampleA1", "Controller A1")
    device = found["device"]
    assert device["groups"] == [{"title": "Control", "id": "control"}]
    assert (device["max_read_registers"], device["guard_interval_us"], device["response_timeout_ms"]) == (
        24,
        2500,
        2000,
    )


@pytest.mark.parametrize(
    ("orders", "found"),
    [
        ("description: x", {}),
        ("word_order: little", {"word_order": "little_endian"}),
        ("byte_order: little", {"byte_order": "little_endian"}),
        (
            "word_order: little, byte_order: little",
            {"word_order": "little_endian", "byte_order": "little_endian"},
        ),
    ],
)
def test_orders_stand_where_they_are_not_the_usual(one: Made, orders: str, found: dict[str, str]) -> None:
    channel = one(f"at: 0, name: A, type: uint32, {orders}, {READ}")
    assert {key: value for key, value in channel.items() if key.endswith("_order")} == found


@pytest.mark.parametrize(
    ("kind", "form"),
    [("int64", "s64"), ("uint24", "u24"), ("float32", "float"), ("float64", "double"), ("bcd16", "bcd16")],
)
def test_types_have_their_formats(one: Made, kind: str, form: str) -> None:
    assert one(f"at: 0, name: A, type: {kind}, {READ}")["format"] == form


def test_one_byte_of_a_word_is_its_low_one_or_the_bytes_are_swapped(channels: Made) -> None:
    low, high = channels(f"at: 0, name: A, type: int8, {READ}", f"at: 1, name: B, type: int8, byte: high, {READ}")
    assert (low["format"], "byte_order" in low, high["byte_order"]) == ("s8", False, "little_endian")


def test_scale_offset_and_unit_are_exact_numbers(one: Made, exported_text: Text, small: Small) -> None:
    moved = f"at: 0, name: A, multiply: 0.1, add: -40.5, unit: V, {READ}"
    found = one(moved)
    assert (found["scale"], found["offset"], found["units"]) == (0.1, -40.5, "V")
    assert '"scale": 0.1,' in exported_text(FORM, small(moved))


def test_a_scale_without_a_finite_decimal_is_rounded_and_told(one: Made, losses: Lost) -> None:
    third = f"at: 0, name: A, divide: 3, {READ}"
    assert one(third)["scale"] == 1 / 3
    assert losses(third)["scale-rounded"].startswith("COSMETIC")


def test_digits_that_the_service_does_not_show_are_told(losses: Lost) -> None:
    assert "7 significant digits" in losses(f"at: 0, name: A, type: float32, {READ}")["decimals-cut"]
    assert losses(f"at: 0, name: A, type: int64, decimals: 1, {READ}")["precision-float64"].startswith("WRONG")
    assert "precision-float64" not in losses(f"at: 0, name: A, type: int64, {READ}")


@pytest.mark.parametrize(
    ("fault", "pattern"),
    [
        ("type: int16, sentinels: {-32768: broken}", "0x8000"),
        ("type: int32, sentinels: {-1: broken}", "0xFFFFFFFF"),
        ("type: uint16, sentinels: {65535: broken}", "0xFFFF"),
        ("type: int8, sentinels: {-128: broken}", "0x80"),
        ("type: int24, sentinels: {-1: broken}", "0xFFFFFF"),
        ("type: bcd16, sentinels: {9999: broken}", "0x9999"),
        ("type: float32, sentinels: {-2: broken}", "0xC0000000"),
    ],
)
def test_a_fault_word_is_the_pattern_of_its_bits(one: Made, losses: Lost, fault: str, pattern: str) -> None:
    # the service compares bits, not numbers
    assert one(f"at: 0, name: A, {fault}, {READ}")["error_value"] == pattern
    found = losses(f"at: 0, name: A, {fault}, {READ}")
    assert found["sentinel-label"].startswith("LOST")
    assert not {"sentinel", "several-sentinels"} & found.keys()


def test_of_several_fault_words_one_is_told_to_be_shown(one: Made, losses: Lost) -> None:
    two = f"at: 0, name: A, type: int16, sentinels: {{-32768: low, 32767: high}}, {READ}"
    assert one(two)["error_value"] == "0x8000"
    assert "32767 = high" in losses(two)["several-sentinels"]


def test_a_range_of_fault_words_is_told_to_be_shown(one: Made, losses: Lost) -> None:
    some = f"at: 0, name: A, type: uint16, sentinels: {{65530..65535: broken}}, {READ}"
    assert "error_value" not in one(some)
    assert losses(some)["sentinel"].startswith("WRONG")


def test_codes_have_their_titles(one: Made) -> None:
    found = one(f"at: 0, name: A, type: int16, enum: {{-1: falling, 0: steady}}, {READ}")
    assert (found["enum"], found["enum_titles"]) == (["-1", "0"], ["falling", "steady"])


def test_a_setting_has_its_limits_and_no_readonly(one: Made) -> None:
    found = one("at: 0, name: A, decimals: 1, range: -50..400.5, access: rw")
    assert (found["min"], found["max"], "readonly" in found) == (-50, 400.5, False)


def test_limits_that_are_not_known_are_told(losses: Lost) -> None:
    registers = "at: 9, name: Mode, type: uint16", "at: 0, name: A, range: {from: 0, to: mode}, access: rw"
    assert "not known" in losses(*registers)["range"]


def test_a_place_of_its_own_for_writes_is_a_write_address(one: Made) -> None:
    found = one("at: 0, name: A, access: rw, write_at: 50")
    assert (found["address"], found["write_address"]) == (0, 50)


def test_one_register_is_written_by_the_function_that_there_is(one: Made) -> None:
    assert one("at: 0, name: A, access: rw", top="protocol: {functions: [3, 16]}")["reg_type"] == "holding_multi"
    assert one("at: 0, name: A, access: rw", top="protocol: {functions: [3, 6]}")["reg_type"] == "holding"


@pytest.mark.parametrize(
    "more",
    [
        "danger: It starts.",
        "writable: {when: {mode: 1}, reason: only then}",
        "type: string, length: 2",
        "type: uint16, version: n.n.n",
    ],
)
def test_a_write_that_is_not_free_is_read_only_and_told(channels: Made, losses: Lost, more: str) -> None:
    registers = f"at: 9, name: Mode, type: uint16, {READ}", f"at: 0, name: A, access: rw, {more}"
    assert channels(*registers)[1]["readonly"] is True
    assert losses(*registers)["write"].startswith("LOST: read only")


def test_coils_are_switches_by_function_5_alone(one: Made) -> None:
    coil = "at: 3, name: Pump, space: coil, access: rw"
    found = one(coil, top="protocol: {functions: [1, 3, 5]}")
    assert (found["reg_type"], found["type"], "readonly" in found) == ("coil", "switch", False)
    assert one(coil, top="protocol: {functions: [1, 3, 15]}")["readonly"] is True


def test_a_coil_whose_states_have_labels_is_a_choice(one: Made) -> None:
    valve = "at: 3, name: Valve, space: coil, enum: {0: closed, 1: opened}, access: rw"
    found = one(valve, top="protocol: {functions: [1, 3, 5]}")
    assert (found["type"], found["enum"], found["enum_titles"]) == ("value", ["0", "1"], ["closed", "opened"])


def test_a_truth_value_of_a_word_has_its_two_values(one: Made) -> None:
    found = one("at: 3, name: Pump, type: uint16, kind: boolean, access: rw")
    assert (found["type"], found["on_value"], found["off_value"]) == ("switch", "1", "0")


def test_bits_and_parts_are_channels_of_their_own(channels: Made) -> None:
    zone, level = "zone: {bits: 0..3, enum: {0: off, 1: on}}", "level: {bits: 4..11, multiply: 0.5, unit: '%'}"
    parts = f"fields: {{{zone}, {level}, alarm: {{bit: 15}}}}"
    zone, level, alarm = channels(f"at: 70, name: A, type: int16, {parts}, {READ}")
    assert (zone["address"], zone["format"], zone["id"], zone["enum"]) == ("70:0:4", "u16", "a_zone", ["0", "1"])
    assert (level["address"], level["scale"], level["units"]) == ("70:4:8", 0.5, "%")
    assert (alarm["address"], alarm["type"]) == ("70:15:1", "switch")


def test_bits_of_several_words_count_from_the_least_significant(channels: Made) -> None:
    # the service composes the number in the order of its words before it shifts
    (door,) = channels(f"at: 40, name: A, type: uint32, word_order: little, flags: {{17: door}}, {READ}")
    assert (door["address"], door["format"], door["word_order"]) == ("40:17:1", "u32", "little_endian")


def test_a_signed_part_is_left_out_and_told(channels: Made, losses: Lost) -> None:
    signed = f"at: 0, name: A, type: uint16, fields: {{a: {{bits: 0..7, type: signed}}, b: {{bits: 8..11}}}}, {READ}"
    assert [each["id"] for each in channels(signed)] == ["a_b"]
    assert losses(signed)["fields"] == "LOST: left out: a, a signed number of some bits"


def test_a_fault_of_a_part_is_its_error_value(channels: Made) -> None:
    parts = "fields: {a: {bits: 0..7, sentinels: {255: absent}}, b: {bits: 8..11}}"
    assert channels(f"at: 0, name: A, type: uint16, {parts}, {READ}")[0]["error_value"] == "0xFF"


@pytest.mark.parametrize(
    ("text", "form", "order"),
    [
        ("description: x", "string8", None),
        ("text: {one_per_register: low}", "string", None),
        ("text: {one_per_register: high}", "string", "little_endian"),
    ],
)
def test_a_text_has_so_many_registers(one: Made, text: str, form: str, order: str | None) -> None:
    found = one(f"at: 0, name: A, type: string, length: 4, {text}, {READ}")
    assert (found["format"], found["string_data_size"], found.get("byte_order")) == (form, 4, order)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("type: float16", "does not read float16"),
        ("type: string, length: 4, text: utf-16", "UTF-8"),
        ("type: datetime, layout: Y M D h m s", "it is a datetime"),
    ],
)
def test_what_it_cannot_read_is_left_out_with_the_reason(export: Export, small: Small, words: str, why: str) -> None:
    made = export(FORM, small(f"at: 0, name: A, {READ}", f"at: 9, name: B, {words}, {READ}"))
    (done,) = [each.done for each in made.losses if each.fact == "register"]
    assert why in done


def test_a_register_that_is_to_be_read_seldom_has_a_limit_of_its_rate(one: Made, losses: Lost) -> None:
    assert one(f"at: 0, name: A, poll: 60, {READ}")["read_rate_limit_ms"] == 60000
    assert losses(f"at: 0, name: A, poll: slow, {READ}")["poll"].startswith("COSMETIC")


@pytest.mark.parametrize("name", ["On/Off", "$x", "#1", "a+b", 'say "x"', "it's"])
def test_names_have_no_characters_of_topics_and_that_is_told(one: Made, losses: Lost, name: str) -> None:
    register = f"at: 0, id: a, name: {json.dumps(name)}, {READ}"
    assert re.fullmatch(r"[^$#+/\"']+", one(register)["name"])
    assert losses(register)["name"].startswith("COSMETIC")


def test_names_and_ids_are_given_once(channels: Made) -> None:
    found = channels(f"at: 0, id: a, name: Level, {READ}", f"at: 1, id: b, name: Level, {READ}")
    assert [(each["name"], each["id"]) for each in found] == [("Level", "a"), ("Level 2", "b")]


def test_the_head_says_that_no_program_read_it(exported_text: Text, small: Small) -> None:
    head = exported_text(FORM, small("at: 0, name: A")).splitlines()[:3]
    assert head[0] == "// Controller, model A1, map example/controller"
    assert head[2] == "// wiren-board: not verified with the real program"
