"""Addresses in every notation, decided once for the column."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.addresses import Address, AddressColumn, Column, parse_addresses
from regscribe.model import Space

HOLDING, INPUT, COIL, DISCRETE = Space.HOLDING, Space.INPUT, Space.COIL, Space.DISCRETE


def column(
    *texts: str, heading: str = "Address", base: str = "", spaces: tuple[Space | None, ...] = ()
) -> AddressColumn:
    return parse_addresses([Column(heading, texts)], base=base, spaces=spaces)


def wire(found: AddressColumn) -> list[int | None]:
    return [cell.at if isinstance(cell, Address) else None for cell in found.cells]


def spaces_of(found: AddressColumn) -> list[Space | None]:
    return [cell.space if isinstance(cell, Address) else None for cell in found.cells]


def reason(found: AddressColumn, row: int) -> str:
    cell = found.cells[row]
    assert isinstance(cell, Unclear), cell
    return cell.reason


def test_40001_is_the_first_holding_register_where_all_have_the_digit_of_a_space() -> None:
    found = column("40001", "40010", "30001", "10003", "00002")
    assert wire(found) == [0, 9, 0, 2, 1]
    assert spaces_of(found) == [HOLDING, HOLDING, INPUT, DISCRETE, COIL]
    assert (found.notation, found.assumed) == ("modicon", False)
    assert "base 0" in found.evidence


def test_400001_is_the_first_of_65536_holding_registers() -> None:
    found = column("400001", "465536", "300010")
    assert (wire(found), spaces_of(found)) == ([0, 65535, 9], [HOLDING, HOLDING, INPUT])


def test_five_digits_among_six_are_unclear() -> None:
    assert "6 digits" in reason(column("400001", "40001"), 1)


def test_40000_shows_that_40001_is_no_number_of_a_space() -> None:
    assert wire(column("40000", "40001")) == [40000, 40001]


def test_40001_beside_low_numbers_leaves_both_unclear() -> None:
    found = column("5", "40001")
    assert wire(found) == [None, None]
    assert "others are 40001" in reason(found, 0)
    assert "as low as 5" in reason(found, 1)
    assert wire(column("5", "40001", base="0")) == [5, 40001]


def test_a_zero_before_the_digits_is_that_of_coils() -> None:
    assert wire(column("00005", "40001")) == [4, 0]


def test_a_number_that_no_space_has_shows_plain_addresses() -> None:
    assert wire(column("5", "40001", "50000")) == [5, 40001, 50000]


def test_a_column_of_spaces_that_contradicts_the_digits_shows_plain_addresses() -> None:
    assert wire(column("30001", "30002", spaces=(HOLDING, HOLDING))) == [30001, 30002]


def test_one_row_whose_space_contradicts_its_digit_is_unclear() -> None:
    found = column("40001", "40002", "40003", spaces=(HOLDING, HOLDING, INPUT))
    assert wire(found) == [0, 1, None]
    assert "input" in reason(found, 2)


def test_4x0001_and_its_like_count_from_1_in_their_space() -> None:
    found = column("4x0001", "3X 0005", "0x0003", "1x0002")
    assert (wire(found), spaces_of(found)) == ([0, 4, 2, 1], [HOLDING, INPUT, COIL, DISCRETE])
    assert found.assumed is False


def test_4x0000_shows_that_they_count_from_0() -> None:
    assert wire(column("4x0000", "4x0005")) == [0, 5]


def test_0x0003_alone_is_hexadecimal() -> None:
    assert (wire(column("0x0003", "0x0010")), spaces_of(column("0x0003"))) == ([3, 16], [None])


@pytest.mark.parametrize("text", ["0x1F", "1Fh", "x1F", "$1F", "&H1F", "16#1F"])
def test_marks_of_hexadecimal_numbers(text: str) -> None:
    assert wire(column(text)) == [31]


def test_letters_show_that_all_are_hexadecimal() -> None:
    found = column("0010", "001F")
    assert wire(found) == [16, 31]
    assert "`001F` has letters" in found.evidence


def test_a_heading_shows_that_they_are_hexadecimal() -> None:
    assert wire(column("10", "20", heading="Address (hex)")) == [16, 32]
    assert wire(column("10", "20", heading="Address (dec/hex)")) == [10, 20]


def test_letters_under_a_decimal_heading_are_unclear() -> None:
    assert "letters" in reason(column("10", "1F", heading="Decimal address"), 1)


def test_a_number_without_a_mark_is_unclear_where_most_have_one() -> None:
    assert "mark" in reason(column("0x10", "0x11", "12"), 2)
    assert wire(column("0x10", "0x11", "12", base="decimal")) == [16, 17, 12]


def test_the_address_0_shows_that_they_count_from_0() -> None:
    found = column("0", "5")
    assert (wire(found), found.assumed) == ([0, 5], False)


@pytest.mark.parametrize(("heading", "first"), [("Address (1-based)", 6), ("PDU address", 7), ("PLC address", 6)])
def test_words_of_a_heading_show_from_what_they_count(heading: str, first: int) -> None:
    found = column("7", heading=heading)
    assert (wire(found), found.assumed) == ([first], False)


def test_without_evidence_they_are_taken_as_printed_and_that_is_assumed() -> None:
    found = column("7", "9")
    assert (wire(found), found.assumed) == ([7, 9], True)
    assert "the least is 7" in found.evidence


def test_what_the_user_says_wins() -> None:
    assert wire(column("40001", base="0")) == [40001]
    assert wire(column("40001", base="1")) == [40000]
    assert wire(column("7", base="1")) == [6]
    assert wire(column("10", base="hex,1")) == [15]
    assert wire(column("40001", "7", base="modicon")) == [0, None]


def test_4_colon_1_is_a_holding_register_and_3_colon_1_is_unclear() -> None:
    assert spaces_of(column("4:1", "4:7")) == [HOLDING, HOLDING]
    assert wire(column("4:1", "4:7")) == [0, 6]
    assert "not clear" in reason(column("3:1", "4:1"), 0)
    assert spaces_of(column("0:1", "3:1", "4:1")) == [COIL, INPUT, HOLDING]
    assert spaces_of(column("3:1", "4:1", heading="Function:Address")) == [HOLDING, INPUT]
    assert wire(column("3:1", "4:1", heading="Function:Address")) == [1, 1]
    assert spaces_of(column("3:00001", "4:00001")) == [INPUT, HOLDING]


def test_prefixes_say_the_space() -> None:
    found = column("HR1", "IR 2", "Coil 3", "DI4", "%MW5", "reg 6")
    assert (wire(found), spaces_of(found)) == ([1, 2, 3, 4, 5, 6], [HOLDING, INPUT, COIL, DISCRETE, HOLDING, None])


@pytest.mark.parametrize(
    ("text", "at", "count"),
    [
        ("7~14", 7, 8),
        ("7-14", 7, 8),
        ("7..14", 7, 8),
        ("7 to 14", 7, 8),
        ("r7~14", 7, 8),
        ("100/101", 100, 2),
        ("100,101", 100, 2),
        ("1001-12", 1001, 12),
        ("0x10-0x1F", 16, 16),
        ("40001-40002", 40001, 2),
    ],
)
def test_ranges_say_how_many(text: str, at: int, count: int) -> None:
    assert column(text, base="0").cells == (Address(at, None, count),)


def test_a_range_of_modicon_numbers_counts_as_well() -> None:
    assert column("40001-40004").cells == (Address(0, HOLDING, 4),)


@pytest.mark.parametrize("text", ["1234/5", "1234,5", "10-5", "20-10", "see text", "70000", "1234.17", "12345678"])
def test_what_may_be_several_things_is_unclear(text: str) -> None:
    assert isinstance(column(text, "3").cells[0], Unclear)


@pytest.mark.parametrize(
    ("text", "bits"),
    [
        ("1234.5", (5, 5)),
        ("1234.b5", (5, 5)),
        ("1234 bit 5", (5, 5)),
        ("1234[5]", (5, 5)),
        ("1234 (bit 5)", (5, 5)),
        ("1234.0-3", (0, 3)),
        ("x4D2.b15", (15, 15)),
        ("1234.15-8", (8, 15)),
    ],
)
def test_bits_are_told_apart(text: str, bits: tuple[int, int]) -> None:
    assert column(text, "1").cells[0] == Address(1234, None, 0, bits)


def test_point_0_behind_every_number_is_a_number_of_a_spreadsheet() -> None:
    assert column("100.0", "101.0").cells == (Address(100), Address(101))
    assert column("100.0", "100.1").cells == (Address(100, None, 0, (0, 0)), Address(100, None, 0, (1, 1)))


def test_bits_count_from_1_where_16_occurs_and_0_does_not() -> None:
    found = column("100.1", "100.16", "101.2-4", "102")
    assert [cell.bits for cell in found.cells if isinstance(cell, Address)] == [(0, 0), (15, 15), (1, 3), None]
    assert "bits count from 1" in found.evidence
    assert "bit 16" in reason(column("100.0", "100.16"), 1)


def test_separators_of_thousands_are_passed_over() -> None:
    assert wire(column("40 001", "40,002")) == [0, 1]


def test_empty_cells_stay_empty() -> None:
    assert column("", " - ", "5").cells == (None, None, Address(5))


def two(first: tuple[str, ...], second: tuple[str, ...], headings: tuple[str, str] = ("Dec", "Hex")) -> AddressColumn:
    return parse_addresses([Column(headings[0], first), Column(headings[1], second)])


def test_columns_that_differ_by_1_show_the_wire_address() -> None:
    found = two(("0A", "0B"), ("11", "12"), ("Address (hex)", "Register"))
    assert (wire(found), found.assumed) == ([10, 11], False)
    assert "differ by 1" in found.evidence
    assert wire(two(("11", "12"), ("0A", "0B"), ("Register", "Address (hex)"))) == [10, 11]


def test_a_row_in_which_two_columns_disagree_is_unclear() -> None:
    found = two(("10", "11", "12", "13", "14", "99"), ("0xA", "0xB", "0xC", "0xD", "0xE", "0xF"))
    assert wire(found) == [10, 11, 12, 13, 14, None]
    assert "`99` and `0xF`" in reason(found, 5)


def test_columns_that_never_agree_leave_all_unclear() -> None:
    assert wire(two(("10", "20", "30"), ("1", "5", "7"))) == [None, None, None]


def test_a_column_of_modicon_numbers_says_the_spaces_of_the_other() -> None:
    found = two(("0", "1"), ("40001", "30002"), ("Wire", "Modicon"))
    assert (wire(found), spaces_of(found)) == ([0, 1], [HOLDING, INPUT])
    found = two(("1", "2"), ("40001", "40002"), ("Number", "Modicon"))
    assert wire(found) == [0, 1]


def test_the_distance_of_two_columns_says_the_space_where_numbers_of_five_and_six_digits_mix() -> None:
    found = two(("0x0000", "0xFC00"), ("30001", "464513"), ("Wire", "Number"))
    assert (wire(found), spaces_of(found)) == ([0, 0xFC00], [INPUT, HOLDING])


@given(st.lists(st.text(max_size=14), min_size=1, max_size=6), st.text(max_size=12))
def test_no_column_raises(texts: list[str], heading: str) -> None:
    assert len(column(*texts, heading=heading).cells) == len(texts)


@given(st.lists(st.text("0134xXhHrRfc.:-~/, b$%", max_size=12), min_size=1, max_size=5))
def test_no_column_of_what_looks_like_addresses_raises(texts: list[str]) -> None:
    assert len(column(*texts).cells) == len(texts)
    assert len(parse_addresses([Column("a", tuple(texts)), Column("b", tuple(texts))]).cells) == len(texts)


WRITTEN = {
    "decimal": (str, "0"),
    "0x": (lambda at: f"0x{at:04X}", "0"),
    "h": (lambda at: f"{at:04X}h", "0"),
    "1-based": (lambda at: str(at + 1), "1"),
    "4x": (lambda at: f"4x{at + 1:05d}", ""),
    "six": (lambda at: f"{400001 + at}", ""),
    "bit": (lambda at: f"{at}.b7", "0"),
}


@given(st.sampled_from(sorted(WRITTEN)), st.lists(st.integers(0, 65535), min_size=1, max_size=5))
def test_what_is_written_in_a_notation_reads_back(notation: str, ats: list[int]) -> None:
    write, base = WRITTEN[notation]
    assert wire(column(*map(write, ats), base=base)) == ats


@given(st.lists(st.integers(0, 9998), min_size=1, max_size=5))
def test_what_is_written_in_five_digits_reads_back(ats: list[int]) -> None:
    assert wire(column(*(f"{40001 + at}" for at in ats))) == ats
