"""Words that mean different things to different people, and how a table shows what they mean in it."""

import re
from dataclasses import dataclass, replace
from typing import Any

from regscribe.importers.table.cells import Unclear, quoted

WIDTHS = {
    "uint": ("uint_bits", (16, 32), 16),
    "int": ("int_bits", (16, 32), 16),
    "long": ("long_bits", (32, 64), 32),
    "byte": ("byte_bits", (8, 16), 8),
    "word": ("word_bits", (16, 32), 16),
    "float": ("float_bits", (32, 64), 32),
}
"""The words, the fields of a dialect that say their width, the widths that occur, and the usual one."""

SIZES = {"registers": 16, "bytes": 8, "bits": 1}
TEXTS = {"characters": True, "registers": False}


@dataclass(frozen=True, slots=True)
class Dialect:
    """What the words of types mean in a table.

    The fields of widths are bits, of the words in `WIDTHS`. `characters`: whether the number of a text (`string[6]`)
    counts characters and no registers. `size_bits` are those of one unit of a bare number in the column of sizes.
    `little_bytes`: whether `little endian` swaps the bytes of a word as well. None: not known, such a cell is unclear.
    """

    uint_bits: int = 16
    int_bits: int = 16
    long_bits: int = 32
    byte_bits: int = 8
    word_bits: int = 16
    float_bits: int = 32
    characters: bool | None = None
    size_bits: int | None = None
    little_bytes: bool | None = None


def read_dialect(text: str) -> Dialect | Unclear:
    """What the user says: `int=32, text=registers, size=bytes, little=words`, those that differ from the usual."""
    found = Dialect()
    for part in filter(None, re.split(r"[\s,;]+", text)):
        word, _, value = part.partition("=")
        fields = _field(word.casefold(), value.casefold())
        if fields is None:
            return Unclear(
                f"{quoted(part)} says nothing of a dialect: known are {', '.join(f'{name}=BITS' for name in WIDTHS)}, "
                "text=characters|registers, size=registers|bytes|bits and little=words|all"
            )
        found = replace(found, **fields)
    return found


def _field(word: str, value: str) -> dict[str, Any] | None:
    if word in WIDTHS and value.isdecimal() and int(value) in WIDTHS[word][1]:
        return {WIDTHS[word][0]: int(value)}
    if word == "text" and value in TEXTS:
        return {"characters": TEXTS[value]}
    if word == "size" and value in SIZES:
        return {"size_bits": SIZES[value]}
    return {"little_bytes": value == "all"} if word == "little" and value in {"words", "all"} else None
