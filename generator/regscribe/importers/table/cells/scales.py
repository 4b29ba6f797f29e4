"""A column of scales: whether its bare numbers multiply or divide is decided once, on evidence."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.factors import PLAIN, Scale, Way
from regscribe.importers.table.cells.numbers import decimal_comma
from regscribe.importers.table.cells.scale_cells import (
    bare_number,
    is_product,
    parse_offset,
    parse_scale,
    scale_register,
)
from regscribe.model import WireType, show

__all__ = [
    "PLAIN",
    "Hint",
    "Scale",
    "ScaleColumn",
    "Way",
    "parse_offset",
    "parse_scale",
    "parse_scales",
]

MOST_PLACES = 9
"""Digits behind a point that a column may count."""

MOST_LISTED = 4
"""Numbers that a sentence of evidence lists."""

_HEADINGS = (
    (
        Way.DECIMALS,
        r"decimals?\b|decimal places|\bdp\b|\bdigits\b|nachkomma|dezimalstellen|d\u00e9cimales|decimalen|decimali",
    ),
    (Way.EXPONENT, r"\bexponents?\b|power of (?:10|ten)|\b10\s?\^|zehnerpotenz"),
    (Way.DIVIDE, r"divis|divid|\bdiv\b|teiler|diviseur"),
    (Way.MULTIPLY, r"multipl|resolution|aufl\u00f6sung|r\u00e9solution|risoluzione|\blsb\b|increment|step"),
)
"""Words of a heading that say what the numbers below do; the first counts (`division factor` divides)."""

_WEAK = re.compile(r"\bgain\b", re.IGNORECASE)
"""A word by which most divide, but not all."""


class Hint(NamedTuple):
    """What else a row says: numbers of its range, and its type, by which one reading of the scale may be impossible."""

    numbers: tuple[Fraction, ...]
    wire: WireType


@dataclass(frozen=True, slots=True)
class ScaleColumn:
    """The scales of all rows (None: the cell is empty), what bare numbers do, and the evidence in a sentence.

    `way` is None where the table does not show it: bare numbers other than 1 are then unclear.
    """

    way: Way | None
    evidence: str
    cells: tuple[Scale | Unclear | None, ...]


def parse_scales(
    texts: Sequence[str], header: str = "", *, way: str = "", hints: Sequence[Hint | None] = ()
) -> ScaleColumn:
    """Read a column of scales, under its heading.

    `way` is what the user says of bare numbers: `multiply`, `divide`, `decimals` or `exponent`. `hints` are what else
    the rows say.
    """
    comma = decimal_comma(texts)
    bare = [bare_number(text, comma=comma) for text in texts]
    chosen: Way | None
    if way in set(Way):
        chosen, evidence = Way(way), f"as the user says, bare numbers mean {way}"
    else:
        chosen, evidence = _decide(texts, bare, header, hints)
    if chosen is None and _may_be_digits([one for one in bare if one is not None]):
        cells = tuple(_unclear_digits(text, one, comma=comma) for text, one in zip(texts, bare, strict=True))
        return ScaleColumn(None, f"{evidence}, or are numbers of digits", cells)
    return ScaleColumn(chosen, evidence, tuple(parse_scale(text, chosen, comma=comma) for text in texts))


def _may_be_digits(bare: Sequence[Fraction]) -> bool:
    """Whether the numbers may be digits behind the point, so that even 1 says nothing for sure."""
    return any(one != 1 for one in bare) and all(one.denominator == 1 and abs(one) <= MOST_PLACES for one in bare)


def _unclear_digits(text: str, bare: Fraction | None, *, comma: bool | None) -> Scale | Unclear | None:
    if bare is None:
        return parse_scale(text, comma=comma)
    return Unclear(f"it is not clear whether the scale {quoted(text)} is a factor, a divisor or a number of digits")


def _may_be_exponents(bare: Sequence[Fraction | None]) -> bool:
    return all(one is None or (one.denominator == 1 and abs(one) <= MOST_PLACES) for one in bare)


def _decide(
    texts: Sequence[str], bare: Sequence[Fraction | None], header: str, hints: Sequence[Hint | None]
) -> tuple[Way | None, str]:
    if said := next((way for way, words in _HEADINGS if re.search(words, header, re.IGNORECASE)), None):
        return said, f"the heading `{header.strip()}` says that the numbers mean {said}"
    if (named := next(filter(None, map(scale_register, texts)), "")) and _may_be_exponents(bare):
        return Way.EXPONENT, f"registers such as `{named}` hold powers of ten, so bare numbers are such, too"
    telling = sorted({one for one in bare if one is not None and one not in {0, 1}})
    if not telling:
        return None, "no scale but 1 stands as a bare number"
    if proven := _proven(list(zip(bare, hints, strict=False))):
        return proven
    if any(map(is_product, texts)):
        return None, f"{_listed(telling)} stand as products, by which the value or what the device sends may be meant"
    return _by_size(telling, weak=bool(_WEAK.search(header)))


def _by_size(telling: Sequence[Fraction], *, weak: bool) -> tuple[Way | None, str]:
    shown = _listed(telling)
    if all(0 < abs(number) < 1 for number in telling):
        return Way.MULTIPLY, f"only {shown} occur beside 1, so they multiply"
    if all(abs(number) >= 10 and _is_power(abs(number)) for number in telling):  # noqa: PLR2004 - of ten
        return Way.DIVIDE, f"only {shown} occur beside 1, so they divide"
    if weak and all(number > 1 for number in telling):
        return Way.DIVIDE, f"the heading calls {shown} a gain, by which the device multiplies, so they divide"
    return None, f"{shown} occur, which does not show whether they multiply or divide"


def _is_power(number: Fraction) -> bool:
    return number.denominator == 1 and set(str(number.numerator)[1:]) <= {"0"} and str(number.numerator)[0] == "1"


def _listed(numbers: Sequence[Fraction]) -> str:
    shown = ", ".join(map(show, numbers[:MOST_LISTED]))
    return f"{shown} and {len(numbers) - MOST_LISTED} more" if len(numbers) > MOST_LISTED else shown


def _proven(hinted: Sequence[tuple[Fraction | None, Hint | None]]) -> tuple[Way | None, str] | None:
    """The only way in which the ranges fit the types; none, if rows contradict each other."""
    votes = [one for number, hint in hinted if number and hint and (one := _possible(number, hint))]
    ways = set(votes)
    if len(ways) > 1:
        return None, "some ranges fit their types only if the numbers multiply, and others only if they divide"
    if not ways:
        return None
    way = ways.pop()
    rows = "the range of 1 row fits its type" if len(votes) == 1 else f"the ranges of {len(votes)} rows fit their types"
    return way, f"{rows} only if the numbers mean {way}"


def _possible(number: Fraction, hint: Hint) -> Way | None:
    """The one of the two ways by which the range, counted in values, fits the type; None: both or none."""
    if number == 1 or not hint.numbers or hint.wire.is_float or all(one.denominator == 1 for one in hint.numbers):
        return None  # whole numbers may count what is stored
    low, high = hint.wire.ends
    fits = {
        way
        for way, factor in ((Way.DIVIDE, number), (Way.MULTIPLY, 1 / number))
        if all((one * factor).denominator == 1 and low <= one * factor <= high for one in hint.numbers)
    }
    return fits.pop() if len(fits) == 1 else None
