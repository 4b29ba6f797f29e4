"""Records of files and FIFO queues as bytes: the frames that the standard prints (V1.1b3, 6.14, 6.15, 6.18)."""

import pytest

from regscribe_runtime.wire.packing import MalformedError
from regscribe_runtime.wire.parts import decode_groups
from regscribe_runtime.wire.pdu import decode_reply, decode_request, encode_reply, encode_request
from regscribe_runtime.wire.requests import Reply, Request, sizes

READ = Request(20, 4 << 16 | 1, 2)
WRITE = Request(21, 4 << 16 | 7, 3, (0x06AF, 0x04BE, 0x100D))
QUEUE = Request(24, 0x04DE << 6, 32)
WRITTEN = "15 0D 06 00 04 00 07 00 03 06 AF 04 BE 10 0D"
QUEUED = "18 00 06 00 02 01 B8 12 84"
EXCHANGES = [
    pytest.param(READ, "14 07 06 00 04 00 01 00 02", "14 06 05 06 0D FE 00 20", (0x0DFE, 0x0020), id="read a file"),
    pytest.param(WRITE, WRITTEN, WRITTEN, WRITE.words, id="write a file"),
    pytest.param(QUEUE, "18 04 DE", QUEUED, (2, 0x01B8, 0x1284, *[0] * 29), id="read a FIFO queue"),
]


@pytest.mark.parametrize(("asked_for", "asked", "answered", "words"), EXCHANGES)
def test_the_frames_of_the_standard_are_made_and_understood(
    asked_for: Request, asked: str, answered: str, words: tuple[int, ...]
) -> None:
    pdu, answer = bytes.fromhex(asked), bytes.fromhex(answered)
    assert encode_request(asked_for) == pdu
    assert decode_request(pdu) == asked_for
    reply = decode_reply(asked_for, answer)
    assert reply.words == words
    assert encode_reply(reply._replace(address=asked_for.address)) == answer
    assert sizes(asked_for)[0] == len(pdu)
    assert sizes(asked_for)[1] >= len(answer)


def test_values_of_a_queue_can_be_asked_for_from_any_place() -> None:
    assert decode_reply(Request(24, 0x04DE << 6 | 1, 3), bytes.fromhex(QUEUED)).words == (0x01B8, 0x1284, 0)


@pytest.mark.parametrize(
    ("asked_for", "answer"),
    [
        (READ, "14 06 05 07 0D FE 00 20"),
        (READ, "14 06 04 06 0D FE 00 20"),
        (READ, "14 05 05 06 0D FE 00 20"),
        (QUEUE, "18 00 06 00 03 01 B8 12 84"),
        (QUEUE, "18 00 05 00 02 01 B8 12 84"),
        (QUEUE, "18 00 05 00 02 01 B8 12"),
        (QUEUE, "18 00 42 00 20" + " 00 01" * 32),
    ],
)
def test_an_answer_whose_counts_do_not_fit_has_no_words(asked_for: Request, answer: str) -> None:
    assert decode_reply(asked_for, bytes.fromhex(answer)) == Reply(asked_for.function)


def test_a_request_can_have_several_groups_of_records() -> None:
    pdu = bytes.fromhex("14 0E 06 00 04 00 01 00 02 06 00 03 00 09 00 02")
    assert decode_groups(pdu) == [READ, Request(20, 3 << 16 | 9, 2)]


@pytest.mark.parametrize(
    "pdu",
    ["14", "14 00", "14 07 05 00 04 00 01 00 02", "14 06 06 00 04 00 01 00", "15 07 06 00 04 00 07 00 03", "18 04"],
)
def test_bytes_that_are_no_request_are_refused(pdu: str) -> None:
    with pytest.raises(MalformedError):
        decode_request(bytes.fromhex(pdu))


def test_jbus_counts_the_address_of_a_queue_from_1_and_no_record() -> None:
    assert QUEUE.shifted(1).address == 0x04DF << 6
    assert READ.shifted(1) == READ
