"""Numbers as people write them: decimal commas, separators of thousands, typographic signs, hexadecimal, exponents.

All are exact. What a comma is may hang on the other cells of the column: `decimal_comma` looks at all of them.
"""

import re
from collections.abc import Iterable
from fractions import Fraction
from functools import lru_cache

from regscribe.importers.table.cells import Unclear, quoted

MOST_DIGITS = 40
"""Digits of a number; one beyond this is no number of a register."""

MOST_EXPONENT = 30

MOST_TEXT = 400
"""Characters of a cell that is not codes; patterns never see more."""

MINUS_SIGNS = str.maketrans({"\u2212": "-", "\u2013": "-", "\u2010": "-", "\u2011": "-", "\ufe63": "-", "\uff0d": "-"})
_PLAIN = MINUS_SIGNS | str.maketrans(dict.fromkeys("\u00a0\u2007\u2008\u2009\u202f", " "))
_SOFT = re.compile("[\u00ad\u200b\u2060\ufeff]")

HEX = r"(?:0[xX][0-9A-Fa-f]{1,16}|(?:[0-9][0-9A-Fa-f]{0,15}|[0-9A-F]{2,16})[hH]\b)"
DECIMAL = r"[0-9]+(?:[.,][0-9]+|['\u2019 ][0-9]{3}(?![0-9]))*(?:[eE][+-]?[0-9]{1,3})?"
NUMBER = rf"[+-]?\s?(?:{HEX}|{DECIMAL}|(?<![.,])[.,][0-9]+)"
"""A number inside a longer text; `number` says what it is."""

_WHOLE = re.compile(r"([+-]?)\s?(?:([0-9]+)|0[xX]([0-9A-Fa-f]{1,16})|([0-9][0-9A-Fa-f]{0,15}|[0-9A-F]{2,16})[hH])")
_EXPONENT = re.compile(r"(.*?)[eE]([+-]?[0-9]{1,3})")
_DIGITS = re.compile(r"[0-9.,'\u2019 ]+")
_GROUPED = re.compile(r"[1-9][0-9]{0,2}(?P<mark>[.,'\u2019 ])[0-9]{3}(?:(?P=mark)[0-9]{3})*")


def clean(text: str) -> str:
    """A cell without invisible characters, with plain blanks and minus signs, one blank between words.

    What is longer than a cell of any kind but codes is cut, and ends in a mark by which nothing takes it for whole.
    """
    plain = _cleaned(text[: 8 * MOST_TEXT])
    return plain if len(plain) <= MOST_TEXT and len(text) <= 8 * MOST_TEXT else f"{plain[:MOST_TEXT]}\u2026\u2026"


@lru_cache(1 << 12)
def _cleaned(text: str) -> str:
    """The same few texts stand in most cells of a column."""
    return " ".join(_SOFT.sub("", text).translate(_PLAIN).split())


def number(text: str, *, comma: bool | None = None) -> Fraction | Unclear:
    """Read one number. `comma`: whether the column has decimal commas; None: each number as it looks.

    `1,234` alone may be 1234 or 1.234, so it is unclear unless `comma` says which.
    """
    plain = clean(text)
    if whole := _WHOLE.fullmatch(plain):
        return _whole(whole, text)
    sign = -1 if plain.startswith("-") else 1
    body = plain.lstrip("+-").strip()
    if len(plain) - len(plain.lstrip("+-")) > 1:
        return Unclear(f"{quoted(text)} is no number")
    exponent = 0
    if power := _EXPONENT.fullmatch(body):
        body, exponent = power[1], int(power[2])
    digits = _plain_digits(body, comma=comma) if _DIGITS.fullmatch(body) else None
    if digits is None or abs(exponent) > MOST_EXPONENT or len(digits) > MOST_DIGITS:
        return Unclear(f"{quoted(text)} is no number")
    if not digits:
        bare = re.sub(r"\D", "", body)
        return Unclear(f"{quoted(text)} is {bare} or {body.replace(',', '.')}: its comma may be either")
    return sign * Fraction(digits) * Fraction(10) ** exponent


def _whole(found: re.Match[str], text: str) -> Fraction | Unclear:
    sign = -1 if found[1] == "-" else 1
    if found[2] and len(found[2]) > MOST_DIGITS:
        return Unclear(f"{quoted(text)} has {len(found[2])} digits, which is no number of a register")
    return Fraction(sign * (int(found[2]) if found[2] else int(found[3] or found[4], 16)))


def _plain_digits(body: str, *, comma: bool | None) -> str | None:
    """The digits with a decimal point alone; None if they are no number, empty if the comma may be either."""
    marks = set(re.findall(r"[^0-9]", body))
    spaces = marks & {" ", "'", "\u2019"}
    if len(spaces) > 1 or len(marks) > 2:  # noqa: PLR2004 - a separator of thousands and a point
        return None
    if spaces:
        return _ungrouped(body, spaces.pop(), next(iter(marks & {".", ","}), ""))
    if len(marks) == 2:  # noqa: PLR2004 - as above
        point = max(marks, key=body.rfind)
        return _ungrouped(body, (marks - {point}).pop(), point)
    return _one_mark(body, marks.pop(), comma=comma) if marks else body


def _one_mark(body: str, mark: str, *, comma: bool | None) -> str | None:
    """As above, where one kind of mark stands among the digits."""
    grouped = bool(_GROUPED.fullmatch(body))
    if body.count(mark) > 1:
        return body.replace(mark, "") if grouped else None
    is_point = (mark == ",") is comma if comma is not None else mark == "." or not grouped
    if is_point:
        return body.replace(mark, ".") if re.fullmatch(r"[0-9]*[.,][0-9]+|[0-9]+[.,]", body) else None
    if not grouped:
        return None
    return "" if comma is None else body.replace(mark, "")


def _ungrouped(body: str, separator: str, point: str) -> str | None:
    """The digits where a separator of thousands is known."""
    whole, _, rest = body.partition(point) if point else (body, "", "")
    if not _GROUPED.fullmatch(whole) or separator in rest or (rest and not rest.isdecimal()):
        return None
    return whole.replace(separator, "") + (f".{rest}" if rest else "")


def decimal_comma(texts: Iterable[str]) -> bool | None:
    """Whether a column writes decimal commas, by the cells that can be read in one way only; None: nothing shows it."""
    found = {_comma_of(token) for text in texts for token in re.findall(NUMBER, clean(text))} - {None}
    return found.pop() if len(found) == 1 else None


def _comma_of(token: str) -> bool | None:
    """Whether one number shows that a comma is (or is not) the decimal point."""
    body = re.sub(r"[eE][+-]?[0-9]+$", "", token).strip(" +-")
    marks = set(re.findall(r"[.,]", body))
    if len(marks) == 2:  # noqa: PLR2004 - the last of the two is the point
        return body.rfind(",") > body.rfind(".")
    if len(marks) != 1 or _GROUPED.fullmatch(body):
        return None
    return marks == {","}
