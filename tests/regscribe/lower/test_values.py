from collections.abc import Callable
from fractions import Fraction

import pytest

from regscribe.model import (
    ALWAYS,
    IDENTITY,
    Access,
    BitField,
    Case,
    Condition,
    Conversion,
    Decimals,
    Interval,
    Kind,
    Member,
    Open,
    Range,
    Ref,
    Register,
    Sentinel,
    Special,
    always,
)
from regscribe.model import Is as Asked

Registers = Callable[..., dict[str, Register]]

LINEAR = Condition((Asked("kind", codes=((Fraction(1), Fraction(1)),)),), name="linear")
TABLES = """
    conditions:
      linear: {kind: 1}
      other: {kind: {not: 1}}
    decimals:
      digits: {register: digits, when: linear, at_most: 3, step: 1}
      tenths: {register: digits, at_most: 1}
    scales:
      span: [{when: linear, from: -19999, to: 45536}, {when: {kind: 2}, multiply: 0.5, add: 3}, {decimals: 1}]
"""
BASICS = "- {at: 0, name: Kind, id: kind, range: 0..9}\n- {at: 1, name: Digits, range: 0..3}\n"
DIGITS = Decimals("digits", 3)


def spanned(low: int, high: int, decimals: Decimals | None = None) -> Range:
    return Range((Interval(Fraction(low), Fraction(high)),), decimals)


def value(registers: Registers, keys: str) -> Register:
    return registers(f"{BASICS}- {{at: 2, name: Value, {keys}}}", tables=TABLES)["value"]


def test_a_plain_register_is_an_integer_without_scale(registers: Registers) -> None:
    found = value(registers, "range: 0..9")
    assert (found.kind, found.access, found.scale) == (Kind.INTEGER, Access.READ_WRITE, always(IDENTITY))


def test_fixed_decimals_divide_by_a_power_of_ten(registers: Registers) -> None:
    found = value(registers, "decimals: 2, range: 0..9")
    assert found.scale == always(Conversion(multiply=Fraction(1, 100)))
    assert found.kind is Kind.NUMBER


def test_a_scale_from_end_to_end_is_affine_over_the_whole_type_and_gives_the_range(registers: Registers) -> None:
    found = value(registers, "scale: -1999.9..4553.6")
    assert found.scale == always(Conversion(multiply=Fraction(1, 10), add=Fraction("1276.9")))
    assert found.range == always(Range((Interval(Fraction("-1999.9"), Fraction("4553.6")),)))


def test_a_scale_that_falls_gives_its_range_in_order(registers: Registers) -> None:
    assert value(registers, "scale: 100..-100").range == always(spanned(-100, 100))


def test_a_named_scale_keeps_its_cases(registers: Registers) -> None:
    found = value(registers, "scale: span")
    assert found.scale == (
        Case(LINEAR, Conversion(multiply=Fraction(1), add=Fraction(12769))),
        Case(
            Condition((Asked("kind", codes=((Fraction(2), Fraction(2)),)),)),
            Conversion(Fraction(1, 2), Fraction(3)),
        ),
        Case(ALWAYS, Conversion(multiply=Fraction(1, 10))),
    )
    assert found.range[0] == Case(LINEAR, spanned(-19999, 45536))
    assert isinstance(found.range[2].then.intervals[0].low, Open)


def test_a_decimals_rule_is_identity_where_its_condition_does_not_hold(registers: Registers) -> None:
    found = value(registers, "decimals: digits, range: 0..9")
    assert found.scale == (Case(LINEAR, Conversion(decimals=DIGITS, step=Fraction(1))), Case(ALWAYS, IDENTITY))


def test_range_decimals_split_each_case_that_has_a_number(registers: Registers) -> None:
    found = value(registers, "decimals: digits, range: -5..9, range_decimals: digits")
    assert found.range == (Case(LINEAR, spanned(-5, 9, DIGITS)), Case(ALWAYS, spanned(-5, 9)))


def test_range_decimals_leave_cases_of_references_alone(registers: Registers) -> None:
    found = value(registers, "range: {from: kind, to: {open: span of sensor}}, range_decimals: digits")
    assert found.range == always(Range((Interval(Ref("kind"), Open("span of sensor")),)))


def test_range_decimals_make_no_case_that_can_never_be_reached(registers: Registers) -> None:
    cases = "[{when: linear, is: 1..5}, {when: other, is: 2..6}]"
    found = value(registers, f"range: {cases}, range_decimals: digits")
    assert [(case.when.name, case.then) for case in found.range] == [
        ("linear", spanned(1, 5, DIGITS)),
        ("other", spanned(2, 6)),
    ]


def test_range_decimals_without_condition_count_always(registers: Registers) -> None:
    found = value(registers, "range: 1..5, range_decimals: tenths")
    assert found.range == always(spanned(1, 5, Decimals("digits", 1)))


def test_a_union_of_ranges_stays_one_range(registers: Registers) -> None:
    found = value(registers, "decimals: 1, range: [0..0.9, {from: 1, to: 2400}]")
    low, high = found.range[0].then.intervals
    assert low == Interval(Fraction(0), Fraction(9, 10))
    assert high == Interval(Fraction(1), Fraction(2400))


@pytest.mark.parametrize(
    ("keys", "kind"),
    [
        ("decimals: not_stated", Kind.RAW),
        ("decimals: 0", Kind.INTEGER),
        ("type: float32", Kind.NUMBER),
        ("type: string, length: 2", Kind.STRING),
        ("type: bit, space: coil", Kind.BOOLEAN),
        ("enum: {0: a, 1: b}", Kind.ENUM),
        ("flags: {0: a, 1: b}", Kind.FLAGS),
        ("fields: {a: {bits: 0..3}}", Kind.FIELDS),
        ("type: uint32, version: nn.nn.nn", Kind.VERSION),
        ("range: 1..9, special: {0: {label: a fifth, means: 0.2}}", Kind.NUMBER),
        ("range: 1..9, special: {0: {label: one, means: 1}}", Kind.INTEGER),
        ("kind: raw", Kind.RAW),
    ],
)
def test_the_kind_follows_from_the_other_keys(registers: Registers, keys: str, kind: Kind) -> None:
    assert value(registers, keys).kind is kind


def test_members_have_ids_in_capitals_and_invalid_codes_are_kept_apart(registers: Registers) -> None:
    found = value(registers, "enum: {1: inactive (disabled), 2: {label: on/off, id: ON_OFF}, 3: {invalid: not used}}")
    assert found.enum.id == "value"
    assert found.enum.members == (Member(1, "inactive (disabled)", "INACTIVE_DISABLED"), Member(2, "on/off", "ON_OFF"))
    assert found.enum.invalid == ((3, "not used"),)


def test_a_member_of_one_model_is_no_member_on_the_others(registers: Registers) -> None:
    members = "1: PID, 5: {label: alarm, models: [A1], invalid: not here}, 6: {label: fan, models: [A1]}"
    line = f"- {{at: 1, name: Output, enum: {{{members}}}}}"
    here, there = (registers(line, model=model)["output"].enum for model in ("A1", "B-2"))
    assert [member.code for member in here.members] == [1, 5, 6]
    assert here.invalid == ()
    assert [member.code for member in there.members] == [1]
    assert there.invalid == ((5, "not here"),)


def test_specials_and_sentinels_have_ids_like_members(registers: Registers) -> None:
    found = value(registers, "range: 4..9, special: {3: never on}, sentinels: {-32768: sensor low}")
    assert found.specials == (Special(Fraction(3), "never on", "NEVER_ON"),)
    assert found.sentinels == (Sentinel(Fraction(-32768), "SENSOR_LOW", "sensor low"),)


@pytest.mark.parametrize(
    ("keys", "default"),
    [
        ("enum: {0: a, 7: slow mode}, default: slow_mode", Fraction(7)),
        ("enum: {0: a, 7: slow mode}, default: SLOW_MODE", Fraction(7)),
        ("range: 4..9, special: {3: 'off'}, default: 'off'", Fraction(3)),
        ("decimals: 1, default: 12.5", Fraction(25, 2)),
        ("type: string, length: 2, default: M3", "M3"),
        ("type: uint32, version: nn.nn, default: '01.31'", "01.31"),
        ("range: 0..9", None),
    ],
)
def test_a_default_is_a_value_of_use(registers: Registers, keys: str, default: Fraction | str | None) -> None:
    assert value(registers, keys).default == default


def test_flags_and_fields_are_bit_fields(registers: Registers) -> None:
    assert value(registers, "flags: {3: Sensor fault}").fields == (BitField("sensor_fault", "Sensor fault", 3, 3),)
    found = value(registers, "fields: {hold: {bit: 7, label: Hold}, phase: {bits: 0..2, models: [A1]}}").fields
    assert found == (BitField("hold", "Hold", 7, 7), BitField("phase", "phase", 0, 2))


def test_a_field_can_be_on_one_model_only(registers: Registers) -> None:
    line = "- {at: 1, name: Word, fields: {hold: {bit: 7}, phase: {bits: 0..2, except: [B-2]}}}"
    assert [part.id for part in registers(line, model="B-2")["word"].fields] == ["hold"]


def test_a_version_pattern_counts_digits_and_groups(registers: Registers) -> None:
    found = value(registers, "type: uint32, version: nn.nn.nn")
    assert (found.version_digits, found.version_group) == (6, 2)


def test_a_unit_with_cases_keeps_its_id(registers: Registers) -> None:
    tables = (
        "units:\n  temperature: [{when: {scale: 1}, symbol: °F}, {symbol: °C}]\n  lamps: {description: How many.}\n"
    )
    lines = """
        - {at: 0, name: Scale, range: 0..1, rescales: temperature}
        - {at: 1, name: Level, unit: temperature}
        - {at: 2, name: Count, unit: lamps}
    """
    found = registers(lines, tables=tables)
    assert [case.then for case in found["level"].unit] == ["°F", "°C"]
    assert found["level"].unit_id == "temperature"
    assert (found["count"].unit, found["count"].unit_id) == (always("lamps"), "")
    assert found["scale"].rescales == "temperature"


def test_decimals_of_a_stored_value_say_how_fine_it_is_and_divide_nothing(registers: Registers) -> None:
    tables = """
    decimals:
      kept:
        - {register: digits, when: {kind: 1}, step: 1}
        - {register: digits, at_most: 1, stores: value}
"""
    keys = "type: int16, decimals: kept, range: 0..9, range_decimals: kept"
    found = registers(f"{BASICS}- {{at: 2, name: Value, {keys}}}", tables=tables)["value"]
    first = Condition((Asked("kind", codes=((Fraction(1), Fraction(1)),)),))
    assert found.scale == (
        Case(first, Conversion(decimals=Decimals("digits"), step=Fraction(1))),
        Case(ALWAYS, Conversion(step=Fraction(1), places=Decimals("digits", 1))),
    )
    assert found.range == (Case(first, spanned(0, 9, Decimals("digits"))), Case(ALWAYS, spanned(0, 9)))


@pytest.mark.parametrize(("text", "code"), [("second", 2), ("1", 1)])
def test_what_is_delivered_may_differ_from_the_default(registers: Registers, text: str, code: int) -> None:
    found = value(registers, f"enum: {{1: first, 2: second}}, default: 1, delivered: {text}")
    assert (found.default, found.delivered) == (Fraction(1), Fraction(code))
    assert value(registers, "default: 1").delivered is None
