"""Width of text in a font that is not known beforehand: measured in a wide one, so that narrower ones fit."""

import re
import unicodedata
from functools import cache
from itertools import accumulate, takewhile

from regscribe.emit.words import one_line

WIDTHS = (
    32, 41, 46, 84, 64, 96, 78, 28, 40, 40, 50, 84, 32, 37, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 34, 34, 84,
    84, 84, 54, 100, 69, 69, 70, 78, 64, 58, 78, 76, 30, 30, 66, 56, 87, 75, 79, 64, 79, 70, 67, 62, 74, 69, 99, 69, 67,
    69, 40, 34, 40, 84, 56, 50, 62, 64, 55, 64, 62, 36, 64, 64, 28, 28, 58, 28, 98, 64, 62, 64, 64, 42, 53, 40, 64, 60,
    82, 60, 60, 53, 64, 34, 64, 84,
)  # fmt: skip
"""Hundredths of the font size for each character from blank to tilde (DejaVu Sans, or Liberation Sans if wider)."""

OTHER = 86
"""Hundredths of the font size for letters beyond ASCII."""

WIDE = 110
"""Hundredths of the font size for ideographs, Cyrillic capitals, symbols and emoji."""

BOLD = 1.2
"""Bold text is at most this much wider (letter by letter up to 1.26, but never all of them)."""

ASCENT = 0.8
DESCENT = 0.24
"""Height of letters above and below their base line, in font sizes."""

ELLIPSIS = "…"

INVALID = re.compile(
    r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff\ud800-\udfff\ufffe\uffff]"
)
"""Characters that XML forbids, that are invisible, or that turn the direction of their neighbours."""


def clean(text: str) -> str:
    """Return text on one line in which every character shows."""
    return INVALID.sub(lambda found: f"U+{ord(found[0]):04X}", one_line(text))


def width(text: str, size: float, *, bold: bool = False) -> float:
    """Return the most that a line of text takes, in the unit of `size`."""
    return sum(map(_units, text)) * size / 100 * (BOLD if bold else 1)


@cache
def _units(char: str) -> int:
    """Return the width of a character in hundredths of the font size."""
    if " " <= char <= "~":
        return WIDTHS[ord(char) - ord(" ")]
    wide = unicodedata.east_asian_width(char) in {"W", "F"} or not char.isalpha() or char.isupper()
    return WIDE if wide else OTHER


def shorten(text: str, room: float, size: float, *, bold: bool = False) -> str:
    """Return the text, cut with an ellipsis if it is wider than `room`; nothing if not even that fits."""
    if width(text, size, bold=bold) <= room:
        return text
    spare = room - width(ELLIPSIS, size, bold=bold)
    ends = accumulate(width(char, size, bold=bold) for char in text)
    kept = text[: sum(1 for _ in takewhile(lambda end: end <= spare, ends))].rstrip()
    return kept + ELLIPSIS if kept else ""


def wrap(text: str, room: float, size: float, *, lines: int, bold: bool = False) -> tuple[str, ...]:
    """Return at most `lines` lines no wider than `room`, broken at blanks; the rest is cut with an ellipsis."""
    found: list[str] = []
    words = text.split(" ")
    while words and len(found) < lines - 1:
        count = 1
        while count < len(words) and width(" ".join(words[: count + 1]), size, bold=bold) <= room:
            count += 1
        found.append(shorten(" ".join(words[:count]), room, size, bold=bold))
        words = words[count:]
    rest = [shorten(" ".join(words), room, size, bold=bold)] if words else []
    return tuple(line for line in [*found, *rest] if line)
