"""Faults of a table that no single cell shows."""

from fractions import Fraction
from typing import Any

from regscribe.importers.table.cells.detect import Row, detect
from regscribe.importers.table.cells.ranges import Limits
from regscribe.importers.table.cells.scales import Scale
from regscribe.model import Severity, Space, Span, WireType

NAMES = iter(range(1, 10**6))


def row(at: int, wire: str = "uint16", **more: Any) -> Row:
    line = next(NAMES)
    own = WireType(wire)
    return Row(
        **{
            "name": f"r{at}",
            "place": Span("list.csv", line, 1, line, 1),
            "where": f"row {line}",
            "space": Space.HOLDING,
            "at": at,
            "words": own.words,
            "wire": own,
        }
        | more
    )


def messages(*rows: Row) -> list[str]:
    return [one.message for one in detect(rows)]


def test_rows_that_follow_each_other_are_no_fault() -> None:
    assert messages(row(0), row(1, "uint32"), row(3), row(3, space=Space.INPUT)) == []


def test_an_address_that_stands_twice_names_both_rows() -> None:
    first, second = row(5), row(5, name="again")
    (found,) = detect([first, second])
    assert "`again` at 5 is there twice, the first is `r5` at 5" in found.message
    assert (found.span, found.related[0].span, found.severity) == (second.place, first.place, Severity.WARNING)


def test_bits_of_one_word_are_no_doubles_unless_they_share_a_bit() -> None:
    assert messages(row(5, bits=(0, 0)), row(5, bits=(1, 3)), row(5)) == []
    assert len(messages(row(5, bits=(0, 2)), row(5, bits=(2, 4)))) == 1


def test_a_register_inside_a_wider_one_is_named_with_its_addresses() -> None:
    (found,) = messages(row(10, "float32"), row(11))
    assert "`r11` at 11 lies inside `r10` at 10, which takes 10..11" in found


def test_a_long_text_is_seen_behind_a_row_inside_it() -> None:
    assert len(messages(row(0, "string", words=8), row(2), row(6))) == 2


def test_types_with_twice_their_width_to_the_next_row_are_told_once() -> None:
    assert len(messages(row(0), row(2), row(4), row(6))) == 1
    assert messages(row(0), row(2), row(4), row(5)) == []


def test_a_range_beyond_the_type_is_told_with_the_limits_of_the_type() -> None:
    (found,) = messages(row(0, limits=Limits(Fraction(0), Fraction(65536))))
    assert "the maximum 65536 of `r0` at 0 does not fit its uint16: 0..65535" in found
    tenth = Scale(Fraction(1, 10))
    assert messages(row(0, "int16", limits=Limits(Fraction("-3276.8"), Fraction("3276.7")), scale=tenth)) == []


def test_a_default_outside_the_range_is_told_unless_it_is_a_code() -> None:
    limits = Limits(Fraction(1), Fraction(10))
    (found,) = messages(row(0, limits=limits, default=Fraction(0)))
    assert "the default 0 of `r0` at 0 is outside its range 1..10" in found
    assert messages(row(0, limits=limits, default=Fraction(0), codes=frozenset({Fraction(0)}))) == []


def test_a_bit_above_15_is_told() -> None:
    (found,) = messages(row(0, bits=(16, 16)))
    assert "bit 16" in found
