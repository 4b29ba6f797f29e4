"""Requests and answers as bytes without their frame: function code and data (Modbus Application Protocol V1.1b3)."""

import struct

from regscribe_runtime.wire import requests as functions
from regscribe_runtime.wire.requests import Reply, Request

EXCEPTION_BIT = 0x80
ON = 0xFF00
BITS_IN_BYTE = 8
WORD_READS = (functions.READ_HOLDING, functions.READ_INPUT)
BIT_READS = (functions.READ_COILS, functions.READ_DISCRETE_INPUTS)
ADDRESSED = struct.Struct(">BHH")
HEAD = struct.Struct(">BH")
WORDS = tuple(struct.Struct(f">{count}H") for count in range(128))


def encode(request: Request) -> bytes:
    """Function code and data; ValueError for what no frame can carry."""
    function, address, quantity, words, _ = request
    try:
        if function in WORD_READS or function in BIT_READS:
            return ADDRESSED.pack(function, address, quantity)
        return _write(function, address, words)
    except struct.error:
        message = f"function {function:02d}, address {address}, words {list(words)}: each is a number from 0 to 65535"
        raise ValueError(message) from None


def _write(function: int, address: int, words: tuple[int, ...]) -> bytes:
    match function:
        case functions.WRITE_COIL:
            return ADDRESSED.pack(function, address, ON if words[0] else 0)
        case functions.READ_STATUS:
            return bytes([function])
        case functions.WRITE_COILS:
            packed = sum(bool(bit) << at for at, bit in enumerate(words))
            data = packed.to_bytes(-(-len(words) // BITS_IN_BYTE), "little")
            return ADDRESSED.pack(function, address, len(words)) + bytes([len(data)]) + data
        case functions.WRITE_REGISTERS:
            data = struct.pack(f">{len(words)}H", *words)
            return ADDRESSED.pack(function, address, len(words)) + struct.pack("B", len(data)) + data
        case _:
            return HEAD.pack(function, address) + struct.pack(f">{len(words)}H", *words)


def decode(request: Request, pdu: bytes) -> Reply:
    """The answer that `pdu` spells; what has a wrong length or byte count has no words, so it fits no request."""
    code = pdu[0]
    if code in WORD_READS and len(pdu) > 1 and pdu[1] == len(pdu) - 2 and not pdu[1] % 2:
        return Reply(code, WORDS[pdu[1] // 2].unpack_from(pdu, 2))
    data = pdu[1:]
    if code & EXCEPTION_BIT:  # a good answer with one bit flipped has more than one byte: it is no refusal
        return Reply(code & ~EXCEPTION_BIT, exception=data[0]) if len(data) == 1 else Reply(code)
    if code in BIT_READS and data and data[0] == len(data) - 1:
        return Reply(code, _bits(data[1:], request.quantity))
    if code in WORD_READS or code in BIT_READS:
        return Reply(code)
    if code == functions.READ_STATUS:
        return Reply(code, tuple(data))
    return _echoed(code, data)


def _words(data: bytes) -> tuple[int, ...]:
    return struct.unpack(f">{len(data) // 2}H", data) if len(data) % 2 == 0 else ()


def _bits(data: bytes, count: int) -> tuple[int, ...]:
    # bits come in whole bytes: more or fewer bytes than asked for must not look like a good answer
    whole = len(data) == -(-count // BITS_IN_BYTE)
    packed = int.from_bytes(data, "little")
    return tuple(packed >> at & 1 for at in range(count if whole else len(data) * BITS_IN_BYTE))


def _echoed(code: int, data: bytes) -> Reply:
    words = _words(data)
    if len(words) < 2:  # noqa: PLR2004 (an address and a value or a quantity)
        return Reply(code)
    address, value = words[0], words[1]
    if code in (functions.WRITE_COILS, functions.WRITE_REGISTERS):
        return Reply(code, (), address, value)
    if code == functions.WRITE_COIL:
        value = {ON: 1, 0: 0}.get(value, value)
        return Reply(code, (value,), address)
    return Reply(code, words[1:], address)
