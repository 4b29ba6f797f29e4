"""ESPHome: entities that its modbus_controller takes, and what it cannot say or would show otherwise."""

from collections.abc import Callable
from typing import Any

import pytest
import yaml

from regscribe.losses import Exported
from regscribe.plugins import OptionError

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Made = Callable[..., Any]
Lost = Callable[..., dict[str, str]]
FORM = "esphome"


class Reader(yaml.SafeLoader):
    """Reads texts under the program's tags as pairs."""


Reader.add_multi_constructor("!", lambda loader, tag, node: (tag, loader.construct_scalar(node)))


@pytest.fixture
def made(exported_text: Text, small: Small) -> Made:
    """The document of a map of these registers."""

    def read(*registers: str, top: str = "", **more: str) -> Any:
        text = exported_text(FORM, small(*registers, top=top), **more)
        return yaml.load(text, Reader)  # noqa: S506 - a safe one with the tags of the program

    return read


@pytest.fixture
def one(made: Made) -> Made:
    """The one entity of a platform in a map of one register."""

    def found(platform: str, *registers: str, **more: str) -> dict[str, Any]:
        (entity,) = made(*registers, **more)[platform]
        return dict(entity)

    return found


@pytest.fixture
def losses(export: Export, small: Small) -> Lost:
    """Grade and what was done of each loss, by its code."""

    def found(*registers: str, top: str = "", **more: str) -> dict[str, str]:
        made = export(FORM, small(*registers, top=top), **more)
        return {each.fact: f"{each.grade.name}: {each.done}" for each in made.losses}

    return found


READ = "access: r"


def test_a_register_is_a_sensor_with_its_wire_address(one: Made) -> None:
    assert one("sensor", f"at: 9, name: Level, type: uint16, {READ}", name="oven") == {
        "platform": "modbus_controller",
        "modbus_controller_id": "oven",
        "id": "oven_level",
        "name": "oven Level",
        "register_type": "holding",
        "address": 9,
        "value_type": "U_WORD",
        "accuracy_decimals": 0,
    }


def test_an_input_register_is_called_read(one: Made) -> None:
    assert (
        one("sensor", f"at: 9, name: Level, space: input, {READ}", top="protocol: {functions: [3, 4]}")["register_type"]
        == "read"
    )


def test_the_file_has_a_bus_with_the_line_of_the_map(made: Made) -> None:
    found = made(
        "at: 0, name: A", top="protocol: {serial: {default: '19200 8E1'}, latency: {3: {fixed: 0..1500}}}", name="oven"
    )
    assert found["uart"] == [{"id": "oven_uart", "baud_rate": 19200, "data_bits": 8, "parity": "EVEN", "stop_bits": 1}]
    assert found["modbus"] == [{"id": "oven_modbus", "uart_id": "oven_uart", "send_wait_time": "2000ms"}]
    (controller,) = found["modbus_controller"]
    assert controller == {"id": "oven", "modbus_id": "oven_modbus", "address": 1, "update_interval": "10s"}


def test_a_bus_of_ones_own_brings_none(made: Made) -> None:
    found = made("at: 0, name: A", bus="line")
    assert not {"uart", "modbus"} & found.keys()
    assert found["modbus_controller"][0]["modbus_id"] == "line"


def test_an_id_that_is_none_is_refused(export: Export, small: Small) -> None:
    with pytest.raises(OptionError, match="--bus a b"):
        export(FORM, small("at: 0, name: A"), bus="a b")


@pytest.mark.parametrize(
    ("words", "value_type"),
    [
        ("type: uint32", "U_DWORD"),
        ("type: uint32, word_order: little", "U_DWORD_R"),
        ("type: int64, word_order: little", "S_QWORD_R"),
        ("type: float32", "FP32"),
        ("type: float32, word_order: little", "FP32_R"),
    ],
)
def test_types_say_the_order_of_words(one: Made, words: str, value_type: str) -> None:
    assert one("sensor", f"at: 0, name: A, {words}, {READ}")["value_type"] == value_type


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("type: uint32, byte_order: little", "bytes of a word swapped"),
        ("type: float64", "does not read float64"),
        ("type: float16", "does not read float16"),
        ("type: int8", "does not read int8"),
        ("type: string, length: 4, byte_order: little", "does not read string"),
        ("type: string, length: 4, text: utf-16", "UTF-8 or ASCII"),
        ("type: string, length: 125", None),
        ("type: string, length: 126", "sends 125 at once"),
    ],
)
def test_what_it_cannot_read_is_left_out_with_the_reason(
    export: Export, small: Small, words: str, why: str | None
) -> None:
    made = export(FORM, small("at: 0, name: A", f"at: 9, name: B, {words}, {READ}"))
    found = [loss.done for loss in made.losses if loss.fact == "register"]
    assert len(found) == (why is not None)
    assert not why or why in found[0]


def test_filters_mark_faults_before_they_scale_and_move(one: Made) -> None:
    found = one(
        "sensor",
        f"at: 0, name: A, multiply: 0.25, add: -40, sentinels: {{-32768: broken, 32000..32767: short}}, {READ}",
    )
    assert found["filters"] == [
        {"lambda": ("lambda", "return x == -32768.0f ? NAN : x;")},
        {"lambda": ("lambda", "return x >= 32000.0f && x <= 32767.0f ? NAN : x;")},
        {"multiply": 0.25},
        {"offset": -40},
    ]
    assert found["accuracy_decimals"] == 2


def test_trap_8_digits_that_a_float_of_32_bits_does_not_have_are_told(losses: Lost) -> None:
    assert losses(f"at: 0, name: A, type: uint32, {READ}")["precision-float32"].startswith("WRONG")
    assert "below zero" in losses(f"at: 0, name: A, type: uint64, {READ}")["precision-float32"]
    assert "precision-float32" not in losses(f"at: 0, name: A, type: uint16, {READ}")


def test_a_fault_word_beyond_the_digits_of_a_float_is_told(losses: Lost) -> None:
    assert losses(f"at: 0, name: A, type: uint32, sentinels: {{4294967295: broken}}, {READ}")["sentinel"].startswith(
        "WRONG"
    )
    assert "sentinel" not in losses(f"at: 0, name: A, type: uint32, sentinels: {{65535: broken}}, {READ}")


def test_what_is_no_number_needs_no_filter(one: Made) -> None:
    assert "filters" not in one("sensor", f"at: 0, name: A, type: float32, sentinels: {{nan: absent}}, {READ}")


def test_a_number_is_divided_by_multiply_and_has_its_limits(one: Made) -> None:
    found = one("number", "at: 0, name: A, decimals: 1, range: -50..400, access: rw")
    assert {key: found[key] for key in ("min_value", "max_value", "step", "multiply")} == {
        "min_value": -50,
        "max_value": 400,
        "step": 0.1,
        "multiply": 10,
    }
    assert not {"lambda", "write_lambda"} & found.keys()


def test_a_number_that_is_set_in_coarse_steps_offers_these(one: Made, losses: Lost) -> None:
    row = "at: 0, name: A, decimals: 2, step: 0.5, range: 0..40, access: rw"
    assert one("number", row)["step"] == 0.5
    assert losses(row)["step"] == "LOST: offered to users: a value between two steps is written as it comes"


def test_a_number_with_an_offset_has_lambdas(one: Made) -> None:
    # value = 0.1 raw - 40, so raw = (value + 40) / 0.1
    found = one("number", "at: 0, name: A, multiply: 0.1, add: -40, range: -40..100, access: rw")
    assert found["lambda"] == ("lambda", "return x * 0.1f + -40.0f;")
    assert found["write_lambda"] == ("lambda", "return (x - -40.0f) * 10.0f;")
    assert "multiply" not in found


def test_a_number_whose_factor_has_no_finite_inverse_is_divided(one: Made) -> None:
    found = one("number", "at: 0, name: A, multiply: 0.3, range: 0..30, access: rw")
    assert found["write_lambda"] == ("lambda", "return (x - 0.0f) / 0.3f;")


def test_a_fault_word_of_a_number_is_none(one: Made) -> None:
    found = one("number", "at: 0, name: A, range: 0..30, sentinels: {-1: broken}, access: rw")
    assert found["lambda"] == ("lambda", "if (x == -1.0f) return NAN; return x * 1.0f + 0.0f;")


def test_limits_beyond_24_bits_are_cut_and_told(one: Made, losses: Lost) -> None:
    wide = "at: 0, name: A, type: uint32, range: 0..4000000000, access: rw"
    found = one("number", wide)
    assert (found["min_value"], found["max_value"]) == (0, 16777215)
    assert losses(wide)["range"].endswith("written from 0 to 16777215 only, of 0 to 4000000000")


def test_without_a_range_the_type_is_the_limit(one: Made) -> None:
    found = one("number", "at: 0, name: A, type: int16, decimals: 1, access: rw")
    assert (found["min_value"], found["max_value"]) == (-3276.8, 3276.7)


def test_that_a_refused_write_is_shown_is_told(losses: Lost) -> None:
    assert "refused or not" in losses("at: 0, name: A, range: 0..9, access: rw")["write-echo"]


@pytest.mark.parametrize(
    "more",
    [
        "danger: It starts.",
        "writable: {when: {mode: 1}, reason: only then}",
        "range: {from: 0, to: mode}",
        "write_at: 50",
    ],
)
def test_a_write_that_is_not_free_or_not_known_makes_a_sensor(made: Made, losses: Lost, more: str) -> None:
    registers = f"at: 9, name: Mode, type: uint16, {READ}", f"at: 0, name: A, access: rw, {more}"
    assert "number" not in made(*registers)
    assert losses(*registers)["write"].startswith("LOST: read only")


def test_one_register_is_written_by_the_function_that_there_is(one: Made) -> None:
    setting = "at: 0, name: A, range: 0..9, access: rw"
    assert one("number", setting, top="protocol: {functions: [3, 16]}")["use_write_multiple"] is True
    assert "use_write_multiple" not in one("number", setting, top="protocol: {functions: [3, 6, 16]}")


def test_two_registers_without_function_16_are_read_only(made: Made) -> None:
    assert "number" not in made("at: 0, name: A, type: uint32, access: rw", top="protocol: {functions: [3, 6]}")


def test_codes_that_are_written_are_a_choice(one: Made) -> None:
    found = one("select", "at: 0, name: A, type: uint16, enum: {0: off, 3: slow}, access: rw")
    assert found["optionsmap"] == {"off": 0, "slow": 3}
    assert "register_type" not in found


def test_labels_that_are_the_same_have_their_codes_behind(one: Made) -> None:
    found = one(
        "select",
        "at: 0, name: A, type: uint16, enum: {0: {label: reserved, id: a}, 1: {label: reserved, id: b}}, access: rw",
    )
    assert found["optionsmap"] == {"reserved (0)": 0, "reserved (1)": 1}


def test_codes_that_are_read_are_numbers_and_told(one: Made, losses: Lost) -> None:
    codes = f"at: 0, name: A, type: uint16, enum: {{0: off, 3: slow}}, {READ}"
    assert one("sensor", codes)["value_type"] == "U_WORD"
    assert losses(codes)["enum"].startswith("LOST")


def test_flags_are_binary_sensors_in_the_word_that_has_them(made: Made) -> None:
    found = made(f"at: 40, name: A, type: uint32, flags: {{0: run, 17: door}}, {READ}")["binary_sensor"]
    assert [(each["id"].rpartition("_")[2], each["address"], each["bitmask"]) for each in found] == [
        ("run", 41, 1),
        ("door", 40, 2),
    ]
    found = made(f"at: 40, name: A, type: uint32, word_order: little, flags: {{0: run, 17: door}}, {READ}")[
        "binary_sensor"
    ]
    assert [each["address"] for each in found] == [40, 41]


def test_parts_of_a_word_are_sensors_with_a_mask(made: Made) -> None:
    parts = "fields: {zone: {bits: 0..3}, level: {bits: 4..11, multiply: 0.5, unit: '%'}, alarm: {bit: 15}}"
    found = made(f"at: 0, name: A, type: uint16, {parts}, {READ}")
    zone, level = found["sensor"]
    assert (zone["bitmask"], level["bitmask"]) == (0x000F, 0x0FF0)
    assert (level["filters"], level["unit_of_measurement"]) == ([{"multiply": 0.5}], "%")
    assert (zone["accuracy_decimals"], level["accuracy_decimals"]) == (0, 1)
    assert [each["bitmask"] for each in found["binary_sensor"]] == [0x8000]


def test_signed_parts_stay_in_their_word_and_are_told(one: Made, losses: Lost) -> None:
    signed = f"at: 0, name: A, type: uint16, fields: {{a: {{bits: 0..7, type: signed}}, b: {{bits: 8..11}}}}, {READ}"
    assert "bitmask" not in one("sensor", signed)
    assert losses(signed)["fields"].startswith("LOST")


def test_one_byte_of_a_word_has_a_mask(made: Made) -> None:
    found = made(f"at: 0, name: A, type: uint8, {READ}", f"at: 1, name: B, type: uint8, byte: high, {READ}")["sensor"]
    assert [(each["value_type"], each["bitmask"]) for each in found] == [("U_WORD", 0x00FF), ("U_WORD", 0xFF00)]


def test_a_coil_is_a_switch_and_a_contact_a_binary_sensor(made: Made) -> None:
    top = "protocol: {functions: [1, 2, 3, 5]}"
    found = made("at: 3, name: Pump, space: coil, access: rw", f"at: 4, name: Door, space: discrete, {READ}", top=top)
    assert [(each["register_type"], each["address"]) for each in found["switch"]] == [("coil", 3)]
    assert [(each["register_type"], each["address"]) for each in found["binary_sensor"]] == [("discrete_input", 4)]


def test_a_truth_value_of_a_word_is_its_lowest_bit(one: Made, losses: Lost) -> None:
    word = "at: 3, name: Pump, type: uint16, kind: boolean, access: rw"
    assert one("switch", word)["bitmask"] == 1
    assert losses(word)["truth-of-words"].startswith("WRONG")


def test_a_version_is_the_number_that_packs_it_and_told_so(one: Made, losses: Lost) -> None:
    version = "at: 0, name: A, type: uint16, version: n.n.n, access: rw"
    assert one("sensor", version)["value_type"] == "U_WORD"
    assert losses(version)["version"].startswith("LOST")
    assert losses(version)["write"].startswith("LOST: read only")


def test_a_text_is_read_by_its_bytes(one: Made) -> None:
    found = one("text_sensor", f"at: 3, name: Text, type: string, length: 4, {READ}")
    assert (found["register_count"], found["response_size"], found["raw_encode"]) == (4, 8, "ANSI")


def requests(found: dict[str, Any], words: int = 1) -> list[int]:
    """How many registers each request has, as the component makes them of sensors of so many words."""
    alone = [each["address"] for each in found["sensor"] if each.get("force_new_range")]
    rest = [each["address"] for each in found["sensor"] if not each.get("force_new_range")]
    runs: list[list[int]] = []
    for address in rest:
        if runs and address == runs[-1][-1] + words:
            runs[-1].append(address)
        else:
            runs.append([address])
    return [words] * len(alone) + [words * len(run) for run in runs]


@pytest.mark.parametrize(("most", "words"), [(4, 1), (4, 2), (5, 2), (1, 1)])
def test_no_request_is_longer_than_the_device_allows(made: Made, most: int, words: int) -> None:
    kind = "uint16" if words == 1 else "uint32"
    registers = [f"at: {words * at}, name: A{at}, type: {kind}, {READ}" for at in range(11)]
    found = made(*registers, top=f"protocol: {{limits: {{read_words: {most}}}}}")
    assert max(requests(found, words)) <= most
    assert sum(requests(found, words)) == 11 * words


def test_neighbours_stay_in_one_request_where_they_may(made: Made) -> None:
    found = made(*(f"at: {at}, name: A{at}, {READ}" for at in range(125)))
    assert requests(found) == [125]
    found = made(*(f"at: {at}, name: A{at}, {READ}" for at in range(126)))
    assert sorted(requests(found)) == [1, 125]
    found = made(*(f"at: {at}, name: A{at}, {READ}" for at in range(11)), top="protocol: {limits: {read_words: 4}}")
    assert sorted(requests(found)) == [1, 1, 1, 4, 4]  # 0..3, 4, 5..8, 9, 10


def test_all_bits_of_a_forced_word_are_forced(made: Made) -> None:
    flags = "flags: {0: run, 1: door}"
    found = made(
        f"at: 0, name: A, {READ}", f"at: 1, name: B, {flags}, {READ}", top="protocol: {limits: {read_words: 1}}"
    )
    assert [each["force_new_range"] for each in found["binary_sensor"]] == [True, True]


def test_of_two_lengths_at_one_address_one_is_left_out(export: Export, small: Small) -> None:
    both = f"at: 0, name: Long, type: uint32, {READ}", f"at: 0, name: Short, type: uint16, {READ}"
    made = export(FORM, small(*both))
    assert [loss.register for loss in made.losses if loss.fact == "register"] == ["short"]
    assert "Short" not in str(made.texts[""])


def test_a_pause_is_a_throttle_and_told_to_be_counted_otherwise(made: Made, losses: Lost) -> None:
    top = "protocol: {pause: 50}"
    assert made("at: 0, name: A", top=top)["modbus_controller"][0]["command_throttle"] == "50ms"
    assert "from the request" in losses("at: 0, name: A", top=top)["pause"]


def test_names_are_told_apart_as_the_program_does(made: Made) -> None:
    found = made(f"at: 0, id: a, name: Lével, {READ}", f"at: 1, id: b, name: 'L{chr(0xE8)}vel', {READ}", name="x")[
        "sensor"
    ]
    assert [each["name"] for each in found] == ["x Lével (a)", "x Lèvel (b)"]


def test_a_long_name_and_a_slash_are_changed_and_told(one: Made, losses: Lost) -> None:
    long = f"at: 0, id: a, name: '{'ä' * 100}/', {READ}"
    assert len(one("sensor", long)["name"].encode()) <= 120
    assert losses(long)["name"].startswith("COSMETIC")
    assert one("sensor", f"at: 0, id: a, name: 'On/Off', {READ}", name="x")["name"] == "x On\u2044Off"


@pytest.mark.parametrize("name", ["${x}", "$x", "<% x %>", "costs 5 $"])
def test_nothing_is_replaced_or_calculated_in_a_name(one: Made, name: str) -> None:
    assert one("sensor", f"at: 0, id: a, name: '{name}', {READ}", name="x")["name"] == ("literal", f"x {name}")


@pytest.mark.parametrize("name", ["!lambda return 1;", "!secret door", "a: b # c", "{{ x }}", "-", "on", "&a"])
def test_hostile_names_are_texts(one: Made, name: str) -> None:
    assert one("sensor", f"at: 0, id: a, name: '{name}', {READ}", name="x")["name"] == f"x {name}"


def test_hostile_labels_and_units_are_texts(made: Made) -> None:
    found = made(
        "at: 0, name: A, type: uint16, enum: {0: '${x}', 1: '!lambda x'}, access: rw",
        f"at: 1, name: B, unit: '$u', {READ}",
        top="units: {$u: {description: odd}}",
    )
    assert list(found["select"][0]["optionsmap"]) == [("literal", "${x}"), "!lambda x"]
    assert found["sensor"][0]["unit_of_measurement"] == ("literal", "$u")


def test_the_head_names_the_program_that_read_it(exported_text: Text, small: Small) -> None:
    assert exported_text(FORM, small("at: 0, name: A")).splitlines()[2] == "# esphome: verified with ESPHome 2026.6.5"


def test_parts_of_four_words_stay_in_their_number_and_are_told(one: Made, losses: Lost) -> None:
    # the component takes no mask for them
    wide = f"at: 0, name: A, type: uint64, fields: {{a: {{bits: 0..7}}, b: {{bits: 40..43}}}}, {READ}"
    assert "bitmask" not in one("sensor", wide)
    assert losses(wide)["fields"].startswith("LOST")


def test_a_fault_of_a_part_is_no_value(one: Made, losses: Lost) -> None:
    half = "a: {bits: 0..7, multiply: 0.5, sentinels: {255: absent}}"
    parts = f"at: 0, name: A, type: uint16, fields: {{{half}}}, {READ}"
    assert one("sensor", parts)["filters"] == [
        {"lambda": ("lambda", "return x == 255.0f ? NAN : x;")},
        {"multiply": 0.5},
    ]
    assert losses(parts)["sentinel-label"].endswith("255 = absent")


def test_a_range_beyond_the_limits_of_the_component_is_read_only(made: Made) -> None:
    # it refuses a lowest limit above the highest
    assert "number" not in made("at: 0, name: A, type: uint32, range: 20000000..30000000, access: rw")
