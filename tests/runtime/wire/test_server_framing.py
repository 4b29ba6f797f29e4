"""Requests in a stream: pipelined, halved, garbled, foreign."""

import itertools
import struct

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from regscribe_runtime.wire.framing import ASCII, FRAMINGS, RTU, TCP, Frame, build, has_crc
from regscribe_runtime.wire.server_framing import AsciiFramer, MbapFramer, RtuFramer, SilenceFramer, framer_for

READ = Frame(1, b"\x03\0\0\0\1")
WRITE = Frame(1, b"\x10\0\0\0\1\2\0\5")
UNKNOWN = Frame(1, b"\x41\1\2\3")


def frame(framing: str, request: Frame) -> bytes:
    return build(framing, request.unit, request.pdu, request.transaction)


@pytest.mark.parametrize("framing", FRAMINGS)
@given(data=st.data())
def test_requests_survive_any_cutting_of_the_stream(framing: str, data: st.DataObject) -> None:
    requests = data.draw(st.lists(st.sampled_from((READ, WRITE)), max_size=5))
    stream = b"".join(frame(framing, request) for request in requests)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(stream)), max_size=6)))
    framer = framer_for(framing)
    pieces = [stream[a:b] for a, b in zip([0, *cuts], [*cuts, len(stream)], strict=True)]
    assert [request for piece in pieces for request in framer.feed(piece)] == requests
    assert not framer.pending


@pytest.mark.parametrize("framing", FRAMINGS)
@given(garbage=st.binary(max_size=600), rest=st.binary(max_size=300))
def test_no_bytes_break_a_framer_or_make_it_grow(framing: str, garbage: bytes, rest: bytes) -> None:
    framer = framer_for(framing)
    framer.feed(garbage)
    framer.feed(rest)
    assert len(framer._buffer) <= 530  # type: ignore[attr-defined]  # what each framer keeps between calls
    framer.expire()
    assert not framer.pending
    assert framer.feed(frame(framing, READ)) == [READ]


@pytest.mark.parametrize("framing", FRAMINGS)
def test_after_a_silence_half_a_frame_is_forgotten(framing: str) -> None:
    framer = framer_for(framing)
    assert framer.feed(frame(framing, WRITE)[:7]) == []
    assert framer.pending
    assert framer.expire() == []
    assert framer.feed(frame(framing, READ)) == [READ]


def test_rtu_takes_the_good_frame_behind_half_a_frame() -> None:
    framer = RtuFramer()
    assert framer.feed(frame(RTU, READ)[:5] + frame(RTU, READ)) == [READ]


def test_rtu_takes_the_good_frame_behind_a_wrong_crc_and_none_of_the_bad_one() -> None:
    bad = bytearray(frame(RTU, WRITE))
    bad[-1] ^= 1
    assert RtuFramer().feed(bytes(bad) + frame(RTU, READ)) == [READ]


@given(garbage=st.binary(min_size=1, max_size=40))
@example(garbage=bytes.fromhex("1a9b175f3a5b"))  # with the next byte a sound frame of another unit
def test_rtu_finds_a_good_frame_behind_garbage_at_the_latest_after_a_silence(garbage: bytes) -> None:
    data, framer = garbage + frame(RTU, READ), RtuFramer()
    ends = itertools.combinations(range(len(data) + 1), 2)
    assume(not any(first < len(garbage) and has_crc(data[first:end]) for first, end in ends if end - first > 3))

    assert READ in framer.feed(data) + framer.expire()


def test_rtu_takes_a_frame_of_an_unknown_function_whole() -> None:
    framer = RtuFramer()
    assert framer.feed(frame(RTU, UNKNOWN)[:3]) == []
    assert framer.feed(frame(RTU, UNKNOWN)[3:] + frame(RTU, READ)) == [UNKNOWN, READ]


def test_rtu_is_not_thrown_by_the_answers_of_other_units() -> None:
    answer = frame(RTU, Frame(5, b"\x03\2\0\1"))
    framer = RtuFramer()
    assert framer.feed(answer) == []
    assert framer.feed(frame(RTU, READ)) == [READ]


def test_a_write_that_is_longer_than_the_standard_allows_is_still_a_request() -> None:
    long = Frame(1, b"\x10\0\0\0\x7f\xfe" + bytes(254))
    for framing in FRAMINGS:
        assert framer_for(framing).feed(frame(framing, long)) == [long]


def test_mbap_skips_a_foreign_protocol_by_its_length() -> None:
    foreign = struct.pack(">HHHB", 1, 7, 6, 1) + READ.pdu
    assert MbapFramer().feed(foreign + frame(TCP, READ)) == [READ]


def test_mbap_finds_the_next_header_behind_an_impossible_length() -> None:
    assert MbapFramer().feed(b"GET / HTTP/1.1\r\n\r\n" + frame(TCP, READ)) == [READ]


def test_mbap_keeps_the_transaction_of_each_request() -> None:
    requests = [Frame(1, READ.pdu, transaction) for transaction in (1, 0xFFFF, 0)]
    assert MbapFramer().feed(b"".join(frame(TCP, each) for each in requests)) == requests


@pytest.mark.parametrize("noise", [b":", b":01", b"\r\n", b":zz\r\n", b":0103\r\n", b":010300000001FF\r\n", b":0\r\n"])
def test_ascii_begins_anew_at_each_colon(noise: bytes) -> None:
    assert AsciiFramer().feed(noise + frame(ASCII, READ)) == [READ]


def test_ascii_takes_small_letters() -> None:
    assert AsciiFramer().feed(frame(ASCII, WRITE).lower()) == [WRITE]


def test_the_frames_are_those_of_the_manual() -> None:
    assert RtuFramer().feed(bytes.fromhex("38080000AABBDBB1")) == [Frame(56, b"\x08\0\0\xaa\xbb")]
    assert frame(RTU, Frame(156, bytes.fromhex("060FA90032"))) == bytes.fromhex("9C060FA90032C766")


def test_with_silence_as_the_mark_only_one_whole_request_counts() -> None:
    framer = SilenceFramer()
    assert framer.feed(frame(RTU, READ)) == [READ]
    assert framer.feed(frame(RTU, READ) * 2) == []
    assert framer.feed(frame(RTU, READ) + b"\0") == []
    assert framer.feed(frame(RTU, READ)[:-1]) == []
    assert framer.feed(frame(RTU, READ)) == [READ]


@pytest.mark.parametrize("framing", FRAMINGS)
def test_an_answer_goes_back_as_its_request_came(framing: str) -> None:
    request = Frame(7, READ.pdu, 0x1234 if framing == TCP else 0)
    (found,) = framer_for(framing).feed(frame(framing, request))
    answer = framer_for(framing).answer(found, b"\x03\x02\x00\x2a")
    assert answer == build(framing, 7, b"\x03\x02\x00\x2a", request.transaction)


def test_another_framing_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match="framing 'mbap' is none of tcp, rtu, ascii"):
        framer_for("mbap")
