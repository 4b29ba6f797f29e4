"""Units as people spell them, and words for reading and writing."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.access import AccessCell, parse_access
from regscribe.importers.table.cells.units import UnitCell, may_scale, parse_unit
from regscribe.model import Access, Space
from regscribe.model.units import KNOWN_UNITS

UNITS = {
    "°C": ["degC", "°c", "Deg.C", "\N{DEGREE CELSIUS}", "deg C", "degrees C", "[°C]", "(°C)"],
    "kW": ["KW", "kw"],
    "kWh": ["kwh", "KWH", "k Wh"],
    "A": ["Amp", "A(rms)", "A (rms)", "A rms"],
    "V": ["V AC", "VDC", "V_AC", "Volt"],
    "Hz": ["H Z", "hz"],
    "rpm": ["1/min", "RPM", "tr/min", "U/min"],
    "m³/h": ["m3/h", "m^3/h"],
    "%": ["percent", "%RH"],
    "kvar": ["kVAr", "KVAR"],
    "min": ["MIN", "minutes", "Minuten"],
    "mbar": ["MBAR"],
    "h": ["Stunden", "hours"],
    "µA": ["uA", "\N{GREEK SMALL LETTER MU}A"],
}


@pytest.mark.parametrize(("text", "symbol"), [(text, symbol) for symbol, texts in UNITS.items() for text in texts])
def test_a_spelling_of_a_unit(text: str, symbol: str) -> None:
    assert parse_unit(text) == UnitCell(symbol)


@pytest.mark.parametrize(
    ("text", "symbol", "factor"),
    [
        ("0.1V", "V", "1/10"),
        ("0,1 °C", "°C", "1/10"),
        ("0.01H Z", "Hz", "1/100"),
        ("0.1k Wh", "kWh", "1/10"),
        ("20ms", "ms", "20"),
        ("1/10 V", "V", "1/10"),
        ("10^-1 A", "A", "1/10"),
        ("0.1 s", "s", "1/10"),
        ("x0.1 A", "A", "1/10"),
        ("A (x0.1)", "A", "1/10"),
        ("°C [0,1]", "°C", "1/10"),
        ("V (/100)", "V", "1/100"),
    ],
)
def test_a_factor_before_a_unit_is_a_scale(text: str, symbol: str, factor: str) -> None:
    assert parse_unit(text) == UnitCell(symbol, Fraction(factor))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("Mw", "thousandths or millions"),
        ("MV", "thousandths or millions"),
        ("mva", "thousandths or millions"),
        ("F", "two units"),
        ("H", "two units"),
        ("0=Open;1=Closed", "no unit"),
        ("enum", "no unit"),
        ("bitfield", "no unit"),
        ("01.c", "lacks its point"),
        ("0.1?", "no number with a unit"),
        ("-0.1A", "sign"),
        ("see the text below", "no unit"),
    ],
)
def test_what_is_no_unit_for_sure_is_unclear(text: str, said: str) -> None:
    found = parse_unit(text)
    assert isinstance(found, Unclear)
    assert said in found.reason


def test_an_unclear_unit_with_a_number_may_hold_the_scale() -> None:
    assert [may_scale(text) for text in ("0.1?", "01.c", "-0.1A", "x10", "V*10", "Mw", "0=Open;1=Closed", "enum")] == [
        True,
        True,
        True,
        True,
        True,
        False,
        False,
        False,
    ]


def test_a_unit_that_a_map_must_declare_is_kept_as_it_is() -> None:
    assert parse_unit("pulses") == UnitCell("pulses", known=False)


@pytest.mark.parametrize("text", ["", "-", "--", "n/a", "none", "1"])
def test_no_unit(text: str) -> None:
    assert parse_unit(text) is None


@pytest.mark.parametrize("symbol", [one for one in KNOWN_UNITS if one not in {"F", "H", "0.1 s", "0.01 s"}])
def test_every_symbol_of_the_language_is_that_unit(symbol: str) -> None:
    assert parse_unit(symbol) == UnitCell(symbol)


R, RW, W = Access.READ, Access.READ_WRITE, Access.WRITE


@pytest.mark.parametrize(
    ("text", "access"),
    [
        *((text, R) for text in ("R", "RO", "r/o", "RD", "read", "Read-Only", "Lesen", "lecture", "nur lesen", "ROF")),
        *((text, RW) for text in ("RW", "R/W", "r w", "W/R", "read/write", "Lesen/Schreiben", "lecture/écriture")),
        *((text, RW) for text in ("Read & Write", "lettura e scrittura", "Lesen und Schreiben", "读写")),
        *((text, W) for text in ("W", "WO", "write only", "W/O", "Schreiben", "WD")),
    ],
)
def test_words_for_access(text: str, access: Access) -> None:
    assert parse_access(text) == AccessCell(access)


def test_what_else_a_cell_says_is_kept() -> None:
    assert parse_access("R (W with code)") == AccessCell(RW, "w with code")
    assert parse_access("R/W with password") == AccessCell(RW, "with password")
    assert parse_access("R (installer)") == AccessCell(R, "installer")


def test_a_mark_of_a_footnote_is_kept_as_a_remark() -> None:
    assert parse_access("R/W*") == AccessCell(RW, "*")


def test_what_is_written_by_a_command_is_unclear() -> None:
    assert isinstance(parse_access("R/WC"), Unclear)
    assert isinstance(parse_access("RWC"), Unclear)


def test_yes_and_no_answer_the_heading() -> None:
    assert parse_access("yes", "writable") == AccessCell(RW)
    assert parse_access("no", "Writable?") == AccessCell(R)
    assert parse_access("x", "Schreibbar") == AccessCell(RW)
    assert parse_access("yes", "Read only") == AccessCell(R)
    assert isinstance(parse_access("yes", "Access"), Unclear)


def test_an_empty_cell_means_reading_where_nothing_else_can_be() -> None:
    assert parse_access("", space=Space.INPUT) == AccessCell(R)
    assert parse_access("", space=Space.HOLDING) is None


def test_an_input_register_that_is_written_is_unclear() -> None:
    assert isinstance(parse_access("R/W", space=Space.INPUT), Unclear)


@given(st.text(max_size=24))
def test_no_text_raises(text: str) -> None:
    assert isinstance(parse_unit(text), UnitCell | Unclear | None)
    assert isinstance(parse_access(text, text), AccessCell | Unclear | None)
