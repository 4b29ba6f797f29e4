"""Types as people write them, and dialects by the evidence of the table."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.orders import order_in
from regscribe.importers.table.cells.types import (
    Dialect,
    TypeCell,
    choose_dialect,
    parse_order,
    parse_type,
    read_dialect,
)
from regscribe.model import Order, WireType

USUAL = Dialect()
BIG, LITTLE = Order.BIG, Order.LITTLE

TYPES = {
    "uint16": [
        "U16",
        "UINT16",
        "uint_16",
        "WORD",
        "USHORT",
        "unsigned 16",
        "16-bit unsigned integer",
        "INT16U",
        "16U",
        "Mot",
        "Unsigned 16-bit Integer",
        "Wort (vorzeichenlos)",
        "无符号16位整数",
    ],
    "int16": [
        "S16",
        "I16",
        "INT",
        "SHORT",
        "signed int 16",
        "Int16",
        "int16_t",
        "sunssf",
        "Entier 16 bits signé",
        "Mot signé",
        "INT16 (2's complement)",
        "2 byte signed integer",
    ],
    "uint32": ["U32", "UDINT", "DWORD", "ULONG", "Unsigned 32-bit", "acc32", "U_DWORD", "Mot double", "Doppelwort"],
    "int32": ["S32", "DINT", "LONG", "Signed 32 bits", "S_DWORD", "Signed 32bit integer"],
    "float32": [
        "F32",
        "FLOAT",
        "REAL",
        "IEEE754",
        "IEEE 754 float",
        "32 bit float",
        "FP32",
        "Float32",
        "Réel",
        "Fließkomma 32 Bit",
    ],
    "float64": ["F64", "LREAL", "DOUBLE"],
    "uint64": ["U64", "ULINT", "U_QWORD"],
    "int64": ["S64", "LINT"],
    "bit": ["BIT", "BOOL", "COIL"],
    "uint8": ["U8", "BYTE", "USINT"],
    "bcd16": ["BCD16", "4-digit BCD"],
    "bcd32": ["8-digit BCD", "BCD32"],
}


@pytest.mark.parametrize(("text", "wire"), [(text, wire) for wire, texts in TYPES.items() for text in texts])
def test_a_word_for_a_type(text: str, wire: str) -> None:
    found = parse_type(text, USUAL)
    assert isinstance(found, TypeCell)
    assert (found.type, found.words, found.kind) == (WireType(wire), WireType(wire).words, "")


@pytest.mark.parametrize(
    ("text", "wire", "words", "octets"),
    [
        ("UINT32 swapped", "uint32", LITTLE, None),
        ("float sw", "float32", LITTLE, None),
        ("S_DWORD_R", "int32", LITTLE, None),
        ("UInt32 (little-endian word order)", "uint32", LITTLE, None),
        ("floatsw", "float32", LITTLE, None),
        ("int32le", "int32", LITTLE, LITTLE),
        ("float32 CDAB", "float32", LITTLE, BIG),
        ("float (DCBA)", "float32", LITTLE, LITTLE),
        ("U32 BADC", "uint32", BIG, LITTLE),
        ("U32 Lo-Hi", "uint32", LITTLE, None),
        ("uint16le", "uint16", None, LITTLE),
        ("U32 big endian", "uint32", BIG, BIG),
        ("CDAB float", "float32", LITTLE, BIG),
        ("UINT32 (LSW first)", "uint32", LITTLE, None),
        ("int16 swapped", "int16", None, None),
    ],
)
def test_an_order_beside_a_type(text: str, wire: str, words: Order | None, octets: Order | None) -> None:
    found = parse_type(text, USUAL)
    assert isinstance(found, TypeCell)
    assert (found.type, found.word_order, found.byte_order) == (WireType(wire), words, octets)


def test_little_endian_alone_is_unclear_until_the_dialect_says_what_it_swaps() -> None:
    found = parse_type("U32 LE", USUAL)
    assert isinstance(found, Unclear)
    assert "CDAB" in found.reason
    assert "DCBA" in found.reason
    words = parse_type("U32 LE", Dialect(little_bytes=False))
    octets = parse_type("U32 little endian", Dialect(little_bytes=True))
    assert isinstance(words, TypeCell)
    assert isinstance(octets, TypeCell)
    assert (words.word_order, words.byte_order) == (LITTLE, None)
    assert (octets.word_order, octets.byte_order) == (LITTLE, LITTLE)


@pytest.mark.parametrize(
    ("text", "kind", "wire"),
    [
        ("bitmap", "flags", "uint16"),
        ("bitfield32", "flags", "uint32"),
        ("U16 (bitfield)", "flags", "uint16"),
        ("enum16", "enum", "uint16"),
        ("Flags", "flags", "uint16"),
        ("enum", "enum", "uint16"),
    ],
)
def test_a_word_for_a_kind(text: str, kind: str, wire: str) -> None:
    found = parse_type(text, USUAL)
    assert isinstance(found, TypeCell)
    assert (found.kind, found.type) == (kind, WireType(wire))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("in16", "`int16`"),
        ("unit32", "`uint32`"),
        ("BCD", "`bcd16`"),
        ("datetime", "layout"),
        ("unix time", "layout: unix"),
    ],
)
def test_what_says_no_type_for_sure_is_unclear_with_a_proposal(text: str, said: str) -> None:
    found = parse_type(text, USUAL)
    assert isinstance(found, Unclear)
    assert said in found.proposal


@pytest.mark.parametrize("text", ["xyz", "16 words", "16 bit", "signed", "Unsigned", "float48", "uint7"])
def test_what_is_no_type_is_unclear(text: str) -> None:
    assert isinstance(parse_type(text, USUAL), Unclear)


def test_some_bits_are_a_part_of_a_word() -> None:
    assert parse_type("2bit", USUAL) == TypeCell(bits=2)
    found = parse_type("16bit_flags", USUAL)
    assert isinstance(found, TypeCell)
    assert (found.type, found.kind) == (WireType.UINT16, "flags")


def test_a_size_completes_a_type() -> None:
    for text, size, wire in (
        ("signed", "2 words", "int32"),
        ("INT", "32 bit", "int32"),
        ("BCD", "2 registers", "bcd32"),
    ):
        found = parse_type(text, USUAL, size=size)
        assert isinstance(found, TypeCell)
        assert found.type is WireType(wire)


def test_a_size_that_contradicts_a_type_is_unclear() -> None:
    assert isinstance(parse_type("U32", USUAL, size="1 word"), Unclear)


def test_a_size_alone_says_no_sign() -> None:
    assert isinstance(parse_type("", USUAL, size="2 words"), Unclear)
    assert parse_type("", USUAL) is None


def test_a_size_that_is_not_understood_matters_only_where_the_type_hangs_on_it() -> None:
    assert isinstance(parse_type("U16", USUAL, size="2"), TypeCell)
    assert isinstance(parse_type("signed", USUAL, size="2"), Unclear)


@pytest.mark.parametrize(
    ("text", "dialect", "gap", "words"),
    [
        ("STRING(16)", Dialect(characters=True), 0, 8),
        ("string[6]", Dialect(characters=False), 0, 6),
        ("ASCII.7", Dialect(characters=True), 0, 4),
        ("string 20 bytes", USUAL, 0, 10),
        ("string 10 regs", USUAL, 0, 10),
        ("char[20]", USUAL, 0, 10),
        ("string[6]", USUAL, 6, 6),
        ("string[6]", USUAL, 3, 3),
        ("16 ASCII", USUAL, 8, 8),
    ],
)
def test_the_length_of_a_text_counts_as_the_cell_the_dialect_or_the_gap_says(
    text: str, dialect: Dialect, gap: int, words: int
) -> None:
    found = parse_type(text, dialect, gap=gap)
    assert isinstance(found, TypeCell)
    assert (found.type, found.words) == (WireType.STRING, words)


def test_the_length_of_a_text_is_unclear_where_nothing_says_what_it_counts() -> None:
    assert isinstance(parse_type("string[6]", USUAL), Unclear)
    assert isinstance(parse_type("string[6]", USUAL, gap=10), Unclear)


def test_a_text_without_length_has_the_size_beside_it() -> None:
    found = parse_type("UTF8", USUAL, size="10 words")
    assert found == TypeCell(type=WireType.STRING, words=10, encoding="utf-8")


def test_unix_time_of_two_words_is_a_datetime() -> None:
    assert parse_type("unix time", USUAL, size="32 bit") == TypeCell(type=WireType.DATETIME, words=2, layout="unix")


def test_uint_has_16_bits_where_the_next_register_is_the_next_address() -> None:
    found = choose_dialect(["UINT", "UDINT"], gaps=[1, 2])
    assert found.dialect.uint_bits == 16
    assert "1 or more" in found.stated[0]


def test_uint_has_32_bits_where_the_next_register_is_always_two_on() -> None:
    assert choose_dialect(["UINT", "UINT", "UINT", "USHORT"], gaps=[2, 2, 2, 1]).dialect.uint_bits == 32


def test_one_gap_shows_no_width() -> None:
    found = choose_dialect(["INT"], gaps=[2])
    assert found.dialect.int_bits == 16
    assert "nothing in the table shows it" in found.stated[0]


def test_sizes_show_what_they_count_by_the_types_beside_them() -> None:
    found = choose_dialect(["U16", "U32", "INT"], ["2", "4", "4"])
    assert (found.dialect.size_bits, found.dialect.int_bits) == (8, 32)
    assert choose_dialect(["U16", "U32"], ["1", "2"]).dialect.size_bits == 16
    assert choose_dialect(["U16", "U32"], ["16", "32"]).dialect.size_bits == 1


def test_texts_that_end_before_the_next_row_show_what_their_lengths_count() -> None:
    assert choose_dialect(["string[6]", "U16"], gaps=[6, 1]).dialect.characters is False
    assert choose_dialect(["string[6]", "U16"], gaps=[3, 1]).dialect.characters is True
    assert choose_dialect(["string[6]", "string[6]"], gaps=[3, 6]).dialect.characters is None


def test_what_the_user_says_of_a_dialect_wins() -> None:
    assert choose_dialect(["INT"], gaps=[1], said="int=32").dialect.int_bits == 32
    assert read_dialect("text=characters, little=all") == Dialect(characters=True, little_bytes=True)
    assert isinstance(read_dialect("foo=1"), Unclear)


@pytest.mark.parametrize(
    ("text", "orders"),
    [
        ("CDAB", (LITTLE, BIG)),
        ("ABCD", (BIG, BIG)),
        ("low word first", (LITTLE, None)),
        ("byte swap", (None, LITTLE)),
        ("4-3-2-1", (LITTLE, LITTLE)),
        ("big endian", (BIG, BIG)),
        ("MSW first", (BIG, None)),
    ],
)
def test_a_cell_of_an_order(text: str, orders: tuple[Order | None, Order | None]) -> None:
    assert parse_order(text) == orders


def test_an_order_in_a_longer_text() -> None:
    assert order_in("total energy, low word first") == (LITTLE, None)
    assert order_in("floats are CDAB") == (LITTLE, BIG)
    assert order_in("the words are swapped by hand") is None
    assert isinstance(order_in("stored in little endian"), Unclear)
    assert isinstance(order_in("ABCD or CDAB, see register 4"), Unclear)


def test_an_order_that_nobody_knows_is_unclear() -> None:
    assert isinstance(parse_order("upside down"), Unclear)
    assert isinstance(parse_order("little endian"), Unclear)
    assert parse_order("") is None


@given(st.text(max_size=24), st.text(max_size=10), st.integers(0, 20))
def test_no_type_raises(text: str, size: str, gap: int) -> None:
    assert isinstance(parse_type(text, USUAL, size=size, gap=gap), TypeCell | Unclear | None)


@given(st.text("uintsfloardbce0123468 _[]().-", max_size=16))
def test_no_text_that_looks_like_a_type_raises(text: str) -> None:
    assert isinstance(parse_type(text, USUAL), TypeCell | Unclear | None)


@given(st.lists(st.text(max_size=12), max_size=5), st.lists(st.text("0123456789 words", max_size=6), max_size=5))
def test_no_choice_of_a_dialect_raises(texts: list[str], sizes: list[str]) -> None:
    assert choose_dialect(texts, sizes, [1] * len(texts)).dialect.uint_bits in {16, 32}


@given(st.sampled_from([wire for wire in WireType if not wire.is_octets]))
def test_every_name_of_a_type_is_that_type(wire: WireType) -> None:
    found = parse_type(str(wire), USUAL)
    assert isinstance(found, TypeCell)
    assert found.type is wire
