"""Requests and answers for Enron's registers of 32 bits: functions 3, 6 and 16, with four bytes a register.

Each address is that of one register, and a count one of registers; inside, a register is two words (`Space.ENRON`).
"""

import struct

from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.packing import MalformedError, expect_bytes, pack_words, unpack_words
from regscribe_runtime.wire.requests import (
    BLOCK_HEAD_SIZE,
    HEAD_SIZE,
    READ_HOLDING,
    WRITE_REGISTER,
    WRITE_REGISTERS,
    Reply,
    Request,
)

FUNCTIONS = frozenset({READ_HOLDING, WRITE_REGISTER, WRITE_REGISTERS})
_BYTES, _WORDS = 4, 2
_HEAD, _ADDRESSED = struct.Struct(">BH"), struct.Struct(">BHH")


def encode_request(request: Request) -> bytes:
    """Function code and data; struct.error for numbers beyond 16 bits."""
    function, address, words = request.function, Space.ENRON.plain(request.address), pack_words(request.words)
    if function == WRITE_REGISTER:
        return _HEAD.pack(function, address) + words
    head = _ADDRESSED.pack(function, address, request.quantity // _WORDS)
    return head if function == READ_HOLDING else head + struct.pack("B", len(words)) + words


def decode_request(pdu: bytes) -> Request:
    """The request of a PDU; MalformedError for a length that does not fit it."""
    function, data = pdu[0], pdu[1:]
    if function == WRITE_REGISTER:
        expect_bytes(data, _WORDS + _BYTES)
        address, *words = unpack_words(data)
        return Request(function, Space.ENRON.within(address), _WORDS, tuple(words))
    head = BLOCK_HEAD_SIZE if function == WRITE_REGISTERS else HEAD_SIZE
    expect_bytes(data[:head], head)
    address, count = unpack_words(data[:HEAD_SIZE])
    size = _BYTES * count if function == WRITE_REGISTERS else 0
    if len(data) != head + size or (size and data[HEAD_SIZE] != size):
        message = f"{count} registers of {_BYTES} bytes are announced, but {len(data) - head} bytes"
        raise MalformedError(message)
    return Request(function, Space.ENRON.within(address), _WORDS * count, unpack_words(data[head:]))


def encode_reply(reply: Reply) -> bytes:
    """Function code and data of the answer to one request."""
    if reply.function == READ_HOLDING:
        words = pack_words(reply.words)
        return struct.pack("BB", reply.function, len(words)) + words
    echo = Request(reply.function, reply.address, reply.quantity, reply.words)
    return encode_request(echo)[: _ADDRESSED.size if reply.function == WRITE_REGISTERS else None]


def decode_reply(_: Request, pdu: bytes) -> Reply:
    """An answer that is no exception; one of a wrong form has no words, so it fits no request."""
    function, data = pdu[0], pdu[1:]
    if function not in FUNCTIONS:
        return Reply(function)
    if function == READ_HOLDING:
        whole = bool(data) and data[0] == len(data) - 1 and not data[0] % 2
        return Reply(function, unpack_words(data[1:]) if whole else ())
    if len(data) != (HEAD_SIZE if function == WRITE_REGISTERS else _WORDS + _BYTES):
        return Reply(function)
    address, *words = unpack_words(data)
    if function == WRITE_REGISTERS:
        return Reply(function, (), Space.ENRON.within(address), _WORDS * words[0])
    return Reply(function, tuple(words), Space.ENRON.within(address))
