"""Numbers as people write them, exactly."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.numbers import decimal_comma, number
from regscribe.model import show

READ = {
    "0": Fraction(0),
    "25": Fraction(25),
    "-5": Fraction(-5),
    "\N{MINUS SIGN}5": Fraction(-5),
    "+ 5": Fraction(5),
    "0.1": Fraction(1, 10),
    "0,1": Fraction(1, 10),
    "-0,5": Fraction(-1, 2),
    ".5": Fraction(1, 2),
    "1.234,5": Fraction(12345, 10),
    "1,234.5": Fraction(12345, 10),
    "1,234,567": Fraction(1234567),
    "1 000 000": Fraction(1000000),
    "1\N{NARROW NO-BREAK SPACE}000": Fraction(1000),
    "1'000": Fraction(1000),
    "1\N{RIGHT SINGLE QUOTATION MARK}000,5": Fraction(10005, 10),
    "0x1F": Fraction(31),
    "1Fh": Fraction(31),
    "FFFFh": Fraction(65535),
    "1E-1": Fraction(1, 10),
    "2e3": Fraction(2000),
    "12\N{SOFT HYPHEN}3": Fraction(123),
}


@pytest.mark.parametrize(("text", "value"), READ.items())
def test_a_number_is_read_exactly(text: str, value: Fraction) -> None:
    assert number(text) == value


@pytest.mark.parametrize(
    "text",
    ["", " ", "--5", "1.2.3", "12,34,56", "1..2", "abc", "1e99", "\N{ARABIC-INDIC DIGIT ONE}", "5 A", "9" * 41, "."],
)
def test_what_is_no_number_is_unclear_and_quoted(text: str) -> None:
    found = number(text)
    assert isinstance(found, Unclear)
    assert "`" in found.reason


def test_a_comma_before_three_digits_may_be_either_until_the_column_says() -> None:
    assert number("1,234") == Unclear("`1,234` is 1234 or 1.234: its comma may be either")
    assert number("1,234", comma=True) == Fraction(1234, 1000)
    assert number("1,234", comma=False) == 1234
    assert number("1.234", comma=True) == 1234


def test_a_point_is_no_number_where_the_column_has_decimal_commas() -> None:
    assert isinstance(number("0.5", comma=True), Unclear)


@pytest.mark.parametrize(
    ("texts", "comma"),
    [
        (["0,1", "1"], True),
        (["1.234,5"], True),
        (["0.1", "1,234"], False),
        (["1,234"], None),
        (["0..100", "5"], None),
        (["0,1", "0.1"], None),
        ([], None),
    ],
)
def test_the_cells_of_a_column_show_what_a_comma_is(texts: list[str], comma: bool | None) -> None:  # noqa: FBT001 - a case
    assert decimal_comma(texts) is comma


@given(st.text(max_size=30))
def test_no_text_raises(text: str) -> None:
    assert isinstance(number(text), Fraction | Unclear)


@given(st.decimals(allow_nan=False, allow_infinity=False, places=3, min_value=-(10**9), max_value=10**9))
def test_a_decimal_reads_back_with_a_point_and_with_a_comma(value: object) -> None:
    exact = Fraction(str(value))
    assert number(show(exact), comma=False) == exact
    assert number(show(exact).replace(".", ","), comma=True) == exact


def test_a_cell_of_5_megabytes_is_no_number_and_takes_no_time() -> None:
    assert isinstance(number("1" * 5_000_000), Unclear)
    assert isinstance(number("1" + " " * 5_000_000 + "x"), Unclear)
