"""Frames of worked examples, read by the standard; times by the manual's own arithmetic."""

import pytest

from regscribe.checks.frames import Frame, MalformedError, crc16, parse
from regscribe.checks.worked import bits_per_character


@pytest.mark.parametrize("frame", ["01 03 00 00 00 04 44 09", "9C 06 0F A9 00 32 C7 66"])
def test_the_crc_of_a_known_frame_is_as_printed(frame: str) -> None:
    data = bytes.fromhex(frame)
    assert crc16(data[:-2]).to_bytes(2, "little") == data[-2:]


@pytest.mark.parametrize(
    ("text", "answer", "frame"),
    [
        ("01 03 00 40 00 04", False, Frame(1, 3, 64, 4)),
        ("01 03 04 43 7A 00 00", True, Frame(1, 3, None, 2, (0x437A, 0))),
        ("01 06 00 48 68 25", False, Frame(1, 6, 72, 1, (26661,))),
        ("01 10 1B 58 00 02 04 00 55 00 5C", False, Frame(1, 16, 7000, 2, (85, 92))),
        ("01 10 1B 58 00 02", True, Frame(1, 16, 7000, 2)),
        ("01 83 02", True, Frame(1, 3)),
        ("01 07", False, Frame(1, 7)),
    ],
)
def test_a_frame_says_unit_function_address_count_and_words(text: str, answer: bool, frame: Frame) -> None:  # noqa: FBT001 (a column of the table)
    assert parse(bytes.fromhex(text), answer=answer) == frame


@pytest.mark.parametrize(
    "text", ["01", "01 03 00 40 00", "01 10 00 00 00 02 04 00 55", "01 10 00 00 00 02 02 00 55", "01 10"]
)
def test_a_frame_of_a_wrong_length_is_refused(text: str) -> None:
    with pytest.raises(MalformedError):
        parse(bytes.fromhex(text), answer=False)


@pytest.mark.parametrize(("line", "bits"), [("8N1", 10), ("8E1", 11), ("8O1", 11), ("7E2", 11)])
def test_a_character_has_start_data_parity_and_stop_bits(line: str, bits: int) -> None:
    assert bits_per_character(line) == bits
