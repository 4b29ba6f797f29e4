"""Home Assistant: entities that its integration modbus loads, and what it cannot say or would show otherwise."""

from collections.abc import Callable
from typing import Any

import pytest
import yaml

from regscribe.losses import Exported

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Hub = Callable[..., dict[str, Any]]
Lost = Callable[..., dict[str, str]]
AT = "10.0.0.7:1502"
FORM = "home-assistant"


@pytest.fixture
def hub(exported_text: Text, small: Small) -> Hub:
    """The one hub of a map of these registers."""

    def found(*registers: str, top: str = "", **more: str) -> dict[str, Any]:
        text = exported_text(FORM, small(*registers, top=top), **({"at": AT} | more))
        (one,) = yaml.safe_load(text)["modbus"]
        return dict(one)

    return found


@pytest.fixture
def sensor(hub: Hub) -> Hub:
    """The one sensor of a map of one register."""

    def found(*registers: str, **more: str) -> dict[str, Any]:
        (one,) = hub(*registers, **more)["sensors"]
        return dict(one)

    return found


@pytest.fixture
def losses(export: Export, small: Small) -> Lost:
    """Grade and what was done of each loss, by its code."""

    def found(*registers: str, **more: str) -> dict[str, str]:
        made = export(FORM, small(*registers, **more), at=AT)
        return {one.fact: f"{one.grade.name}: {one.done}" for one in made.losses}

    return found


def test_a_register_is_a_sensor_with_its_wire_address(sensor: Hub) -> None:
    assert sensor("at: 9, name: Level, type: uint16", unit="7", every="30", name="oven") == {
        "name": "oven Level",
        "unique_id": "example/controller:oven:level",
        "slave": 7,
        "address": 9,
        "scan_interval": 30,
        "input_type": "holding",
        "data_type": "uint16",
        "precision": 0,
    }


def test_the_hub_is_the_device_on_tcp(hub: Hub) -> None:
    found = hub("at: 0, name: A", name="oven")
    assert {key: found[key] for key in ("name", "type", "host", "port")} == {
        "name": "oven",
        "type": "tcp",
        "host": "10.0.0.7",
        "port": 1502,
    }


def test_a_serial_hub_has_the_line_of_the_map(hub: Hub) -> None:
    found = hub("at: 0, name: A", at="/dev/ttyUSB0", top="protocol: {serial: {default: '19200 8E1'}}")
    assert {key: found[key] for key in ("type", "port", "method", "baudrate", "bytesize", "parity", "stopbits")} == {
        "type": "serial",
        "port": "/dev/ttyUSB0",
        "method": "rtu",
        "baudrate": 19200,
        "bytesize": 8,
        "parity": "E",
        "stopbits": 1,
    }


@pytest.mark.parametrize(
    ("orders", "swap"),
    [
        ("", None),
        ("word_order: little", "word"),
        ("byte_order: little", "byte"),
        ("word_order: little, byte_order: little", "word_byte"),
    ],
)
def test_orders_are_swaps(sensor: Hub, orders: str, swap: str | None) -> None:
    assert sensor(f"at: 0, name: A, type: uint32, {orders or 'description: x'}").get("swap") == swap


def test_one_byte_of_a_word_is_a_structure(sensor: Hub) -> None:
    low, high = (sensor(f"at: 0, name: A, type: int8, byte: {which}") for which in ("low", "high"))
    assert (low["data_type"], low["count"], low["structure"]) == ("custom", 1, ">xb")
    assert high["structure"] == ">bx"


def test_trap_6_a_scaled_integer_has_the_decimals_of_its_scale(sensor: Hub) -> None:
    found = sensor("at: 0, name: A, type: int16, multiply: 0.25, add: -40")
    assert (found["scale"], found["offset"], found["precision"]) == (0.25, -40, 2)


def test_a_factor_above_one_has_no_decimals(sensor: Hub) -> None:
    found = sensor("at: 0, name: A, type: int16, multiply: 100")
    assert (found["scale"], found["precision"]) == (100, 0)


def test_a_scale_without_a_finite_decimal_is_rounded_and_told(exported_text: Text, small: Small, losses: Lost) -> None:
    third = "at: 0, name: A, type: uint16, divide: 3"
    assert "scale: 0.33333333333333333\n" in exported_text(FORM, small(third), at=AT)
    found = losses(third)
    assert found["scale-rounded"].startswith("COSMETIC")
    assert found["decimals-cut"].startswith("LOST")


def test_floats_are_shown_with_six_decimals_and_that_is_told(sensor: Hub, losses: Lost) -> None:
    assert sensor("at: 0, name: A, type: float32")["precision"] == 6
    assert "6 decimals" in losses("at: 0, name: A, type: float32")["decimals-cut"]


def test_whole_numbers_that_a_double_cannot_hold_are_told(losses: Lost) -> None:
    assert losses("at: 0, name: A, type: uint64")["precision-float64"].startswith("WRONG")
    assert "precision-float64" not in losses("at: 0, name: A, type: uint32")


def test_trap_5_a_fault_word_is_a_nan_value_if_its_negative_is_none(sensor: Hub, losses: Lost) -> None:
    lowest = "at: 0, name: A, type: int16, sentinels: {-32768: broken}"
    assert sensor(lowest)["nan_value"] == -32768
    assert losses(lowest)["sentinel-label"].endswith("-32768 = broken")
    highest = "at: 0, name: A, type: int16, sentinels: {32767: broken}"  # -32767 may be a value
    assert "nan_value" not in sensor(highest)
    assert losses(highest)["sentinel"].startswith("WRONG")
    assert sensor("at: 0, name: A, type: uint16, sentinels: {65535: broken}")["nan_value"] == 65535


def test_of_several_fault_words_one_is_told_to_be_shown_as_a_number(sensor: Hub, losses: Lost) -> None:
    two = "at: 0, name: A, type: int16, sentinels: {-32768: low, 32767: high}"
    assert sensor(two)["nan_value"] == -32768
    assert "32767 = high" in losses(two)["several-sentinels"]


def test_both_signs_of_a_fault_word_are_one_nan_value(sensor: Hub, losses: Lost) -> None:
    both = "at: 0, name: A, type: int16, sentinels: {-999: low, 999: high}"
    assert sensor(both)["nan_value"] in {-999, 999}
    assert "several-sentinels" not in losses(both)


def test_a_fault_word_counts_as_it_stands_on_the_wire(sensor: Hub) -> None:
    top = "views: {tenfold: {base: {type: int16, factor: 10}}}"
    assert sensor("at: 0, name: A, views: tenfold, sentinels: {-999: broken, 999: broken too}", top=top)[
        "nan_value"
    ] in {
        -9990,
        9990,
    }


def test_what_is_no_number_is_unknown_by_itself(sensor: Hub, losses: Lost) -> None:
    absent = "at: 0, name: A, type: float32, sentinels: {nan: absent}"
    assert "nan_value" not in sensor(absent)
    assert not {"sentinel", "several-sentinels"} & losses(absent).keys()


def test_a_range_of_fault_words_is_shown_as_numbers_and_told(losses: Lost) -> None:
    found = losses("at: 0, name: A, type: uint16, sentinels: {65530..65535: broken}")
    assert found["sentinel"].startswith("WRONG")


def test_limits_never_clamp_a_reading(sensor: Hub) -> None:
    found = sensor("at: 0, name: A, type: int16, access: rw, range: 0..100, valid: 0..100")
    assert not {"min_value", "max_value"} & found.keys()


def test_trap_7_a_number_that_can_be_written_is_a_sensor_and_told_so(hub: Hub, losses: Lost) -> None:
    setting = "at: 0, name: A, access: rw, range: 0..100"
    assert not {"numbers", "selects"} & hub(setting).keys()
    assert "no numbers" in losses(setting)["write"]


@pytest.mark.parametrize(
    ("unit", "name", "state"),
    [
        ("V", "voltage", "measurement"),
        ("°C", None, "measurement"),
        ("kWh", "energy", None),
        ("%", None, None),
        ("m", None, None),
    ],
)
def test_only_units_without_a_doubt_make_a_class(sensor: Hub, unit: str, name: str | None, state: str | None) -> None:
    found = sensor(f'at: 0, name: A, access: r, unit: "{unit}"')
    assert (found["unit_of_measurement"], found.get("device_class"), found.get("state_class")) == (unit, name, state)


def test_a_temperature_is_one_where_the_map_would_tell_a_difference(hub: Hub) -> None:
    # Home Assistant would convert a difference of 5 °C to 41 °F
    top = "units: {temperature: [{when: {mode: 1}, symbol: °F}, {symbol: °C}]}"
    both = "at: 1, name: A, unit: temperature", "at: 2, name: B, unit: temperature, difference: true"
    _, one, difference = hub("at: 0, name: Mode, default: 0", *both, top=top)["sensors"]
    assert (one["unit_of_measurement"], one["device_class"]) == ("°C", "temperature")
    assert (difference["unit_of_measurement"], "device_class" in difference) == ("°C", False)


def test_a_setting_is_not_measured(sensor: Hub) -> None:
    assert "state_class" not in sensor("at: 0, name: A, unit: V, access: rw, range: 0..100")


def test_a_text_has_its_registers_and_what_fills_it_up_is_told(sensor: Hub, losses: Lost) -> None:
    text = "at: 0, name: A, type: string, length: 4, byte_order: little"
    found = sensor(text)
    assert (found["data_type"], found["count"], found["swap"]) == ("string", 4, "byte")
    assert "precision" not in found
    assert losses(text)["padding"].startswith("LOST")


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("type: string, length: 4, text: utf-16", "UTF-8 or ASCII"),
        ("type: string, length: 4, text: {one_per_register: low}", "two bytes in each register"),
        ("type: string, length: 4, word_order: little", "does not read string"),
        ("type: string, length: 128", "255 characters"),
        ("type: datetime, layout: Y M D h m s", "it is a datetime"),
        ("type: bcd16", "does not read bcd16"),
        ("space: file, file: 4", "file space"),
    ],
)
def test_what_it_cannot_read_is_left_out_with_the_reason(export: Export, small: Small, text: str, why: str) -> None:
    made = export(FORM, small("at: 0, name: A", f"at: 9, name: B, {text}"), at=AT)
    (loss,) = [one for one in made.losses if one.fact == "register"]
    assert (loss.register, why in loss.done) == ("b", True), loss.done
    assert "address: 9" not in str(made.texts[""])


def test_a_text_longer_than_one_request_is_left_out(export: Export, small: Small) -> None:
    top = "protocol: {limits: {read_words: 4}}"
    made = export(FORM, small("at: 0, name: A", "at: 9, name: B, type: string, length: 5", top=top), at=AT)
    assert [one.register for one in made.losses if one.fact == "register"] == ["b"]


def test_a_coil_is_a_switch_that_is_read_back(hub: Hub) -> None:
    (found,) = hub("at: 3, name: Pump, space: coil, access: rw", top="protocol: {functions: [1, 3, 5, 6, 15, 16]}")[
        "switches"
    ]
    assert (found["address"], found["write_type"], found["verify"]) == (3, "coil", {"input_type": "coil"})


def test_a_switch_sends_a_function_that_the_device_has(hub: Hub) -> None:
    (found,) = hub("at: 3, name: Pump, space: coil, access: rw", top="protocol: {functions: [1, 3, 15]}")["switches"]
    assert found["write_type"] == "coils"


def test_a_truth_value_in_a_holding_register_is_a_switch_for_0_and_1(hub: Hub) -> None:
    (found,) = hub("at: 3, name: Pump, type: uint16, kind: boolean, access: rw, settle: 1200")["switches"]
    assert (found["write_type"], found["verify"]) == ("holding", {"input_type": "holding", "delay": 2})


def test_a_contact_is_a_binary_sensor(hub: Hub) -> None:
    (found,) = hub("at: 3, name: Door, space: discrete, access: r", top="protocol: {functions: [2, 3]}")[
        "binary_sensors"
    ]
    assert (found["address"], found["input_type"]) == (3, "discrete_input")


def test_a_truth_value_of_a_word_is_its_lowest_bit_and_told_so(hub: Hub, losses: Lost) -> None:
    word = "at: 3, name: Door, type: uint16, kind: boolean, access: r"
    (found,) = hub(word)["binary_sensors"]
    assert found["input_type"] == "holding"
    assert losses(word)["truth-of-words"].startswith("WRONG")


def test_a_truth_value_of_two_words_is_a_number(sensor: Hub, losses: Lost) -> None:
    wide = "at: 3, name: Door, type: uint32, kind: boolean, access: r"
    assert sensor(wide)["data_type"] == "uint32"
    assert losses(wide)["boolean"].startswith("LOST")


@pytest.mark.parametrize("more", ["danger: It starts.", "writable: {when: {mode: 1}, reason: only then}"])
def test_a_write_that_is_not_free_makes_no_switch(hub: Hub, losses: Lost, more: str) -> None:
    pump = f"at: 3, name: Pump, type: uint16, kind: boolean, access: rw, {more}"
    mode = "at: 0, name: Mode, type: uint16, range: 0..3, default: 1"
    assert "switches" not in hub(mode, pump)
    assert losses(mode, pump)["write"].startswith("LOST: read only")


def test_codes_and_bits_are_numbers_and_their_labels_are_told(sensor: Hub, losses: Lost) -> None:
    assert sensor("at: 0, name: A, type: uint16, enum: {0: off, 1: on}")["precision"] == 0
    assert losses("at: 0, name: A, type: uint16, enum: {0: off, 1: on}")["enum"].startswith("LOST")
    assert losses("at: 0, name: A, type: uint16, flags: {0: run}")["flags"].startswith("LOST")


def test_a_version_is_the_number_that_packs_it_and_told_so(sensor: Hub, losses: Lost) -> None:
    version = "at: 0, name: A, type: uint16, version: n.n.n, access: r"
    assert (sensor(version)["data_type"], sensor(version)["precision"]) == ("uint16", 0)
    assert losses(version)["version"] == "LOST: shown as the number that packs its 3 digits"


def test_names_that_are_the_same_have_the_path_behind(hub: Hub) -> None:
    # a second entity of one name is dropped
    found = hub("at: 0, id: a, name: Level", "at: 1, id: b, name: Level", "at: 2, name: Other", name="x")["sensors"]
    assert [one["name"] for one in found] == ["x Level (a)", "x Level (b)", "x Other"]


@pytest.mark.parametrize("name", ["!secret door", "{{ states }}", "a: b # c", "'\"", "-", "on", "1e3", "&a", "%x"])
def test_hostile_names_are_texts(hub: Hub, name: str) -> None:
    quoted = yaml.safe_dump(name, default_style='"', allow_unicode=False, width=10**6).strip()
    (found,) = hub(f"at: 0, id: a, name: {quoted}", name="x")["sensors"]
    assert found["name"] == f"x {' '.join(name.split())}"


def test_a_pause_and_slow_answers_are_settings_of_the_hub(hub: Hub) -> None:
    found = hub("at: 0, name: A", top="protocol: {pause: 50, latency: {3: {fixed: 0..4200}}}")
    assert (found["message_wait_milliseconds"], found["timeout"]) == (50, 5)
    assert not {"message_wait_milliseconds", "timeout"} & hub("at: 0, name: A").keys()


def test_a_register_that_is_to_be_read_seldom_is(sensor: Hub, losses: Lost) -> None:
    assert sensor("at: 0, name: A, poll: 60")["scan_interval"] == 60
    assert sensor("at: 0, name: A, poll: 2")["scan_interval"] == 10
    assert losses("at: 0, name: A, poll: slow")["poll"].startswith("COSMETIC")


def test_the_head_says_of_what_and_for_which_state_it_was_made(exported_text: Text, small: Small) -> None:
    head = exported_text(FORM, small("at: 0, name: A"), at=AT).splitlines()[:3]
    assert head[0] == "# Controller, model A1, map example/controller"
    assert "one state of the device" in head[1]
    assert head[2] == "# home-assistant: verified with Home Assistant 2024.3.3"


def test_a_reading_that_the_device_clipped_is_told_to_be_shown(export: Export, small: Small) -> None:
    top = "views: {tenfold: {base: {type: int16, factor: 10, saturates: true}}}"
    made = export(FORM, small("at: 0, name: A, views: tenfold", top=top), at=AT)
    assert [(one.register, one.grade.name) for one in made.losses if one.fact == "saturates"] == [("a", "WRONG")]
