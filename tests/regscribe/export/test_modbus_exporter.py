"""modbus_exporter: metrics by the conventions of Prometheus, and what one scrape must not ask for."""

from collections.abc import Callable
from decimal import Decimal
from typing import Any

import pytest

from regscribe import source
from regscribe.losses import Exported
from regscribe.plugins import OptionError

Text = Callable[..., str]
Small = Callable[..., str]
Export = Callable[..., Exported]
Lost = Callable[[Exported], set[tuple[str, str, str]]]
Metrics = Callable[..., list[dict[str, Any]]]
AT = "10.0.0.7:1502"


@pytest.fixture
def module(exported_text: Text, small: Small) -> Callable[..., dict[str, Any]]:
    """The module made of these registers, as a reader of YAML takes it."""

    def made(*registers: str, **more: str) -> dict[str, Any]:
        text = exported_text("modbus-exporter", small(*registers, **more), at=AT)
        document, found = source.parse(text.encode(), name="t", escapes=True)
        assert document is not None, found
        (one,) = document.data["modules"]
        return dict(one)

    return made


@pytest.fixture
def metrics(module: Callable[..., dict[str, Any]]) -> Metrics:
    """Its metrics."""
    return lambda *registers, **more: list(module(*registers, **more)["metrics"])


@pytest.mark.parametrize(("space", "address"), [("holding", 300010), ("input", 400010)])
def test_trap_3_the_first_digit_is_the_function(metrics: Metrics, space: str, address: int) -> None:
    (found,) = metrics(f"at: 10, name: A, access: r, space: {space}")
    assert found["address"] == address


def test_address_0_is_no_lone_digit(metrics: Metrics) -> None:
    (found,) = metrics("at: 0, name: A")
    assert found["address"] == 300000


@pytest.mark.parametrize(
    ("said", "endianness"),
    [
        ("type: int32", "big"),
        ("type: int32, word_order: little", "yolo"),
        ("type: int32, byte_order: little", "mixed"),
        ("type: int64, word_order: little, byte_order: little", "little"),
        ("type: uint16, byte_order: little", "little"),
    ],
)
def test_orders_have_its_names_and_one_word_is_turned_by_little(metrics: Metrics, said: str, endianness: str) -> None:
    (found,) = metrics(f"at: 10, name: A, {said}")
    assert found["endianness"] == endianness


def test_a_name_ends_in_the_base_unit_and_the_factor_leads_there(metrics: Metrics) -> None:
    found = metrics(
        "at: 0, name: Oven, decimals: 1, unit: °C",
        "at: 1, name: Load, type: uint16, decimals: 2, unit: kWh",
        "at: 2, name: Level, unit: '%'",
    )
    assert [(one["name"], one.get("factor")) for one in found] == [
        ("controller_oven_celsius", Decimal("0.1")),
        ("controller_load_joules", 36000),
        ("controller_level_ratio", Decimal("0.01")),
    ]


def test_a_unit_that_is_converted_or_not_known_is_told(export: Export, small: Small, lost: Lost) -> None:
    text = small("at: 0, name: A, unit: mV", "at: 1, name: B, unit: clicks", top="units: {clicks: {description: c}}")
    found = {one for one in lost(export("modbus-exporter", text, at=AT)) if one[1].startswith("unit")}
    assert found == {("a", "unit-base", "COSMETIC"), ("b", "unit-unmapped", "COSMETIC")}


def test_names_do_not_end_as_those_of_counters_and_have_no_types(metrics: Metrics) -> None:
    found = metrics("at: 0, name: Total", "at: 1, name: Event Counter", "at: 2, name: Watts, unit: W")
    assert [one["name"] for one in found] == [
        "controller_total_value",
        "controller_event_counters",
        "controller_watts",
    ]
    assert {one["metricType"] for one in found} == {"gauge"}


def test_elements_of_an_array_have_one_name_and_a_label(metrics: Metrics) -> None:
    array = "id: zones, name: Zone, repeat: 1..2, stride: 1, registers: [{at: 0, name: Level}]"
    assert [(one["name"], one["help"], one["labels"]) for one in metrics(array)] == [
        ("controller_zones_level", "Level", {"zones": "1"}),
        ("controller_zones_level", "Level", {"zones": "2"}),
    ]


def test_a_name_with_other_labels_is_another_name(metrics: Metrics) -> None:
    array = "id: zones, name: Zone, repeat: 1..2, stride: 1, registers: [{at: 0, name: Level}]"
    names = [one["name"] for one in metrics("at: 9, name: Zones Level", array)]
    assert names == ["controller_zones_level", "controller_zones_level_2", "controller_zones_level_2"]


def test_a_number_with_an_offset_is_exported_raw_and_graded_as_wrong(
    export: Export, small: Small, lost: Lost, metrics: Metrics
) -> None:
    register = "at: 0, name: A, multiply: 0.1, add: -40, unit: °C"
    (found,) = metrics(register)
    assert found["name"] == "controller_a_raw"
    assert "factor" not in found
    assert found["help"] == "A; 0.1 times this and -40 is the value in °C"
    assert ("a", "offset", "WRONG") in lost(export("modbus-exporter", small(register), at=AT))


@pytest.mark.parametrize(
    ("order", "address", "bit"),
    [("", 300005, 1), ("word_order: little, ", 300006, 1), ("byte_order: little, ", 300005, 9)],
)
def test_a_bit_is_that_of_its_word_whose_bytes_are_never_turned(
    metrics: Metrics, order: str, address: int, bit: int
) -> None:
    (found,) = metrics(f"at: 5, name: S, type: uint32, {order}access: r, flags: {{17: bad}}")
    assert (found["address"], found["dataType"], found["bitOffset"]) == (address, "bool", bit)
    assert not found.keys() & {"factor", "endianness"}


def test_coils_would_break_the_exporter_and_float16_too(export: Export, small: Small) -> None:
    text = small("at: 0, name: A", "at: 0, name: C, space: coil", "at: 1, name: F, type: float16")
    made = export("modbus-exporter", text, at=AT)
    assert {one.register for one in made.losses if one.fact == "register"} == {"c", "f"}


def test_one_failing_metric_fails_the_scrape_so_conditional_registers_are_named_or_left_out(
    export: Export, small: Small
) -> None:
    text = small("at: 0, name: Mode, enum: {0: off, 1: on}, default: 1", "at: 1, name: B, when: {mode: on}")
    (loss,) = [one for one in export("modbus-exporter", text, at=AT).losses if one.fact == "register"]
    assert (loss.register, "fails the whole scrape" in loss.done) == ("b", True)
    named = export("modbus-exporter", text, at=AT, register="b")
    assert "controller_b" in str(named.texts[""])
    assert ("b", "condition", "WRONG") in {(one.register, one.fact, one.grade.name) for one in named.losses}


def test_labels_of_codes_stand_in_the_help_text(metrics: Metrics) -> None:
    (found,) = metrics("at: 0, name: Mode, enum: {0: off, 1: 'on {{ x }} \"y\"'}")
    assert found["help"] == 'Mode; 0 = off, 1 = on {{ x }} "y"'


def test_a_pause_stands_between_two_requests(module: Callable[..., dict[str, Any]]) -> None:
    found = module("at: 0, name: A, access: r", top="protocol: {functions: [3], pause: 50}")
    assert found["workarounds"] == {"scrapeInterludeWait": "50ms"}


def test_a_serial_line_is_refused(export: Export, small: Small) -> None:
    with pytest.raises(OptionError, match="TCP only"):
        export("modbus-exporter", small("at: 0, name: A"), at="/dev/ttyS0")


def test_a_word_that_is_neither_0_nor_1_is_told_as_it_is(export: Export, small: Small, lost: Lost) -> None:
    made = export("modbus-exporter", small("at: 0, name: A, type: uint16, kind: boolean, access: r"), at=AT)
    assert ("a", "truth-of-words", "LOST") in lost(made)
