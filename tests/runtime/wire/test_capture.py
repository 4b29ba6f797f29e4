"""Frames in bytes that were captured: which kind they are of, and what is wrong with them."""

import pytest

from regscribe_runtime.wire.capture import CapturedFrame, frames
from regscribe_runtime.wire.framing import ASCII, FRAMINGS, RTU, TCP, build

ASK = bytes.fromhex("03 00 00 00 02")
ANSWER = bytes.fromhex("03 04 00 01 00 02")
WRITE = bytes.fromhex("10 1F 44 00 02 04 00 00 42 C6")


def found(raw: bytes, framing: str = "") -> list[tuple[str, int, bytes, str]]:
    return [(one.framing, one.unit, one.pdu, one.complaint) for one in frames(raw, framing)]


@pytest.mark.parametrize("told", [True, False])
@pytest.mark.parametrize("framing", FRAMINGS)
@pytest.mark.parametrize("pdu", [ASK, ANSWER, WRITE, b"\x83\x02", b"\x07", b"\x16\x00\x04\x00\xf2\x00\x25"])
def test_a_frame_of_any_kind_is_found_with_and_without_being_told(pdu: bytes, framing: str, *, told: bool) -> None:
    raw = build(framing, 17, pdu, 5)
    assert found(raw, framing if told else "") == [(framing, 17, pdu, "")]


@pytest.mark.parametrize("framing", FRAMINGS)
def test_frames_that_follow_each_other_are_told_apart(framing: str) -> None:
    sent = [WRITE, b"\x10\x1f\x44\x00\x02", ASK, ANSWER, b"\x83\x02", b"\x07", b"\x07\x5a"]
    raw = b"".join(build(framing, 1, pdu, at) for at, pdu in enumerate(sent))
    assert [one.pdu for one in frames(raw)] == sent


def test_a_frame_of_rtu_whose_bytes_look_like_a_tcp_header_is_one_of_rtu() -> None:
    raw = build(RTU, 0, bytes.fromhex("01 00 00 00 04 01 03"))
    assert found(raw) == [(RTU, 0, raw[1:-2], "")]


def test_a_wrong_check_is_told_with_the_right_one() -> None:
    raw = build(RTU, 1, ASK)
    assert frames(raw[:-1] + b"\0")[0].complaint == "its CRC is C4 00, but C4 0B would be right"
    line = build(ASCII, 1, ASK).replace(b"FA", b"FB")
    assert frames(line)[0].complaint == "its LRC is FB, but FA would be right"


def test_what_is_no_frame_says_so() -> None:
    assert found(b"\x01\x03\x00") == [(RTU, 1, b"\x03\x00", "too short for a frame")]
    (short,) = frames(build(TCP, 1, ASK)[:-1], TCP)
    assert short.complaint == "no header of Modbus TCP that fits its length"
    (odd,) = frames(b":010\r\n")
    assert odd.complaint == "no frame of Modbus ASCII: a colon and pairs of hexadecimal digits"
    assert frames(b"\x01") == frames(b"") == []


def test_a_function_is_told_without_the_mark_of_an_exception() -> None:
    assert CapturedFrame(RTU, 1, b"\x83\x02", b"").function == 3
