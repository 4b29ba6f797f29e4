"""Device identification as bytes: the frames that the standard prints, and streams (V1.1b3, 6.21)."""

import pytest

from regscribe_runtime.wire.identification import BASIC, EXTENDED, INDIVIDUAL, REGULAR, encode_objects
from regscribe_runtime.wire.packing import MalformedError
from regscribe_runtime.wire.pdu import decode_reply, decode_request, encode_request
from regscribe_runtime.wire.requests import Reply, Request

OBJECTS = {0: b"Company identification", 1: b"Product code XX", 2: b"V2.11"}


def test_a_stream_of_basic_objects_is_the_one_that_the_standard_prints() -> None:
    text = b"\x00\x16Company identification\x01\x0fProduct code XX\x02\x05V2.11"
    assert encode_objects(BASIC, 0, OBJECTS) == bytes.fromhex("2B 0E 01 83 00 00 03") + text


def test_one_object_is_asked_for_and_understood() -> None:
    request = Request(43, 2 << 8, 123)
    assert encode_request(request) == bytes.fromhex("2B 0E 04 02")
    assert decode_request(bytes.fromhex("2B 0E 04 02")) == request
    answer = encode_objects(INDIVIDUAL, 2, OBJECTS)
    assert answer == bytes.fromhex("2B 0E 04 83 00 00 01 02 05 56 32 2E 31 31")
    assert decode_reply(request, answer).words[:4] == (0x5632, 0x2E31, 0x3100, 0)


def test_a_stream_that_is_too_long_says_where_it_goes_on() -> None:
    objects = dict.fromkeys(range(5), b"x" * 100)
    answer = encode_objects(REGULAR, 0, objects)
    assert answer[4:7] == bytes((0xFF, 2, 2))
    assert encode_objects(REGULAR, 2, objects)[4:8] == bytes((0xFF, 4, 2, 2))
    assert encode_objects(REGULAR, 4, objects)[4:8] == bytes((0, 0, 1, 4))


def test_a_stream_from_an_unknown_object_begins_at_0() -> None:
    assert encode_objects(EXTENDED, 9, OBJECTS)[6:8] == bytes((3, 0))


@pytest.mark.parametrize(
    "answer",
    ["2B 0E 04 83 00 00 01 03 01 41", "2B 0E 01 83 00 00 01 02 01 41", "2B 0E 04 83 00 00 01 02 05 41", "2B 0D"],
)
def test_an_answer_about_something_else_has_no_words(answer: str) -> None:
    assert decode_reply(Request(43, 2 << 8, 123), bytes.fromhex(answer)) == Reply(43)


@pytest.mark.parametrize("pdu", ["2B", "2B 0D 04 00", "2B 0E 05 00", "2B 0E 00 00", "2B 0E 04", "2B 0E 04 00 00"])
def test_bytes_that_are_no_request_are_refused(pdu: str) -> None:
    with pytest.raises(MalformedError):
        decode_request(bytes.fromhex(pdu))
