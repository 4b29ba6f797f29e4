"""Sizes beside types: `2 words`, `4 bytes`, `32 bit`, or a bare number, of which the table shows what it counts."""

import re
from typing import NamedTuple

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.numbers import clean

MOST_BITS = 65535 * 16


class Size(NamedTuple):
    """How many bits."""

    bits: int

    @property
    def words(self) -> int:
        """The registers that have so many bits."""
        return (self.bits + 15) // 16


_SIZE = re.compile(r"(?P<n>[0-9]{1,6})[\s-]*(?P<unit>[a-z\u00e9]+)?\.?", re.IGNORECASE)
_UNITS = (
    (16, r"w|words?|reg|regs|registers?|registros?|registres?|mots?"),
    (8, r"bytes?|octets?|char\w*|zeichen"),
    (1, r"bits?"),
)


def parse_size(text: str, each: int | None) -> Size | Unclear | None:
    """Read a cell of sizes; `each` are the bits that a bare number counts (None: not known). None: it is empty."""
    plain = clean(text)
    if plain in {"", "-", "--"}:
        return None
    found = _SIZE.fullmatch(plain)
    if not found:
        return Unclear(f"{quoted(text)} is no size")
    unit = (found["unit"] or "").casefold()
    bits = next((bits for bits, words in _UNITS if unit and re.fullmatch(words, unit)), None if unit else each)
    if bits is None:
        return Unclear(f"the size {quoted(text)} does not say whether it counts registers, bytes or bits")
    total = bits * int(found["n"])
    return Size(total) if 0 < total <= MOST_BITS else Unclear(f"{quoted(text)} is no size of a register")
