"""The CSV export keeps the contract of docs/export.md."""

import csv
import io
import json
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

from regscribe.export.csv import COLUMNS, csv_text
from regscribe.model import (
    Case,
    Condition,
    Conversion,
    Decimals,
    Interval,
    Kind,
    Range,
    Register,
    RegisterMap,
    Sentinel,
    Special,
    always,
)
from regscribe.model import Is as Ask

ISSUE_COLUMNS = (
    "map, model, id, name, symbol, space, address, words, aliases, access, kind, type, unit, minimum, maximum, "
    "default, values, bits, views, scale, persistence, group, section, block, page, exists, file, queue, unit_id, more"
)

Only = Callable[[Register], RegisterMap]


def table(*maps: RegisterMap) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(csv_text(maps), newline=""), strict=True))


def row(device: RegisterMap, path: str, model: str = "A1") -> dict[str, str]:
    return next(item for item in table(device) if item["id"] == path and item["model"] == model)


def test_the_columns_are_the_promised_ones_in_the_promised_order(device: RegisterMap) -> None:
    assert tuple(ISSUE_COLUMNS.split(", ")) == COLUMNS
    assert csv_text([device]).splitlines()[0] == ",".join(COLUMNS)


def test_every_value_of_every_model_has_one_row_in_the_order_of_the_manual(device: RegisterMap) -> None:
    found = [(item["model"], item["id"]) for item in table(device)]
    segments = ["segments[1].ramp_time", "segments[2].ramp_time", "load_defaults"]
    expected = [("A1", path) for path in ["input_type", "setpoint", *segments]]
    expected += [("A2", path) for path in ["input_type", "setpoint", "status", *segments]]
    assert found == expected


def test_addresses_are_decimal_wire_addresses_of_the_base_view(device: RegisterMap) -> None:
    setpoint = row(device, "setpoint")
    assert (setpoint["space"], setpoint["address"], setpoint["words"], setpoint["type"]) == (
        "holding",
        "1",
        "1",
        "int16",
    )
    assert setpoint["aliases"] == "101 201"


def test_views_hold_address_words_and_type_of_every_view(device: RegisterMap) -> None:
    assert json.loads(row(device, "setpoint")["views"]) == {
        "base": {"address": 1, "words": 1, "type": "int16"},
        "ieee": {"address": 8002, "words": 2, "type": "float32"},
    }


def test_array_elements_have_addresses_of_their_own(device: RegisterMap) -> None:
    assert [row(device, f"segments[{index}].ramp_time")["address"] for index in (1, 2)] == ["32", "34"]


def test_values_hold_members_specials_and_sentinels(device: RegisterMap) -> None:
    assert json.loads(row(device, "input_type")["values"]) == {"0": "J thermocouple", "13": "linear"}
    assert json.loads(row(device, "segments[1].ramp_time")["values"]) == {"0": "off"}
    assert json.loads(row(device, "setpoint")["values"]) == {"-32768": "sensor low"}


def test_bits_name_single_bits_and_fields_with_their_codes(device: RegisterMap) -> None:
    bits = json.loads(row(device, "status", model="A2")["bits"])
    assert bits == {"0": "alarm on", "8..11": "operation: 0 = normal, 3 = manual"}


def test_a_plain_range_gives_two_numbers(device: RegisterMap) -> None:
    ramp = row(device, "segments[1].ramp_time")
    assert (ramp["minimum"], ramp["maximum"], ramp["default"]) == ("0", "9600", "5")


def test_a_range_by_condition_gives_each_side_in_words(device: RegisterMap) -> None:
    setpoint = row(device, "setpoint")
    words = "temperature_input: open (sensor {0} limit); input_type is one of linear_inputs: {0}_limit"
    assert setpoint["minimum"] == words.format("low")
    assert setpoint["maximum"] == words.format("high")


def test_a_union_lists_its_limits_in_the_same_order_on_both_sides(only: Only, setpoint: Register) -> None:
    parts = [("0", "0.9"), ("1", "2400")]
    union = Range(tuple(Interval(Fraction(low), Fraction(high)) for low, high in parts))
    found = row(only(replace(setpoint, range=always(union))), "setpoint")
    assert (found["minimum"], found["maximum"]) == ("0 or 1", "0.9 or 2400")


def test_limits_with_decimals_from_a_register_say_so(only: Only, setpoint: Register) -> None:
    limits = Range((Interval(Fraction(0), Fraction(9999)),), Decimals("dp", at_most=3))
    found = row(only(replace(setpoint, range=always(limits))), "setpoint")
    assert (found["minimum"], found["maximum"]) == ("0", "9999/10^min(dp, 3)")


def test_limits_that_only_a_linear_input_divides_stand_as_the_table_prints_them(only: Only, setpoint: Register) -> None:
    limits = Range((Interval(Fraction(-1999), Fraction(9999)),))
    linear = Condition((Ask("kind", codes=((Fraction(2), Fraction(3)),)),))
    cases = (Case(linear, limits._replace(decimals=Decimals("dp"))), Case(Condition(), limits))

    found = row(only(replace(setpoint, range=cases)), "setpoint")

    assert (found["minimum"], found["maximum"]) == ("-1999", "9999")


def test_scales_are_readable_and_exact(device: RegisterMap) -> None:
    scale = row(device, "setpoint")["scale"]
    assert scale == ("temperature_input: x/10; input_type is one of linear_inputs: x/10 - 1999.9; otherwise: x")
    assert row(device, "input_type")["scale"] == ""


def test_an_affine_scale_without_a_decimal_factor_is_a_fraction(only: Only, setpoint: Register) -> None:
    affine = always(Conversion(Fraction(1, 3), Fraction(2), Decimals("dp")))
    assert row(only(replace(setpoint, scale=affine)), "setpoint")["scale"] == "(1/3*x + 2)/10^dp"


def test_a_raw_value_has_no_stated_scale(only: Only, setpoint: Register) -> None:
    assert row(only(replace(setpoint, kind=Kind.RAW)), "setpoint")["scale"] == "not stated"


def test_defaults_are_exact_decimals(device: RegisterMap) -> None:
    assert row(device, "setpoint")["default"] == "25.1"
    assert row(device, "status", model="A2")["default"] == ""


def test_commands_are_rows_with_the_words_they_write(device: RegisterMap) -> None:
    command = row(device, "load_defaults")
    assert (command["kind"], command["access"], command["space"]) == ("command", "w", "holding")
    assert (command["address"], command["words"]) == ("7000", "3")
    assert json.loads(command["values"]) == {"7000": "85 92", "7005": "1"}


def test_no_text_breaks_a_row(only: Only, setpoint: Register) -> None:
    hostile = 'a,b "c"\n;|\r\n\u2028 é 😀'
    register = replace(
        setpoint,
        name=hostile,
        specials=(Special(Fraction(0), hostile, "X"),),
        sentinels=(Sentinel(Fraction(1), "Y", hostile),),
    )
    text = csv_text([only(register)])
    assert text.count("\n") == 2
    assert text.endswith("\n")
    assert row(only(register), "setpoint")["name"] == 'a,b "c" ;| é 😀'


def test_the_text_has_no_carriage_return_and_no_trailing_blank(device: RegisterMap) -> None:
    text = csv_text([device])
    assert "\r" not in text
    assert all(line == line.rstrip() for line in text.split("\n"))


def test_maps_follow_in_the_given_order(device: RegisterMap) -> None:
    other = replace(device, id="acme/other")
    assert [item["map"] for item in table(device, other)] == ["acme/oven"] * 11 + ["acme/other"] * 11
