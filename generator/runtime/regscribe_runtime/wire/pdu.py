"""Requests and answers as bytes without their frame, in both roles (Modbus Application Protocol V1.1b3).

A client encodes requests and decodes answers in the light of them; a device decodes requests, strictly, and encodes
its answers.
"""

import struct
from typing import Protocol

from regscribe_runtime.values.wire_types import ENRON_BIT, WRITE_AND_READ
from regscribe_runtime.wire import enron, identification, parts
from regscribe_runtime.wire import requests as functions
from regscribe_runtime.wire.packing import (
    MalformedError,
    expect_bytes,
    pack_bits,
    pack_words,
    unpack_bits,
    unpack_words,
)
from regscribe_runtime.wire.requests import (
    BIT_READS,
    BITS_IN_BYTE,
    WORD_READS,
    WRITE_REGISTERS,
    Reply,
    Request,
    bytes_of_bits,
)

EXCEPTION_BIT = 0x80
ON, OFF = 0xFF00, 0x0000
ADDRESSED = struct.Struct(">BHH")
HEAD = struct.Struct(">BH")
WORDS = tuple(struct.Struct(f">{count}H") for count in range(128))

_DATA_SIZES = {
    **dict.fromkeys((*BIT_READS, *WORD_READS), 4),
    **dict.fromkeys((functions.WRITE_COIL, functions.WRITE_REGISTER, functions.LOOPBACK), 4),
    functions.READ_STATUS: 0,
    functions.MASK_REGISTER: 6,
}
"""By function code: the bytes of a request behind it; those of a block write follow from its head."""


class _Form(Protocol):
    """The module of a function whose requests have another form than an address with a quantity."""

    def encode_request(self, request: Request) -> bytes: ...
    def decode_request(self, pdu: bytes) -> Request: ...
    def encode_reply(self, reply: Reply) -> bytes: ...
    def decode_reply(self, request: Request, pdu: bytes) -> Reply: ...


_FORMS: dict[int, _Form] = {**dict.fromkeys(parts.FUNCTIONS, parts), functions.IDENTIFY: identification}


class CoilStateError(MalformedError):
    """A coil is to be neither on nor off."""


def encode_request(request: Request) -> bytes:
    """Encode function code and data; ValueError for numbers beyond 16 bits."""
    function, address, quantity, words = request[:4]
    try:
        if address >= ENRON_BIT:
            return enron.encode_request(request)
        if function in WORD_READS or function in BIT_READS:
            return ADDRESSED.pack(function, address, quantity)
        if function == WRITE_AND_READ:
            return ADDRESSED.pack(function, address, quantity) + _write(WRITE_REGISTERS, request.into, words)[1:]
        special = _FORMS.get(function)
        return special.encode_request(request) if special else _write(function, address, words)
    except struct.error:
        message = f"function {function:02d}, address {address}, words {list(words)}: each is a number from 0 to 65535"
        raise ValueError(message) from None


def _write(function: int, address: int, words: tuple[int, ...]) -> bytes:
    match function:
        case functions.WRITE_COIL:
            return ADDRESSED.pack(function, address, ON if words[0] else OFF)
        case functions.READ_STATUS:
            return bytes([function])
        case functions.WRITE_COILS | functions.WRITE_REGISTERS:
            data = pack_bits(words) if function == functions.WRITE_COILS else pack_words(words)
            return ADDRESSED.pack(function, address, len(words)) + struct.pack("B", len(data)) + data
        case _:
            return HEAD.pack(function, address) + pack_words(words)


def decode_request(pdu: bytes) -> Request:
    """Decode a request; MalformedError for an unknown function, or a length that does not fit it.

    A coil's state is 0 or 1 in `words`.
    """
    function, data = pdu[0], pdu[1:]
    if special := _FORMS.get(function):
        return special.decode_request(pdu)
    if function in functions.BLOCK_WRITES:
        return _block_write(function, data)
    if function == WRITE_AND_READ:
        return _write_and_read(data)
    if function not in _DATA_SIZES:
        message = f"function {function:02d} is not known"
        raise MalformedError(message)
    expect_bytes(data, _DATA_SIZES[function])
    address, *words = unpack_words(data) or (0,)
    if function in WORD_READS or function in BIT_READS:
        return Request(function, address, words[0])
    if function == functions.WRITE_COIL:
        words = [_coil_state(words[0])]
    return Request(function, address, 1, tuple(words))


def _block_write(function: int, data: bytes) -> Request:
    head, values = data[: functions.BLOCK_HEAD_SIZE], data[functions.BLOCK_HEAD_SIZE :]
    expect_bytes(head, functions.BLOCK_HEAD_SIZE)
    expect_bytes(data, functions.BLOCK_HEAD_SIZE + head[-1])
    address, quantity = unpack_words(head[:-1])
    bits = function == functions.WRITE_COILS
    if len(values) != (bytes_of_bits(quantity) if bits else functions.BYTES_IN_WORD * quantity):
        message = f"{quantity} {'bits' if bits else 'words'} are announced, but {len(values)} bytes"
        raise MalformedError(message)
    return Request(function, address, quantity, unpack_bits(values, quantity) if bits else unpack_words(values))


def _write_and_read(data: bytes) -> Request:
    head = data[: functions.HEAD_SIZE]
    expect_bytes(head, functions.HEAD_SIZE)
    (address, quantity), write = unpack_words(head), _block_write(WRITE_REGISTERS, data[functions.HEAD_SIZE :])
    return Request(WRITE_AND_READ, address, quantity, write.words, into=write.address)


def _coil_state(word: int) -> int:
    if word not in (ON, OFF):
        message = f"{word:04X} is no state of a coil: FF00 is on, 0000 is off"
        raise CoilStateError(message)
    return int(word == ON)


def encode_reply(reply: Reply) -> bytes:
    """Function code and data of an answer."""
    function, words, address, quantity, exception = reply
    if exception is not None:
        return bytes((function | EXCEPTION_BIT, exception))
    if special := enron if address >= ENRON_BIT else _FORMS.get(function):
        return special.encode_reply(reply)
    if function in functions.BLOCK_WRITES:
        return ADDRESSED.pack(function, address, quantity)
    if function == functions.READ_STATUS:
        return bytes((function, *words))
    if function in BIT_READS or function in WORD_READS or function == WRITE_AND_READ:
        data = pack_bits(words) if function in BIT_READS else pack_words(words)
        return bytes((function, len(data))) + data
    return _write(function, address, words)


def decode_reply(request: Request, pdu: bytes) -> Reply:
    """Decode an answer; one of a wrong length or byte count gets no words, so it fits no request."""
    code = pdu[0]
    enrons = request.address >= ENRON_BIT and not code & EXCEPTION_BIT
    if special := enron if enrons else _FORMS.get(code):
        return special.decode_reply(request, pdu)
    if code in WORD_READS or code == WRITE_AND_READ:
        return _words_read(pdu)
    data = pdu[1:]
    if code & EXCEPTION_BIT:  # a good answer with one bit flipped has more than one byte: it is no refusal
        return Reply(code & ~EXCEPTION_BIT, exception=data[0]) if len(data) == 1 else Reply(code)
    if code in BIT_READS:
        return _bits_read(code, data, request.quantity)
    if code == functions.READ_STATUS:
        return Reply(code, tuple(data))
    return _echoed(code, data)


def _words_read(pdu: bytes) -> Reply:
    if len(pdu) > 1 and pdu[1] == len(pdu) - 2 and not pdu[1] % 2:
        return Reply(pdu[0], WORDS[pdu[1] // 2].unpack_from(pdu, 2))
    return Reply(pdu[0])


def _bits_read(code: int, data: bytes, count: int) -> Reply:
    if not data or data[0] != len(data) - 1:
        return Reply(code)
    # bits come in whole bytes: more or fewer bytes than asked for must not look like a good answer
    return Reply(code, unpack_bits(data[1:], count if data[0] == bytes_of_bits(count) else data[0] * BITS_IN_BYTE))


def _echoed(code: int, data: bytes) -> Reply:
    words = unpack_words(data) if len(data) % 2 == 0 else ()
    if len(words) < 2:  # noqa: PLR2004 (an address and a value or a quantity)
        return Reply(code)
    address, value = words[0], words[1]
    if code in functions.BLOCK_WRITES:
        return Reply(code, (), address, value)
    if code == functions.WRITE_COIL:
        value = {ON: 1, OFF: 0}.get(value, value)
        return Reply(code, (value,), address)
    return Reply(code, words[1:], address)
