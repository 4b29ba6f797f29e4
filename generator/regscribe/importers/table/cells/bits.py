"""Bits of a word, of a column of their own or behind addresses: from what they count is decided for the column."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.numbers import clean

MOST_BIT = 16
"""The number of the last bit of a word where they count from 1."""

Bits = tuple[int, int]
"""The lowest and the highest bit."""


@dataclass(frozen=True, slots=True)
class BitColumn:
    """The bits of all rows, counted from 0 (None: the cell is empty), with the evidence where others are printed."""

    evidence: str
    cells: tuple[Bits | Unclear | None, ...]


_BIT = r"(?:bits?|b)?[\s.]*"
_BITS = re.compile(rf"{_BIT}(?P<low>[0-9]{{1,2}})(?:\s*(?:-|\.\.+|~|:|to)\s*{_BIT}(?P<high>[0-9]{{1,2}}))?")


def parse_bits(texts: Sequence[str]) -> BitColumn:
    """Read a column of bits (`5`, `bit 5`, `0-3`). Where 16 occurs and 0 does not, they count from 1."""
    return from_0([_bits(text) for text in texts])


def _bits(text: str) -> Bits | Unclear | None:
    plain = clean(text).casefold()
    if plain in {"", "-", "--"}:
        return None
    found = _BITS.fullmatch(plain)
    if not found:
        return Unclear(f"bit {quoted(text)} is no number of a bit")
    low, high = sorted((int(found["low"]), int(found["high"] or found["low"])))
    return (low, high) if high <= MOST_BIT else Unclear(f"bit {quoted(text)} is none of 0 to {MOST_BIT - 1}")


def from_0(printed: Sequence[Bits | Unclear | None]) -> BitColumn:
    """Bits as they count from 0; bit 16 beside bit 0 is unclear."""
    known = [bits for bits in printed if isinstance(bits, tuple)]
    if not any(high == MOST_BIT for _, high in known):
        return BitColumn("", tuple(printed))
    if any(low == 0 for low, _ in known):
        wrong = Unclear(f"bit {MOST_BIT} stands beside bit 0, and a word has bits 0 to {MOST_BIT - 1}")
        return BitColumn("", tuple(wrong if isinstance(one, tuple) and one[1] == MOST_BIT else one for one in printed))
    moved = tuple((one[0] - 1, one[1] - 1) if isinstance(one, tuple) else one for one in printed)
    return BitColumn(f"bits count from 1, as bit {MOST_BIT} occurs and bit 0 does not", moved)
