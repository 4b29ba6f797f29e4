"""Whether two cells of a column say the same, however they are written; docs/evidence.md is the contract."""

import json
import re
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from operator import eq

from regscribe.emit.words import one_line

NUMBERS = frozenset({"address", "words", "default", "minimum", "maximum"})
OBJECTS = frozenset({"values", "bits", "views", "more"})
WORDS = frozenset({"space", "kind", "type"})
"""Columns of a fixed vocabulary: their case never matters."""

NUMBER = re.compile(r"([+-]?[0-9]{1,40}(?:\.[0-9]{1,40})?)(?:/([0-9]{1,40}))?")
DECIMAL_COMMA = re.compile(r"[+-]?[0-9]+,[0-9]+")
PAIR = re.compile(r"\s*([\w. -]+?)\s*[=:]\s*(.+?)\s*", re.DOTALL)
"""One entry of an object that is not JSON: `3 = off` or `3: off`; entries are separated by semicolons."""

VIEW = re.compile(r"(\w+):([0-9]{1,9})")
"""One view that is not JSON, name and address: `x10:1000`; views are separated by blanks."""

ACCESS = {
    **dict.fromkeys(("r", "ro", "read", "readonly"), "r"),
    **dict.fromkeys(("w", "wo", "write", "writeonly"), "w"),
    **dict.fromkeys(("rw", "readwrite", "readandwrite"), "rw"),
}

Fold = Callable[[str], str]
"""Maps texts that say the same to equal texts."""


def number(text: str) -> Fraction | None:
    """Return the exact number that a cell spells (`25`, `25.0`, `1/3`, typographic minus too); None for other text."""
    found = NUMBER.fullmatch(text.strip().replace("\N{MINUS SIGN}", "-"))
    if not found or (found[2] and not int(found[2])):
        return None
    return Fraction(found[1]) / int(found[2] or 1)


def problem(column: str, text: str) -> str:
    """Say why a cell cannot be read at all; empty if it can."""
    if column in NUMBERS and DECIMAL_COMMA.fullmatch(text.strip()):
        return f"`{text.strip()}` has a comma: write a decimal point, and no separator of thousands"
    if column in OBJECTS and text.strip() and objects(text) is None:
        return f"`{one_line(text)[:60]}` is neither a JSON object nor a list: `0 = off; 1 = on` or `base:0 x10:1000`"
    return ""


def differing(column: str, ours: str, theirs: str, *, loose: bool) -> tuple[str, str] | None:
    """Return what differs between two cells of a column, ours first; None if they say the same.

    Of objects only the entries that differ are returned. `loose` ignores case and punctuation of texts, and takes a
    section for the same as the one that it is part of (4.14 and 4.14.2).
    """
    fold = _bare if loose else one_line
    if column in OBJECTS:
        left, right = ({_code(key): value for key, value in (objects(text) or {}).items()} for text in (ours, theirs))
        wrong = [key for key in {**left, **right} if not _entry(left.get(key), right.get(key), fold)]
        return (_shown(left, wrong), _shown(right, wrong)) if wrong else None
    return None if _same(column, ours, theirs, fold) else (one_line(ours), one_line(theirs))


def _same(column: str, ours: str, theirs: str, fold: Fold) -> bool:
    numbers = number(ours), number(theirs)
    if column in NUMBERS and None not in numbers:
        return numbers[0] == numbers[1]
    if column == "section" and fold is _bare:
        left, right = (re.findall(r"\w+", text.casefold()) for text in (ours, theirs))
        return bool(left) == bool(right) and all(map(eq, left, right))  # one is the other, or a section above it
    folding = FOLDS.get(column, fold)
    return folding(ours) == folding(theirs)


def _bare(text: str) -> str:
    """Return letters and digits alone; the text itself where it has none (a unit like %)."""
    return re.sub(r"[\W_]+", "", text.casefold()) or one_line(text)


def access(text: str) -> str:
    """Return `r`, `w` or `rw` however it is written; other text as it is."""
    return ACCESS.get(re.sub(r"[\s/_-]+", "", text.casefold()), text)


FOLDS: Mapping[str, Callable[[str], object]] = {
    "aliases": lambda text: sorted(re.split(r"[\s,;]+", text.strip())),
    "access": access,
    **dict.fromkeys(WORDS, lambda text: text.strip().casefold()),
}
"""Columns whose cells are not compared as texts."""


def objects(text: str) -> dict[str, object] | None:
    """Read a cell that holds an object; None if it does not."""
    if text.lstrip().startswith("{"):
        try:
            found = json.loads(text)
        except (ValueError, RecursionError):
            return None
        return found if isinstance(found, dict) else None
    if views := _matches(VIEW, text.split()):
        return {found[1]: int(found[2]) for found in views}
    if pairs := _matches(PAIR, filter(str.strip, re.split(r"[;\n]", text))):
        return {found[1]: found[2] for found in pairs}
    return None if text.strip() else {}


def _matches(pattern: re.Pattern[str], parts: Iterable[str]) -> list[re.Match[str]]:
    """The matches of all parts; none if one of them does not match."""
    found = [pattern.fullmatch(part) for part in parts]
    return [] if None in found else [match for match in found if match]


def _code(key: str) -> str:
    """Return a code written in one way: 3 for `03` and 3.0, `8..11` for 8-11."""
    bits = re.fullmatch(r"\s*(\d+)\s*(?:\.\.+|-|to)\s*(\d+)\s*", key)
    code = number(key)
    return f"{bits[1]}..{bits[2]}" if bits else key.strip() if code is None else str(code)


def _entry(ours: object, theirs: object, fold: Fold) -> bool:
    """Whether two entries of objects agree; views do in what both sides say, their address at least."""
    if isinstance(ours, dict):
        if isinstance(theirs, dict):
            return bool(theirs) and all(ours.get(key) == value for key, value in theirs.items())
        return type(theirs) is int and ours.get("address") == theirs
    if isinstance(ours, str) and type(theirs) in {int, float}:
        theirs = str(theirs)
    return fold(ours) == fold(theirs) if isinstance(ours, str) and isinstance(theirs, str) else ours == theirs


def _shown(found: Mapping[str, object], keys: list[str]) -> str:
    return json.dumps({key: found[key] for key in keys if key in found}, ensure_ascii=False)
