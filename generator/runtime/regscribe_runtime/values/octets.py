"""What bytes in words mean: the form of a text, and the layout of a date or a time."""

import re
from datetime import date, datetime
from functools import cache
from itertools import accumulate, groupby
from typing import NamedTuple

from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.wire_types import WireType

KINDS = {
    WireType.STRING: Kind.STRING,
    WireType.BYTES: Kind.BYTES,
    WireType.IPV4: Kind.IPV4,
    WireType.IPV6: Kind.IPV6,
    WireType.EUI48: Kind.MAC,
    WireType.EUI64: Kind.MAC,
    WireType.DATETIME: Kind.DATETIME,
    WireType.DATE: Kind.DATE,
    WireType.TIME: Kind.TIME,
}
"""What the bytes of each type are."""
LENGTHS = {WireType.IPV4: (2, 4), WireType.IPV6: (8, 16), WireType.EUI48: (3, 4, 6), WireType.EUI64: (4, 8)}
"""The words that an address may have: packed, behind padding, and one byte a word."""
BLANK, NUL, FF = 0x20, 0x00, 0xFF


class TextForm(NamedTuple):
    """How characters stand in words.

    `encoding` is one of Python's names (`utf-16` has its high byte first). With `per_register`, a word has one
    character, in its `low` or its `high` byte. `padding` fills what is left, and is dropped at the end, as blanks are;
    a text ends before the first character that consists of one of `ends`.
    """

    encoding: str = "ascii"
    per_register: str = ""
    padding: int = BLANK
    ends: tuple[int, ...] = (NUL,)

    @property
    def codec(self) -> str:
        """The name of the codec that neither reads nor writes a mark of the order of bytes."""
        return "utf-16-be" if self.encoding == "utf-16" else self.encoding

    @property
    def size(self) -> int:
        """How many bytes the smallest character has."""
        return len("\0".encode(self.codec))


PLAIN_TEXT = TextForm()

EPOCH = datetime(1970, 1, 1)  # noqa: DTZ001 (a device tells no time zone)
DIGITS = {"Y": 4}
"""How many decimal digits a part has that stands among digits; others have two."""
UNIX = re.compile(r"unix(64)?(?: (\d{4}-\d{2}-\d{2}))?")
SPANS = {"minutes": (1, 60), "seconds": (2, 1)}
"""Times since midnight: words, and the seconds of a unit."""
IEC870 = "iec870"
_TOKEN = re.compile(r"[YyMDhmsw_]+")


class Part(NamedTuple):
    """A part of a date: a letter, its bytes (`place`, `size`), and how they spell it.

    Of a number of decimal digits the part is that above the last `after`, of which the last `digits` count (0: all).
    In `bcd`, each four bits are a digit; in `ascii`, each byte is the character of one.
    """

    letter: str
    place: int
    size: int
    digits: int = 0
    after: int = 0
    bcd: bool = False
    ascii: bool = False


class Layout(NamedTuple):
    """A layout of words: their number, and its parts, or a count of seconds times `step` since `epoch`."""

    words: int
    parts: tuple[Part, ...] = ()
    step: int = 0
    epoch: datetime = EPOCH


@cache
def layout_of(text: str) -> Layout:
    """The layout that a text spells; ValueError says what is wrong with it."""
    unix = UNIX.fullmatch(text)
    if unix:
        epoch = datetime.combine(date.fromisoformat(unix[2]), EPOCH.time()) if unix[2] else EPOCH
        return Layout(4 if unix[1] else 2, step=1, epoch=epoch)
    if text in SPANS:
        return Layout(SPANS[text][0], step=SPANS[text][1])
    if text == IEC870:
        return Layout(4)
    words = text.split()
    bcd, characters = words[:1] == ["bcd"], words[:1] == ["ascii"]
    parts: list[Part] = []
    place = 0
    for token in words[bcd or characters :]:
        found = _characters(token, place) if characters else _parts(token, place, bcd=bcd)
        parts += found
        place = max(part.place + part.size for part in found)
    _check_once(parts)
    return Layout(place // 2, tuple(parts))


def _parts(token: str, place: int, *, bcd: bool) -> list[Part]:
    """The parts of a word (or two, of decimal digits)."""
    if not _TOKEN.fullmatch(token):
        message = f"`{token}` is no word of a date: a letter of Y y M D h m s w _, two, or digits as hhmm"
        raise ValueError(message)
    if len(token) == 1:
        return [Part(token, place, 2, bcd=bcd)]
    if len(token) == 2 and token[0] != token[1]:  # noqa: PLR2004 (a byte each)
        return [Part(letter, place + number, 1, bcd=bcd) for number, letter in enumerate(token)]
    runs = [(letter, len(list(run))) for letter, run in groupby(token)]
    if bcd or len(token) > 8 or any(size != DIGITS.get(letter, 2) for letter, size in runs):  # noqa: PLR2004 (32 bits)
        message = f"`{token}` is no word of a date: digits are YYYY, yy, MM, DD, hh, mm, ss, up to eight of them"
        raise ValueError(message)
    found: list[Part] = []
    size, left = 2 if len(token) <= 4 else 4, len(token)  # noqa: PLR2004 (a word has four whole digits)
    for letter, digits in runs:
        left -= digits
        found.append(Part(letter, place, size, digits if found else 0, left))
    return found


def _characters(token: str, place: int) -> list[Part]:
    """The parts of words of two characters each."""
    runs = [(letter, len(list(run))) for letter, run in groupby(token)]
    if not _TOKEN.fullmatch(token) or len(token) % 2 or any(size != DIGITS.get(letter, 2) for letter, size in runs):
        message = f"`{token}` are no words of a date in characters: they are YYYY, yy, MM, DD, hh, mm, ss, two a word"
        raise ValueError(message)
    starts = accumulate((size for _, size in runs), initial=place)
    return [Part(letter, start, size, ascii=True) for (letter, size), start in zip(runs, starts, strict=False)]


def _check_once(parts: list[Part]) -> None:
    letters = [part.letter.lower() if part.letter in "Yy" else part.letter for part in parts if part.letter != "_"]
    if len(set(letters)) < len(letters) or not letters:
        message = "each part of a date stands once, and one at least"
        raise ValueError(message)


NEEDED = {"datetime": ("y", "M", "D", "h"), "date": ("y", "M", "D"), "time": ("h",)}
WITHOUT = {"datetime": "", "date": "hms", "time": "yMD"}


def unfit(kind: str, text: str) -> str:
    """Why a layout tells no value of a kind, as `it ...`; empty where it does."""
    layout = layout_of(text)
    if not layout.parts:
        tells = "time" if text in SPANS else "datetime"
        return "" if kind == tells else f"it tells a {tells}"
    letters = {part.letter.replace("Y", "y") for part in layout.parts}
    lacking = [letter for letter in NEEDED[kind] if letter not in letters]
    more = sorted(letters.intersection(WITHOUT[kind]))
    if lacking:
        return f"it has no {', '.join(lacking)}"
    if "s" in letters and "m" not in letters:
        return "it has seconds without minutes"
    return f"it has {', '.join(more)} besides" if more else ""
