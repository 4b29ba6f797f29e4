"""Points of a source as registers: bits together, doubles as one, overlaps told with both places."""

from typing import Any

from regscribe.draft import Entry, Outcome
from regscribe.importers.shared.collect import collected
from regscribe.importers.shared.points import Point
from regscribe.model import Span, WireType


def point(name: str, at: int, line: int, **more: Any) -> Point:
    return Point(name=name, at=at, place=Span("source", line, 1, line, 1), **more)


def keys_of(*points: Point) -> list[Any]:
    return [entry.keys and dict(entry.keys) for entry in collected(points)[0]]


def test_bits_of_one_word_are_its_flags() -> None:
    (entry,), findings = collected([point("Run", 5, 1, bits=(0, 0)), point("Alarm", 5, 2, bits=(3, 3))])
    assert findings == ()
    assert entry.keys == {"at": 5, "name": "Word holding 5", "access": "r", "flags": {0: "Run", 3: "Alarm"}}
    assert [row.name for row in entry.each] == ["Run", "Alarm"]


def test_parts_with_more_than_a_label_are_fields() -> None:
    (keys,) = keys_of(point("Mode", 5, 1, bits=(0, 2), more={"enum": {0: "off"}}), point("Level", 5, 2, bits=(8, 15)))
    assert keys["fields"] == {
        "mode": {"bits": "0..2", "label": "Mode", "enum": {0: "off"}},
        "level": {"bits": "8..15", "label": "Level"},
    }


def test_a_word_can_be_written_if_one_of_its_bits_can_and_the_others_are_told() -> None:
    (entry,) = collected([point("Run", 5, 1, bits=(0, 0), access="rw"), point("Alarm", 5, 2, bits=(3, 3))])[0]
    assert entry.keys is not None
    assert entry.keys["access"] == "rw"
    assert [[remark.code for remark in row.remarks] for row in entry.each] == [[], ["access-changed"]]


def test_bits_beside_the_number_of_their_word_read_it_again() -> None:
    bits, whole = keys_of(point("Run", 5, 1, bits=(0, 0), access="rw"), point("State", 5, 2, access="rw"))
    assert (bits["rereads"], bits["access"]) == ("state", "r")
    assert whole == {"at": 5, "name": "State", "access": "rw"}


def test_bits_of_one_word_of_two_read_these_again() -> None:
    narrow, wide = keys_of(point("Run", 6, 1, bits=(0, 0)), point("Level", 5, 2, bits=(8, 20), type=WireType.UINT32))
    assert narrow["rereads"] == "level"
    assert wide["fields"] == {"level": {"bits": "8..20", "label": "Level"}}


def test_bits_that_overlap_are_a_finding_and_the_first_count() -> None:
    entries, (finding,) = collected([point("A", 5, 1, bits=(0, 3)), point("B", 5, 2, bits=(3, 4))])
    assert [row.outcome for entry in entries for row in entry.each] == [Outcome.WHOLE, Outcome.LEFT_OUT]
    assert (finding.span.line, finding.related[0].span.line) == (2, 1)


def test_two_rows_of_the_same_register_are_one() -> None:
    (entry,), findings = collected([point("Setpoint", 5, 1, unit="V"), point("Set", 5, 2, access="rw")])
    assert findings == ()
    assert entry.keys == {"at": 5, "name": "Setpoint", "access": "rw", "unit": "V"}
    assert [remark.code for remark in entry.each[1].remarks] == ["same-register"]
    assert entry.each[1].outcome is Outcome.WHOLE


def test_what_the_second_row_says_otherwise_is_lost_and_told() -> None:
    (entry,) = collected([point("A", 5, 1, unit="V"), point("B", 5, 2, unit="A", more={"range": "0..5"})])[0]
    assert entry.each[1].outcome is Outcome.WITH_LOSS
    assert "its unit is not taken over" in entry.each[1].remarks[0].message


def test_rows_that_contradict_each_other_are_a_finding_and_the_first_counts() -> None:
    entries, (finding,) = collected([point("A", 5, 1), point("B", 5, 2, type=WireType.INT16)])
    assert [entry.outcome for entry in entries] == [Outcome.WHOLE, Outcome.LEFT_OUT]
    assert "says the same addresses otherwise than `A` (source:1:1)" in finding.message


def test_numbers_that_overlap_are_a_finding() -> None:
    entries, (finding,) = collected([point("A", 5, 1, type=WireType.UINT32), point("B", 6, 2)])
    assert [entry.outcome for entry in entries] == [Outcome.WHOLE, Outcome.LEFT_OUT]
    assert "overlaps `A`" in finding.message


def test_two_bytes_of_a_word_stand_beside_each_other() -> None:
    low, high = keys_of(
        point("Low", 5, 1, type=WireType.UINT8), point("High", 5, 2, type=WireType.UINT8, more={"byte": "high"})
    )
    assert (low["type"], high["byte"]) == ("uint8", "high")


def test_words_apart_leave_what_stands_between_them() -> None:
    entries, findings = collected([point("A", 5, 1, type=WireType.UINT32, more={"at": [7, 5]}), point("B", 6, 2)])
    assert findings == ()
    assert all(isinstance(entry, Entry) and entry.keys is not None for entry in entries)


def test_a_part_whose_scale_is_unclear_has_neither_unit_nor_limits() -> None:
    (keys,) = keys_of(point("A", 5, 1, bits=(0, 7), multiply=None, unit="V", more={"range": "0..5"}))
    assert keys["fields"] == {"a": {"bits": "0..7", "label": "A"}}
