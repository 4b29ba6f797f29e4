"""Bits of a column of their own."""

from hypothesis import given
from hypothesis import strategies as st

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.bits import parse_bits


def test_bits_alone_and_several() -> None:
    assert parse_bits(["5", "bit 3", "b15", "0-3", "7..4", "", "-"]).cells == (
        (5, 5),
        (3, 3),
        (15, 15),
        (0, 3),
        (4, 7),
        None,
        None,
    )


def test_they_count_from_1_where_16_occurs_and_0_does_not() -> None:
    found = parse_bits(["1", "2-4", "16"])
    assert found.cells == ((0, 0), (1, 3), (15, 15))
    assert "count from 1" in found.evidence


def test_16_beside_0_is_unclear() -> None:
    first, last = parse_bits(["0", "16"]).cells
    assert first == (0, 0)
    assert isinstance(last, Unclear)


def test_what_is_no_bit_is_unclear() -> None:
    assert all(isinstance(cell, Unclear) for cell in parse_bits(["x", "17", "1.5.2", "high"]).cells)


@given(st.lists(st.text(max_size=8), max_size=5))
def test_no_column_raises(texts: list[str]) -> None:
    assert len(parse_bits(texts).cells) == len(texts)
