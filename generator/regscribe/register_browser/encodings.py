"""Letters of encodings that JavaScript does not have, or has otherwise than Python: a table for each that maps use."""

from collections import Counter
from collections.abc import Iterable
from typing import Any

from regscribe.model import Kind, RegisterMap

Json = Any
KNOWN = frozenset({"ascii", "latin-1", "utf-8", "utf-16"})
"""Encodings that the page has without a table."""
BYTES = range(256)
NONE = "\ufffd"
"""Stands for bytes that spell nothing."""


def encodings(maps: Iterable[RegisterMap]) -> Json:
    """Return the table of each encoding that a text of `maps` has, by its name."""
    registers = (register for one in maps for model in one.models for register in model.registers)
    names = {register.text.encoding for register in registers if register.kind is Kind.STRING}
    return {name: table(name) for name in sorted(names - KNOWN)}


def table(name: str) -> Json:
    """Return letters by their bytes: `one`, 256 letters; `two`, 256 letters by a first byte in hexadecimal.

    `spelled` are letters that several bytes spell, each with those in hexadecimal that are sent.
    """
    one = [_letter(bytes([byte]), name) for byte in BYTES]
    two = {
        f"{first:02x}": "".join(_letter(bytes([first, second]), name) for second in BYTES)
        for first in BYTES
        if one[first] == NONE
    }
    letters = [*one, *(letter for row in two.values() for letter in row)]
    several = {letter for letter, count in Counter(letters).items() if count > 1 and letter != NONE}
    return {
        "one": "".join(one),
        "two": {first: row for first, row in two.items() if row.strip(NONE)},
        "spelled": [[letter, letter.encode(name).hex()] for letter in sorted(several)],
    }


def _letter(raw: bytes, name: str) -> str:
    try:
        letter = raw.decode(name)
    except UnicodeDecodeError:
        return NONE
    return letter if len(letter) == 1 else NONE
