"""The form of an answer: how a request is refused, and how bits are packed."""

from collections.abc import Sequence

from regscribe.model import SILENCE

EXCEPTION_BIT = 0x80


class Refusal(Exception):  # noqa: N818 -- the device refuses; nothing went wrong in the program
    """The device does not do what the request asks: `code` is its exception code, or `SILENCE`."""

    def __init__(self, code: int) -> None:
        super().__init__(f"exception code {code}" if code != SILENCE else "no answer")
        self.code = code


def exception_answer(function: int, code: int) -> bytes | None:
    """Return the exception answer to `function`; None where the device keeps silent."""
    return None if code == SILENCE else bytes((function | EXCEPTION_BIT, code))


def pack_bits(bits: Sequence[int]) -> bytes:
    """Pack bits as functions 01 and 02 transmit them: the first is the least significant of the first byte."""
    number = sum(bit << place for place, bit in enumerate(bits))
    return number.to_bytes((len(bits) + 7) // 8, "little")


def unpack_bits(data: bytes, count: int) -> tuple[int, ...]:
    """Unpack the first `count` bits of `data`."""
    number = int.from_bytes(data, "little")
    return tuple(number >> place & 1 for place in range(count))
