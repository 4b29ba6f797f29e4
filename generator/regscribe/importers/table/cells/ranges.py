"""Ranges of single cells: `0..100`, `-50~150`, `[0,100]`, `0/1`, `≥0`, or a minimum and a maximum."""

import re
from collections.abc import Sequence
from fractions import Fraction

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.limits import Limits
from regscribe.importers.table.cells.numbers import NUMBER, clean, decimal_comma, number
from regscribe.importers.table.cells.range_columns import RangeColumn, Ranged, Settled, settle_range, settle_ranges
from regscribe.model import show

__all__ = [
    "Limits",
    "RangeColumn",
    "Ranged",
    "Settled",
    "decimal_comma",
    "parse_limits",
    "parse_number",
    "parse_range",
    "settle_range",
    "settle_ranges",
    "stated_limits",
]


_SAYS_NOTHING = frozenset({"", "-", "--", "n/a", "na", "n.a.", "none", "*", "?", "."})
_UNIT = r"(?!(?:to|bis|tot|till|and|a|à)\b\s*[+-]?\s?[0-9])(?:[^\W\d_]|[°%µΩ℃℉‰])[^\s0-9;,]{0,11}(?: [CFc]\b)?"
_BETWEEN = r"\.{2,3}|\u2026|~|\bto\b|\bbis\b|\btot\b|\btill\b|\b\u00e0\b|\ba\b|\b\u2013\b|<->|-|;|\band\b"
_TWO = re.compile(
    rf"(?:from |between |von |de )?(?P<low>{NUMBER})\s*(?:{_UNIT})?\s*(?:{_BETWEEN})\s*"
    rf"(?P<high>{NUMBER})\s*(?:{_UNIT})?",
    re.IGNORECASE,
)
_BRACKETS = re.compile(rf"[\[(]\s*(?P<low>{NUMBER})\s*(?:\.{{2,3}}|[,;:~-])\s*(?P<high>{NUMBER})\s*[\])]")
_BRACKETS_COMMA = re.compile(
    r"[\[(]\s*(?P<low>[+-]?[0-9]+(?:\.[0-9]+)?)\s*,\s*(?P<high>[+-]?[0-9]+(?:\.[0-9]+)?)\s*[\])]"
)
_AT_LEAST = re.compile(rf"(?:>=|=>|≥|min\.?:?|from|ab)\s*(?P<n>{NUMBER})\s*(?:{_UNIT})?", re.IGNORECASE)
_AT_MOST = re.compile(rf"(?:<=|=<|≤|max\.?:?|up to|bis)\s*(?P<n>{NUMBER})\s*(?:{_UNIT})?", re.IGNORECASE)
_EITHER_WAY = re.compile(rf"(?:±|\+/-|\+-)\s*(?P<n>{NUMBER})\s*(?:{_UNIT})?")
_LISTED = re.compile(r"[+-]?[0-9]+(?:\s*(?:/|\||,|;|\bor\b)\s*[+-]?[0-9]+)+")


def parse_range(text: str, *, comma: bool | None = None) -> Limits | Unclear | None:
    """Read the range of one cell, no matter in what it counts. A unit behind a number is passed over.

    `comma`: whether commas are decimal points (None: as each looks). A lower limit above the upper one is unclear.
    """
    plain = clean(text)
    if plain.casefold() in _SAYS_NOTHING:
        return None
    if found := _LISTED.fullmatch(plain):
        return _listed(found[0], text, comma=comma)
    if found := _EITHER_WAY.fullmatch(plain):
        return _both(f"-{found['n']}", found["n"], text, comma=comma)
    for pattern in (_BRACKETS_COMMA, _BRACKETS, _TWO):
        if found := pattern.fullmatch(plain):
            return _both(found["low"], found["high"], text, comma=comma)
    for pattern, is_low in ((_AT_LEAST, True), (_AT_MOST, False)):
        if found := pattern.fullmatch(plain):
            return _both(found["n"] if is_low else "", "" if is_low else found["n"], text, comma=comma)
    return _not_one(plain, text)


def _not_one(plain: str, text: str) -> Unclear:
    several = len(re.findall(r"\.\.|~|\bto\b", plain)) > 1
    if several:
        return Unclear(f"{quoted(text)} is several ranges", "a list of them")
    if re.fullmatch(rf"[<>]\s*{NUMBER}.*", plain):
        return Unclear(f"{quoted(text)} does not say whether the limit itself is allowed")
    return Unclear(f"{quoted(text)} is no range of numbers")


def _listed(plain: str, text: str, *, comma: bool | None) -> Limits | Unclear:
    """Single numbers; `0,1` may also be a tenth."""
    if re.fullmatch(r"[+-]?[0-9]+,[0-9]+", plain) and comma is not False:
        return Unclear(f"{quoted(text)} is one number with a decimal comma, or two numbers")
    numbers = tuple(Fraction(int(one)) for one in re.findall(r"[+-]?[0-9]{1,20}", plain))
    if max(numbers) - min(numbers) != len(set(numbers)) - 1:
        return Unclear(f"{quoted(text)} lists single numbers with gaps, or is a range")
    return Limits(min(numbers), max(numbers), numbers)


def _both(low: str, high: str, text: str, *, comma: bool | None) -> Limits | Unclear:
    first = number(low, comma=comma) if low else None
    last = number(high, comma=comma) if high else None
    if isinstance(first, Unclear):
        return first
    if isinstance(last, Unclear):
        return last
    if first is not None and last is not None and first > last:
        return Unclear(f"the range {quoted(text)} ends at {show(last)}, below {show(first)} where it begins")
    pairs = ((low, first), (high, last))
    return Limits(first, last, has_point=any(number is not None and _has_point(part, number) for part, number in pairs))


def _has_point(text: str, value: Fraction) -> bool:
    """Whether digits stand behind the point: `50.0` does not have those of 50 alone."""
    digits = re.sub(r"[^0-9]", "", text)
    return bool(re.search(r"[.,][0-9]+$", text)) and Fraction(int(digits)) != abs(value)


def parse_number(text: str, *, comma: bool | None = None) -> Fraction | Unclear | None:
    """Read one number, of a default for example; None if the cell is empty."""
    return None if clean(text).casefold() in _SAYS_NOTHING else number(text, comma=comma)


def parse_limits(low: str, high: str, *, comma: bool | None = None) -> Limits | Unclear | None:
    """Read two cells, of the minimum and of the maximum; an empty one is open."""
    lower, upper = ("" if clean(cell).casefold() in _SAYS_NOTHING else clean(cell) for cell in (low, high))
    return _both(lower, upper, f"{lower}..{upper}", comma=comma) if lower or upper else None


SHARE = 5
"""One of so many rows has equal limits: then they are not stated in any of them."""


def stated_limits(pairs: Sequence[tuple[str, str]]) -> tuple[bool, str]:
    """Whether equal limits (min = max = 0) mean that no range is stated, by how many rows have them, with the evidence.

    `pairs` are the cells of minimum and maximum.
    """
    equal = sum(bool(low.strip()) and clean(low) == clean(high) for low, high in pairs)
    given = sum(bool(low.strip() or high.strip()) for low, high in pairs)
    if equal * SHARE < max(given, SHARE):
        return True, ""
    return False, f"minimum and maximum are equal in {equal} of {given} rows, which then state no range"
