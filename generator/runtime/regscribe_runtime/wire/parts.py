"""Requests and answers for spaces of many parts: records of files (functions 20, 21), FIFO queues (24).

Modbus Application Protocol V1.1b3, sections 6.14, 6.15 and 6.18. An address has the number of the file, or the
address of the queue, in its high bits (`Space.part_bits`).
"""

import struct
from collections.abc import Sequence

from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.packing import MalformedError, expect_bytes, pack_words, unpack_words
from regscribe_runtime.wire.requests import BYTES_IN_WORD, READ_FILE, READ_QUEUE, WRITE_FILE, Reply, Request

FUNCTIONS = frozenset({READ_FILE, WRITE_FILE, READ_QUEUE})
_REFERENCE_TYPE = 6
_GROUP, _SUB_ANSWER, _COUNTS = struct.Struct(">BHHH"), struct.Struct("BB"), struct.Struct(">HH")


def encode_request(request: Request) -> bytes:
    """Function code and data; struct.error for numbers beyond 16 bits."""
    function, address, quantity, words = request[:4]
    if function == READ_QUEUE:
        return struct.pack(">BH", function, address >> Space.QUEUE.part_bits)
    group = _group(address, quantity) + pack_words(words)
    return struct.pack("BB", function, len(group)) + group


def _group(address: int, quantity: int) -> bytes:
    file, record = address >> Space.FILE.part_bits, address & 0xFFFF
    return _GROUP.pack(_REFERENCE_TYPE, file, record, quantity)


def decode_request(pdu: bytes) -> Request:
    """The request of a PDU that has one group of records; MalformedError for another one."""
    if pdu[0] == READ_QUEUE:
        expect_bytes(pdu[1:], 2)
        return Request(READ_QUEUE, unpack_words(pdu[1:])[0] << Space.QUEUE.part_bits, Space.QUEUE.most)
    found = decode_groups(pdu)
    if len(found) != 1:
        message = f"{len(found)} groups of records; one is understood here"
        raise MalformedError(message)
    return found[0]


def decode_groups(pdu: bytes) -> list[Request]:
    """A request for each group of records in a PDU of function 20 or 21; MalformedError if the bytes are none."""
    function, data = pdu[0], pdu[2:]
    expect_bytes(pdu[1:], 1 + pdu[1] if len(pdu) > 1 else 1)
    found = []
    while len(data) >= _GROUP.size:
        kind, file, record, quantity = _GROUP.unpack_from(data)
        size = _GROUP.size + (BYTES_IN_WORD * quantity if function == WRITE_FILE else 0)
        if kind != _REFERENCE_TYPE or len(data) < size:
            message = f"{data.hex(' ')} is no group of records"
            raise MalformedError(message)
        address = file << Space.FILE.part_bits | record
        found.append(Request(function, address, quantity, unpack_words(data[_GROUP.size : size])))
        data = data[size:]
    if data or not found:
        message = f"{len(data)} bytes are too few for a group of records"
        raise MalformedError(message)
    return found


def encode_reply(reply: Reply) -> bytes:
    """Function code and data of the answer to one request; the words of a queue are its count and all its places."""
    if reply.function == WRITE_FILE:
        return encode_request(Request(WRITE_FILE, reply.address, len(reply.words), reply.words))
    if reply.function == READ_FILE:
        return join_records([reply.words])
    words = reply.words[: 1 + reply.words[0]]
    return struct.pack(">BH", READ_QUEUE, BYTES_IN_WORD * len(words)) + pack_words(words)


def join_records(groups: Sequence[Sequence[int]]) -> bytes:
    """The answer of function 20 with the records of each group."""
    data = b"".join(
        _SUB_ANSWER.pack(1 + BYTES_IN_WORD * len(words), _REFERENCE_TYPE) + pack_words(words) for words in groups
    )
    return struct.pack("BB", READ_FILE, len(data)) + data


def decode_reply(request: Request, pdu: bytes) -> Reply:
    """An answer in the light of its request; one of a wrong form has no words, so it fits no request."""
    if pdu[0] == WRITE_FILE:
        try:
            echo = decode_request(pdu)
        except MalformedError:
            return Reply(WRITE_FILE)
        return Reply(WRITE_FILE, echo.words, echo.address, echo.quantity)
    return Reply(pdu[0], _records(pdu) if pdu[0] == READ_FILE else _queue(request, pdu))


def _records(pdu: bytes) -> tuple[int, ...]:
    head, data = pdu[1:4], pdu[4:]
    return unpack_words(data) if head == bytes((len(data) + 2, len(data) + 1, _REFERENCE_TYPE)) else ()


def _queue(request: Request, pdu: bytes) -> tuple[int, ...]:
    """The words that were asked for of count and values, 0 behind the last value."""
    head, values = pdu[1 : 1 + _COUNTS.size], pdu[1 + _COUNTS.size :]
    count = len(values) // BYTES_IN_WORD
    whole = len(values) == BYTES_IN_WORD * count and count < Space.QUEUE.most
    if not whole or head != _COUNTS.pack(len(values) + BYTES_IN_WORD, count):
        return ()
    words = (count, *unpack_words(values))
    first = request.address & (1 << Space.QUEUE.part_bits) - 1
    return (*words, *[0] * (Space.QUEUE.most - len(words)))[first : first + request.quantity]
