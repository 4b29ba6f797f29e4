"""Takes a cell of codes apart: where each code stands, and the text up to the next."""

import re
from dataclasses import dataclass

from regscribe.importers.table.cells.numbers import MINUS_SIGNS

MOST_TEXT = 20_000
"""Characters of a cell of codes; the longest lists of faults have some thousands."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Part:
    """One code (or bit) with its label; `low` to `high` where it gives several. `digits` is how it was written.

    `is_other`: it is the label of all other codes. `lead` is the text before it, of the first one.
    """

    low: int
    high: int
    label: str
    digits: str
    is_bit: bool = False
    is_other: bool = False
    lead: str = ""


_BIT = r"(?:bits?[ \t_#.]*|[bd][_.]?)"
_NUMBER = r"0x[0-9a-f]{1,16}|[0-9a-f]{1,8}h(?![a-z])|-?[0-9]{1,20}"
_TO = r"\s*(?:\.\.+|~|\u2026|-|\bto\b|\u2013)\s*"
_CODE = rf"(?P<bit>{_BIT})?(?P<low>{_NUMBER})(?:{_TO}(?:{_BIT})?(?P<high>{_NUMBER}))?"
_OTHER = r"(?P<other>others?|else|all others|any other|andere|sonst)"
_SEPARATORS = ("=", ":", "\u2192|->|=>", r"\)", r"\((?=[^()0-9][^()]*\))", r"-(?=\s*[^\s0-9-])|\u2013")
_EDGE = r"(?:^|(?<=[\s;,/|.(\[{\n\"']))"


def _pattern(separator: str) -> re.Pattern[str]:
    return re.compile(rf"{_EDGE}[(\[]?(?:{_CODE}|{_OTHER})[)\]\"']?\s*(?:{separator})", re.IGNORECASE)


_PATTERNS = tuple((separator, _pattern(separator)) for separator in _SEPARATORS)
_NEXT = re.compile(r"(?P<bit>(?!))?(?<=[^\W\d_])(?P<low>[0-9]{1,3})(?P<high>(?!))?(?P<other>(?!))?\s*[=:]")
"""A code glued to the label before it: `0 :Disable1: enable`."""

_TRAILING = " \t\r\n,;/|\u2022\u00b7"


def parts_of(text: str) -> tuple[Part, ...]:
    """The codes of a text with their labels; nothing if no code stands there.

    The first separator of the text counts for all: in `0=9600 baud: fast` a colon separates nothing.
    """
    plain = text.translate(MINUS_SIGNS)
    firsts = [(found.start(), at) for at, (_, pattern) in enumerate(_PATTERNS) if (found := pattern.search(plain))]
    if not firsts:
        return ()
    separator, pattern = _PATTERNS[min(firsts)[1]]
    places = list(pattern.finditer(plain))
    if separator in {"=", ":"}:
        places = sorted([*places, *_glued(plain, places)], key=lambda one: one.start())
    places = _plausible(places, separator, plain)
    if not places:
        return ()
    lead = plain[: places[0].start()].strip(f"{_TRAILING}:(")
    ends = [*(place.start() for place in places[1:]), len(plain)]
    return tuple(_part(place, plain[place.end() : end], lead) for place, end in zip(places, ends, strict=True))


def _glued(plain: str, places: list[re.Match[str]]) -> list[re.Match[str]]:
    """Codes glued to a label, if each is the one after the code before it."""
    known = {place.start("low"): int(place["low"]) for place in places if (place["low"] or "").isdecimal()}
    found: list[re.Match[str]] = []
    for place in _NEXT.finditer(plain):
        before = [number for start, number in known.items() if start < place.start()]
        if before and int(place["low"]) == before[-1] + 1 and place.start("low") not in known:
            found.append(place)
            known[place.start("low")] = int(place["low"])
            known = dict(sorted(known.items()))
    return found


def _plausible(places: list[re.Match[str]], separator: str, plain: str) -> list[re.Match[str]]:
    """Without what a hyphen or a bracket separates by chance: such codes follow each other from 0 or 1."""
    if separator in {"=", ":"} or separator.startswith("\u2192"):
        return [place for place in places if not _is_time(place, plain)]
    numbers = [int(place["low"]) for place in places if (place["low"] or "").isdecimal()]
    follow = len(numbers) > 1 and numbers[0] in {0, 1} and numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    return places if follow and len(numbers) == len(places) else []


def _is_time(place: re.Match[str], plain: str) -> bool:
    """Whether it is the hour of `12:30`."""
    return place[0].endswith(":") and bool(re.match(r"[0-9]{2}(?![0-9=:])", plain[place.end() :])) and not place["bit"]


def _part(place: re.Match[str], label: str, lead: str) -> Part:
    label = label.strip(_TRAILING)
    if place[0].endswith("("):
        label = label.removesuffix(")")
    label = " ".join(label.strip("\"'").split())
    if place["other"]:
        return Part(low=-1, high=-1, label=label, digits="", is_other=True, lead=lead)
    low = _number(place["low"])
    high = _number(place["high"]) if place["high"] else low
    low, high = sorted((low, high))
    return Part(low=low, high=high, label=label, digits=place["low"], is_bit=bool(place["bit"]), lead=lead)


def _number(text: str) -> int:
    folded = text.casefold()
    if folded.startswith("0x"):
        return int(folded, 16)
    return int(folded[:-1], 16) if folded.endswith("h") else int(folded)
