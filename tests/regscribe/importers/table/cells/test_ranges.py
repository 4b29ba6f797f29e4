"""Ranges of single cells, and whether those of a column count stored numbers or values."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.ranges import (
    Limits,
    Ranged,
    Settled,
    parse_limits,
    parse_range,
    settle_range,
    settle_ranges,
    stated_limits,
)
from regscribe.importers.table.cells.scales import PLAIN, Scale
from regscribe.model import WireType

TENTH = Scale(Fraction(1, 10))
INT16, UINT16 = WireType.INT16, WireType.UINT16


def limits(low: str, high: str) -> Limits:
    return Limits(Fraction(low), Fraction(high))


READ = {
    "0..100": limits("0", "100"),
    "0...100": limits("0", "100"),
    "0 to 100": limits("0", "100"),
    "0 bis 100": limits("0", "100"),
    "-50~150": limits("-50", "150"),
    "0-100": limits("0", "100"),
    "-10--5": limits("-10", "-5"),
    "-10 - -5": limits("-10", "-5"),
    "[0,100]": limits("0", "100"),
    "[0.5, 1.5]": limits("0.5", "1.5"),
    "(0;100)": limits("0", "100"),
    "\N{PLUS-MINUS SIGN}10": limits("-10", "10"),
    "0,0-100,5": limits("0", "100.5"),
    "0-50 Hz": limits("0", "50"),
    "10 \N{DEGREE SIGN}C .. 90 \N{DEGREE SIGN}C": limits("10", "90"),
    "1 000 to 2 000": limits("1000", "2000"),
    "0x0000-0xFFFF": limits("0", "65535"),
    "0..FFFFh": limits("0", "65535"),
    "-3276.8 to 3276.7": limits("-3276.8", "3276.7"),
}


@pytest.mark.parametrize(("text", "expected"), READ.items())
def test_a_range_is_read(text: str, expected: Limits) -> None:
    assert parse_range(text) == expected


def test_listed_numbers_are_kept() -> None:
    assert parse_range("0/1") == Limits(Fraction(0), Fraction(1), (Fraction(0), Fraction(1)))
    assert parse_range("1|2|3") == Limits(Fraction(1), Fraction(3), (Fraction(1), Fraction(2), Fraction(3)))


def test_one_limit_leaves_the_other_side_open() -> None:
    assert parse_range("\N{GREATER-THAN OR EQUAL TO}0") == Limits(Fraction(0), None)
    assert parse_range("max. 5 A") == Limits(None, Fraction(5))
    assert parse_limits("", "5") == Limits(None, Fraction(5))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("0,1", "decimal comma, or two numbers"),
        ("100-0", "ends at 0, below 100"),
        ("0..10, 20..30", "several ranges"),
        ("12 characters", "no range of numbers"),
        ("0/100", "single numbers with gaps"),
        (">0", "whether the limit itself"),
        ("0-9,999", "may be either"),
        ("5", "no range of numbers"),
    ],
)
def test_what_is_not_one_range_is_unclear(text: str, said: str) -> None:
    found = parse_range(text)
    assert isinstance(found, Unclear)
    assert said in found.reason


def test_an_empty_cell_is_no_range() -> None:
    assert (parse_range(" - "), parse_limits("", "")) == (None, None)


def test_a_range_one_too_many_for_its_type_is_unclear_with_the_limits_of_the_type() -> None:
    found = settle_range(limits("0", "65536"), UINT16, PLAIN)
    assert isinstance(found, Unclear)
    assert "0..65536" in found.reason
    assert "0 to 65535" in found.reason


def test_a_range_that_fits_as_stored_numbers_only_is_scaled() -> None:
    found = settle_range(limits("-32768", "32767"), INT16, TENTH)
    assert isinstance(found, Settled)
    assert found.limits == limits("-3276.8", "3276.7")
    assert "stored" in found.stated


def test_a_range_with_fractions_counts_values() -> None:
    assert settle_range(limits("-3276.8", "3276.7"), INT16, TENTH) == Settled(limits("-3276.8", "3276.7"))


def test_a_range_that_may_count_both_is_unclear_with_both_readings() -> None:
    found = settle_range(limits("0", "100"), UINT16, TENTH)
    assert isinstance(found, Unclear)
    assert "0..100" in found.reason
    assert found.reason.endswith("then it is 0..10")


def test_digits_behind_a_point_count_values() -> None:
    printed = parse_range("0,0..100,0")
    assert isinstance(printed, Limits)
    assert settle_range(printed, UINT16, TENTH) == Settled(limits("0", "100"))
    thousands = parse_range("0..1.000", comma=True)
    assert isinstance(thousands, Limits)
    assert (thousands.high, thousands.has_point) == (1000, False)


def test_rows_that_fit_in_one_way_decide_for_those_that_fit_in_both() -> None:
    both, stored = Ranged(limits("0", "100"), UINT16, TENTH), Ranged(limits("0", "65535"), UINT16, TENTH)
    found = settle_ranges([both, None, stored])
    assert [cell.limits if isinstance(cell, Settled) else cell for cell in found.cells] == [
        limits("0", "10"),
        None,
        limits("0", "6553.5"),
    ]
    assert "1 of them" in found.evidence


def test_rows_that_contradict_each_other_decide_nothing() -> None:
    both = Ranged(limits("0", "100"), UINT16, TENTH)
    stored, value = Ranged(limits("0", "65535"), UINT16, TENTH), Ranged(limits("0", "0.5"), UINT16, TENTH)
    assert isinstance(settle_ranges([both, stored, value]).cells[0], Unclear)


def test_what_the_user_says_of_ranges_decides() -> None:
    both = Ranged(limits("0", "100"), UINT16, TENTH)
    assert settle_ranges([both], counts="value").cells == (Settled(limits("0", "100")),)


def test_a_negative_scale_turns_the_limits_around() -> None:
    found = settle_range(limits("-32768", "0"), INT16, Scale(Fraction(-1, 10)))
    assert isinstance(found, Settled)
    assert found.limits == limits("0", "3276.8")


def test_a_value_between_two_steps_does_not_fit() -> None:
    assert isinstance(settle_range(limits("0", "0.05"), UINT16, TENTH), Unclear)


def test_equal_limits_in_many_rows_state_no_range() -> None:
    zeros, real = ("0", "0"), ("0", "100")
    assert stated_limits([zeros, zeros, real])[0] is False
    assert "2 of 3" in stated_limits([zeros, zeros, real])[1]
    assert stated_limits([real] * 9)[0] is True


@given(st.text(max_size=30))
def test_no_text_raises(text: str) -> None:
    assert isinstance(parse_range(text), Limits | Unclear | None)


@given(
    st.integers(-10000, 10000),
    st.integers(0, 10000),
    st.sampled_from(["..", " to ", "~", " - ", "\N{HORIZONTAL ELLIPSIS}"]),
)
def test_a_range_reads_back(low: int, length: int, between: str) -> None:
    assert parse_range(f"{low}{between}{low + length}") == Limits(Fraction(low), Fraction(low + length))
