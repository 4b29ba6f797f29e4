"""Words and bits as bytes, and bytes that are no request."""

import struct
from collections.abc import Sequence

from regscribe_runtime.wire.requests import BYTES_IN_WORD, bytes_of_bits


class MalformedError(ValueError):
    """The bytes are no request of their function."""


def expect_bytes(data: bytes, expected: int) -> None:
    """Raise MalformedError unless so many bytes stand behind the function code."""
    if len(data) != expected:
        message = f"{len(data)} bytes after the function code, {expected} expected"
        raise MalformedError(message)


def pack_words(words: Sequence[int]) -> bytes:
    """Words as they are sent, the high byte first; struct.error for one of more than 16 bits."""
    return struct.pack(f">{len(words)}H", *words)


def unpack_words(data: bytes) -> tuple[int, ...]:
    """The words of an even number of bytes."""
    return struct.unpack(f">{len(data) // BYTES_IN_WORD}H", data)


def pack_bits(bits: Sequence[int]) -> bytes:
    """Bits as they are sent: the first is the least significant of the first byte."""
    number = sum(bool(bit) << place for place, bit in enumerate(bits))
    return number.to_bytes(bytes_of_bits(len(bits)), "little")


def unpack_bits(data: bytes, count: int) -> tuple[int, ...]:
    """The first `count` bits of `data`."""
    number = int.from_bytes(data, "little")
    return tuple(number >> place & 1 for place in range(count))
