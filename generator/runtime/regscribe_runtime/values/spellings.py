"""How words spell whole numbers otherwise than as plain two's complement that fills them: bytes to numbers and back."""

from collections.abc import Callable
from typing import NamedTuple

_PART = 10_000


class Spelling(NamedTuple):
    """`read` turns the bytes, most significant first, into a number (ValueError where they are none), `spell` back.

    `words` are the registers that it takes, `bits` those that count as bits of the number (0: its bits are no pattern).
    """

    words: int
    bits: int
    minimum: int
    maximum: int
    read: Callable[[bytes], int]
    spell: Callable[[int], bytes]


def narrow(bits: int, *, signed: bool, extended: bool = True) -> Spelling:
    """Two's complement in the lowest `bits` of the words; those above are not read.

    They are written as copies of the sign, or as 0 where they are not the number's to fill (not `extended`).
    """
    words, used = -(-bits // 16), bits // 8
    low, high = (-(1 << bits - 1), (1 << bits - 1) - 1) if signed else (0, (1 << bits) - 1)

    def spell(number: int) -> bytes:
        return number.to_bytes(2 * words if extended else used, "big", signed=signed).rjust(2 * words, b"\0")

    return Spelling(
        words, bits, low, high, lambda raw: int.from_bytes(raw[2 * words - used :], "big", signed=signed), spell
    )


def bcd(words: int) -> Spelling:
    """A decimal digit in each four bits."""

    def read(raw: bytes) -> int:
        digits = raw.hex()
        if not digits.isdecimal():
            message = f"the digit {next(digit for digit in digits if not digit.isdecimal()).upper()} is no decimal one"
            raise ValueError(message)
        return int(digits)

    return Spelling(words, 0, 0, _PART**words - 1, read, lambda number: bytes.fromhex(f"{number:0{4 * words}d}"))


def modulo_10000(words: int) -> Spelling:
    """Four decimal digits a word, each word a number from 0 to 9999."""

    def read(raw: bytes) -> int:
        number = 0
        for start in range(0, 2 * words, 2):
            part = int.from_bytes(raw[start : start + 2], "big")
            if part >= _PART:
                message = f"{part} is more than four digits"
                raise ValueError(message)
            number = number * _PART + part
        return number

    def spell(number: int) -> bytes:
        parts = (number // _PART**place % _PART for place in reversed(range(words)))
        return b"".join(part.to_bytes(2, "big") for part in parts)

    return Spelling(words, 0, 0, _PART**words - 1, read, spell)


def sign_and_magnitude(words: int) -> Spelling:
    """The highest bit is the sign, the others the size: 0x8001 is -1, and 0x8000 is 0, too."""
    sign = 1 << 16 * words - 1

    def read(raw: bytes) -> int:
        bits = int.from_bytes(raw, "big")
        return sign - bits if bits & sign else bits

    def spell(number: int) -> bytes:
        return (sign - number if number < 0 else number).to_bytes(2 * words, "big")

    return Spelling(words, 0, 1 - sign, sign - 1, read, spell)
