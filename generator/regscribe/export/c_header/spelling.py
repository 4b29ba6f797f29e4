"""How C spells numbers, texts, comments and names."""

import re
from fractions import Fraction

from regscribe.emit.words import one_line
from regscribe.export.device.numbers import decimal
from regscribe.model import WireType
from regscribe.visible import safe

LIMIT = 1 << 63
LAST_WORD = (1 << 16) - 1
LAST_DOUBLE_WORD = (1 << 32) - 1
LAST_INT = (1 << 31) - 1
"""The last number of an `int`, which the codes of an `enum` are, and of a constant that needs no suffix."""

TYPES = (
    *("bit", "uint8", "int8", "uint16", "int16", "uint24", "int24", "uint32", "int32", "uint48", "int48"),
    *("uint64", "int64", "float16", "float32", "float64", "bcd16", "bcd32", "bcd48", "bcd64"),
    *("mod10k_2", "mod10k_3", "mod10k_4", "signmag16", "signmag32"),
    *("string", "bytes", "ipv4", "ipv6", "eui48", "eui64", "datetime", "date", "time"),
)
"""The types that a header names; each has its place here as its number, which never changes."""

_PLAIN = re.compile(r"[ !#-\[\]-~]")
_LONGEST_DOUBLE = Fraction(10) ** 300


def remark(text: str) -> str:
    """A text for the inside of a comment: one line that neither ends it nor has a trigraph or a line continuation."""
    plain = safe(one_line(text)).replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?")
    return plain.replace("??", "? ?").rstrip("\\ ")


def literal(text: str) -> str:
    """A text as a string of C: UTF-8, all but plain ASCII as octal escapes of three digits."""
    escaped = (
        chr(byte) if _PLAIN.fullmatch(chr(byte)) and byte != ord("?") else f"\\{byte:03o}" for byte in text.encode()
    )
    return f'"{"".join(escaped)}"'


def signed(number: int) -> str:
    """A whole number as a constant of a signed type, in brackets where it is negative; above 64 bits none is needed."""
    if -LAST_INT <= number <= LAST_INT:
        return f"({number})" if number < 0 else str(number)
    if number == -LAST_INT - 1:
        return f"(-{LAST_INT} - 1)"
    if number == -LIMIT:
        return f"(-INT64_C({LIMIT - 1}) - 1)"
    if number >= LIMIT:
        return unsigned(number)
    return f"(-INT64_C({-number}))" if number < 0 else f"INT64_C({number})"


def unsigned(number: int, *, hexadecimal: bool = False) -> str:
    """A whole number from 0 on as a constant of an unsigned type."""
    text = f"0x{number:04X}" if hexadecimal else str(number)
    if number <= LAST_WORD:
        return f"{text}u"
    return f"UINT32_C({text})" if number <= LAST_DOUBLE_WORD else f"UINT64_C({text})"


def whole(number: int, kind: WireType) -> str:
    """A number on the wire as a constant, unsigned where the type is."""
    return signed(number) if number < 0 or not kind.is_integer or kind.minimum < 0 else unsigned(number)


def real(number: Fraction) -> str | None:
    """A number as a constant of type `double`, the nearest one; None where none is near."""
    if abs(number) > _LONGEST_DOUBLE:
        return None
    text = decimal(number)
    text = text if "." in text else f"{text}.0"
    return f"({text})" if number < 0 else text
