"""Scales of single cells, and what the bare numbers of a column do."""

from decimal import Decimal
from fractions import Fraction
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.scale_words import scale_in
from regscribe.importers.table.cells.scales import PLAIN, Hint, Scale, Way, parse_offset, parse_scale, parse_scales
from regscribe.model import WireType, show

TENTH = Scale(Fraction(1, 10))

SAYS_ITSELF = {
    "x0.1": TENTH,
    "*0.1": TENTH,
    "\N{MULTIPLICATION SIGN}0,1": TENTH,
    "0.1x": TENTH,
    "/10": TENTH,
    "\N{DIVISION SIGN}10": TENTH,
    "1/10": TENTH,
    "10^-1": TENTH,
    "10**-2": Scale(Fraction(1, 100)),
    "10\N{SUPERSCRIPT MINUS}\N{SUPERSCRIPT ONE}": TENTH,
    "gain 10": TENTH,
    "divided by 10": TENTH,
    "multiply by 0.1": TENTH,
    "factor 0.1": TENTH,
    "decimals 1": TENTH,
    "1 decimal": TENTH,
    "%.1f": TENTH,
    "FIX1": TENTH,
    "xx.x": TENTH,
    "###.#": TENTH,
    "x/10": TENTH,
    "raw*0.1": TENTH,
    "1 = 0.1 A": Scale(Fraction(1, 10), unit="A"),
    "1=0.1": TENTH,
    "100 = 10.0 A": Scale(Fraction(1, 10), unit="A"),
    "0.1 V/LSB": Scale(Fraction(1, 10), unit="V"),
    "0.5 \N{DEGREE SIGN}C per bit": Scale(Fraction(1, 2), unit="\N{DEGREE SIGN}C"),
    "0.1A": Scale(Fraction(1, 10), unit="A"),
    "(x-100)*0.1": Scale(Fraction(1, 10), Fraction(-10)),
    "0.1x - 40": Scale(Fraction(1, 10), Fraction(-40)),
    "y = 0.5*x": Scale(Fraction(1, 2)),
    "(raw+40)/3": Scale(Fraction(1, 3), Fraction(40, 3)),
    "none": PLAIN,
}


@pytest.mark.parametrize(("text", "scale"), SAYS_ITSELF.items())
def test_a_cell_that_says_what_it_does_is_read_alone(text: str, scale: Scale) -> None:
    assert parse_scale(text) == scale


@pytest.mark.parametrize("text", ["", "-", "n/a"])
def test_an_empty_cell_says_nothing(text: str) -> None:
    assert parse_scale(text) is None


@pytest.mark.parametrize("text", ["10", "0.1", "0,1", "1E-1", "x10", "factor 10"])
def test_a_bare_number_is_unclear_without_its_column(text: str) -> None:
    found = parse_scale(text)
    assert isinstance(found, Unclear)
    assert "multiplies or divides" in found.reason


def test_a_bare_number_does_what_its_column_does() -> None:
    assert parse_scale("10", Way.DIVIDE) == TENTH
    assert parse_scale("0,1", Way.MULTIPLY) == TENTH
    assert parse_scale("1", Way.DECIMALS) == TENTH
    assert parse_scale("-1", Way.EXPONENT) == TENTH
    assert parse_scale("-10", Way.DIVIDE) == Scale(Fraction(-1, 10))


@pytest.mark.parametrize(
    "text", ["x**9", "x*x", "(x+", "x/0", "1/x", "bla", "10%", "__import__('os')", "x if x else 1"]
)
def test_what_is_no_straight_line_is_unclear(text: str) -> None:
    assert isinstance(parse_scale(text, Way.MULTIPLY), Unclear)


@pytest.mark.parametrize("text", ["value*10", "Wert*10", "x*100"])
def test_a_product_that_may_be_what_the_device_sends_is_unclear(text: str) -> None:
    assert isinstance(parse_scale(text), Unclear)
    assert parse_scale("value / 10") == TENTH
    assert parse_scale("raw*10") == parse_scale("value = 10*x") == Scale(Fraction(10))


@pytest.mark.parametrize("text", ["0", "/0", "x0"])
def test_a_scale_of_0_is_unclear(text: str) -> None:
    assert isinstance(parse_scale(text, Way.MULTIPLY), Unclear)


def test_the_name_of_a_register_as_scale_is_unclear_and_named() -> None:
    found = parse_scale("W_SF", Way.DIVIDE)
    assert isinstance(found, Unclear)
    assert "register `W_SF`" in found.reason


@pytest.mark.parametrize(
    ("scale", "keys"),
    [
        (PLAIN, {}),
        (TENTH, {"decimals": 1}),
        (Scale(Fraction(100)), {"multiply": 100}),
        (Scale(Fraction(1, 2)), {"multiply": Decimal("0.5")}),
        (Scale(Fraction(1, 3)), {"multiply": "1/3"}),
        (Scale(Fraction(2, 3)), {"multiply": "2/3"}),
        (Scale(Fraction(-1, 10)), {"multiply": Decimal("-0.1")}),
        (Scale(Fraction(1, 10), Fraction(-40)), {"multiply": Decimal("0.1"), "add": -40}),
        (Scale(Fraction(1, 3), Fraction(-40)), {"multiply": "1/3", "add": -40}),
        (Scale(add=Fraction(1, 10)), {"add": Decimal("0.1")}),
    ],
)
def test_the_keys_say_the_scale_exactly(scale: Scale, keys: dict[str, Any]) -> None:
    assert dict(scale.keys) == keys


@pytest.mark.parametrize(
    ("texts", "heading", "way"),
    [
        (["10", "1", "100"], "Scalefactor", Way.DIVIDE),
        (["0.1", "1", ""], "Factor", Way.MULTIPLY),
        (["0,1", "0,01"], "Faktor", Way.MULTIPLY),
        (["10", "2"], "Gain", Way.DIVIDE),
        (["10", "0.1"], "Scale", None),
        (["60"], "Scale", None),
        (["x10", "x100"], "Scale", None),
        (["1", "2"], "Decimals", Way.DECIMALS),
        (["10"], "Division factor", Way.DIVIDE),
        (["10"], "Multiplier", Way.MULTIPLY),
        (["-1", "-2"], "Exponent", Way.EXPONENT),
        (["1", "1"], "Scale", None),
    ],
)
def test_a_column_shows_what_its_numbers_do(texts: list[str], heading: str, way: Way | None) -> None:
    assert parse_scales(texts, heading).way is way


def test_bare_numbers_beside_names_of_scale_factors_are_powers_of_ten() -> None:
    found = parse_scales(["A_SF", "-3"], "Scale Factor")
    assert (found.way, found.cells[1]) == (Way.EXPONENT, Scale(Fraction(1, 1000)))
    assert parse_scales(["A_SF", "1000"], "Scale Factor").way is Way.DIVIDE


def test_the_evidence_names_the_numbers() -> None:
    assert parse_scales(["10", "1", "1000"], "Scale").evidence == "only 10, 1000 occur beside 1, so they divide"


def test_numbers_that_may_be_digits_leave_even_1_unclear() -> None:
    cells = parse_scales(["0", "1", "2"], "Scale").cells
    assert all(isinstance(cell, Unclear) for cell in cells)


def test_1_is_no_scale_where_other_numbers_are_unclear() -> None:
    cells = parse_scales(["10", "0.1", "1"], "Scale").cells
    assert [isinstance(cell, Unclear) for cell in cells] == [True, True, False]
    assert cells[2] == PLAIN


def test_ranges_show_what_numbers_do_where_sizes_do_not() -> None:
    # -3276.8..3276.7 are values of an int16 divided by 10; multiplied they would be -327.68 stored
    hint = Hint((Fraction(-32768, 10), Fraction(32767, 10)), WireType.INT16)
    found = parse_scales(["10", "0.1"], "Scale", hints=[hint, None])
    assert found.way is Way.DIVIDE
    assert found.cells == (TENTH, Scale(Fraction(10)))


def test_rows_whose_ranges_contradict_each_other_show_nothing() -> None:
    divides = Hint((Fraction(-32768, 10), Fraction(32767, 10)), WireType.INT16)
    multiplies = Hint((Fraction(1, 2), Fraction(5)), WireType.UINT16)
    assert parse_scales(["10", "0.5"], "Scale", hints=[divides, multiplies]).way is None
    tenfold = Hint(
        (Fraction(1, 2), Fraction(655)), WireType.UINT8
    )  # 5 and 6550 stored do not fit, nor do 1/20 and 65.5
    assert parse_scales(["10", "100"], "Scale", hints=[divides, tenfold]).way is Way.DIVIDE


def test_what_the_user_says_wins() -> None:
    found = parse_scales(["10"], "Multiplier", way="divide")
    assert (found.way, found.cells) == (Way.DIVIDE, (TENTH,))


def test_a_cell_that_says_itself_what_it_does_is_not_bound_by_its_column() -> None:
    assert parse_scales(["10", "x0.1", "/100"], "Divisor").cells == (TENTH, TENTH, Scale(Fraction(1, 100)))


@pytest.mark.parametrize(
    "text",
    [
        "scale 10",
        "Value scaled by 0.1",
        "resolution: 0.01 bar",
        "in 0.1 V steps",
        "1 = 0.1",
        "x10",
        "tenths of a volt",
        "one decimal",
        "temperature (x0.1)",
        "see note (/10)",
    ],
)
def test_a_remark_that_speaks_of_a_scale_is_told(text: str) -> None:
    assert isinstance(scale_in(text), Scale | Unclear)


@pytest.mark.parametrize(
    "text", ["", "level of tank 10", "phase 1/3", "1 = on, 0 = off", "2 x pump", "10", "9600 baud"]
)
def test_other_remarks_say_nothing_of_a_scale(text: str) -> None:
    assert scale_in(text) is None


def test_an_offset_is_a_number() -> None:
    assert parse_offset("-273,15") == Fraction(-27315, 100)
    assert parse_offset("") is None
    assert isinstance(parse_offset("see text"), Unclear)


@given(st.lists(st.text(max_size=20), max_size=6), st.text(max_size=10))
def test_no_column_raises(texts: list[str], heading: str) -> None:
    assert len(parse_scales(texts, heading).cells) == len(texts)


@given(st.text("x0123456789.+-*/() =^AE", max_size=24))
def test_no_formula_raises(text: str) -> None:
    assert isinstance(parse_scale(text), Scale | Unclear | None)


@given(st.fractions(min_value=-1000, max_value=1000, max_denominator=1000).filter(bool), st.integers(-500, 500))
def test_a_formula_reads_back(factor: Fraction, add: int) -> None:
    text = f"({factor.numerator}*raw)/{factor.denominator}+{add}" if add >= 0 else f"raw*{show(factor)}-{-add}"
    assert parse_scale(text) == Scale(factor, Fraction(add))
