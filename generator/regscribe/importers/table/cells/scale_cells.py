"""One cell of a scale; a bare number needs to be told what numbers of its column do."""

import re
from collections.abc import Callable
from fractions import Fraction

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.factors import MOST_DECIMALS, PLAIN, Scale, Way
from regscribe.importers.table.cells.formulas import Line, equation, formula
from regscribe.importers.table.cells.numbers import NUMBER, clean, number

_NONE = frozenset({"none", "1:1", "no scaling", "no", "unscaled", "keine", "aucun", "ingen", "geen"})
_SAYS_NOTHING = frozenset({"", "-", "--", "n/a", "na", "n.a.", "/", "."})
_RAISED = str.maketrans("\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079\u207a\u207b", "0123456789+-")
_DIGIT_WORDS = r"(?:decimal places?|decimal digits?|decimals?|dec|dp|digits?|nachkommastellen?|d\u00e9cimales?)"

_FACTOR = re.compile(
    rf"(?:[x*\u00d7\u00b7]|factor|faktor|facteur|scale|scaling|times)\s*[:=]?\s*(?P<a>{NUMBER})|(?P<b>{NUMBER})\s*[x*\u00d7]",
    re.IGNORECASE,
)
_TIMES = re.compile(rf"(?:multiply by|multiplier|mult\.?|resolution)\s*[:=]?\s*(?P<n>{NUMBER})", re.IGNORECASE)
_OVER = re.compile(rf"(?:[/\u00f7:]|divided? by|divisor|div\.?|gain|teiler)\s*[:=]?\s*(?P<n>{NUMBER})", re.IGNORECASE)
_FRACTION = re.compile(r"(?P<a>[0-9]{1,18})\s*/\s*(?P<b>[0-9]{1,18})")
_POWER = re.compile(
    r"(?:[x*\u00d7]\s*)?10\s*(?:\^|\*\*)\s*\(?\s*(?P<a>[+-]?[0-9]{1,2})\s*\)?"
    r"|(?:[x*\u00d7]\s*)?10(?P<b>[\u207a\u207b]?[\u2070\u00b9\u00b2\u00b3\u2074-\u2079]{1,2})"
)
_DIGITS = re.compile(
    rf"{_DIGIT_WORDS}\s*[:=]?\s*(?P<a>[0-9]{{1,2}})|(?P<b>[0-9]{{1,2}})\s*{_DIGIT_WORDS}\.?|%\.(?P<c>[0-9]{{1,2}})f"
    r"|fix(?P<d>[0-9])",
    re.IGNORECASE,
)
_PATTERN = re.compile(r"[#Xx9]{1,10}[.,](?P<a>[#Xx9]{1,9})|#+[.,](?P<b>0{1,9})|[#0]*0[.,](?P<c>0{2,9})")
_WITH_UNIT = re.compile(rf"(?P<n>{NUMBER})\s*(?P<unit>(?:[^\W\d_]|[\u00b0%\u00b5\u2103\u2109])[^=;:,()]{{0,11}})")
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9]*(?:_[A-Za-z0-9]+)+|[A-Za-z]\w*sf", re.IGNORECASE)

Found = re.Match[str]
Reading = Scale | Unclear | None


def parse_scale(text: str, way: Way | None = None, *, comma: bool | None = None) -> Reading:
    """Read one cell; a bare number needs a `way`. `comma`: whether a comma is the decimal point (None: as it looks)."""
    plain = clean(text)
    if plain.casefold() in _SAYS_NOTHING:
        return None
    if plain.casefold() in _NONE:
        return PLAIN
    found = _self_contained(plain, comma=comma)
    if found is None:
        bare = _bare_number(plain, comma=comma)
        found = _bare(bare, way, text) if isinstance(bare, Fraction) else _unread(plain, text, bare)
    if isinstance(found, Scale) and not found.multiply:
        return Unclear(f"the scale {quoted(text)} is 0, which no number has")
    return found


def bare_number(text: str, *, comma: bool | None = None) -> Fraction | None:
    """The number of a cell that says no more than a number: the column decides what it does. None for other cells."""
    plain = clean(text)
    found = _bare_number(plain, comma=comma) if _self_contained(plain, comma=comma) is None else None
    return found if isinstance(found, Fraction) else None


def scale_register(text: str) -> str:
    """The name of the register that holds the exponent (`W_SF`); empty where a cell names none."""
    plain = clean(text)
    return plain if _NAME.fullmatch(plain) and plain.casefold().endswith("sf") else ""


def is_product(text: str) -> bool:
    """Whether a cell is `x10`, which may also mean that the device sends ten times the value."""
    return bare_number(text) is not None and _FACTOR.fullmatch(clean(text)) is not None


def _bare_number(plain: str, *, comma: bool | None) -> Fraction | Unclear:
    """Of `x10` the 10: either the value is ten times the number, or the device sends ten times the value."""
    found = _FACTOR.fullmatch(plain)
    return number((found["a"] or found["b"]) if found else plain, comma=comma)


def _self_contained(plain: str, *, comma: bool | None) -> Reading:
    """A cell that says itself what its number does; None: it does not."""
    for pattern, reading in _FORMS:
        if found := pattern.fullmatch(plain):
            return reading(found, comma)
    line = equation(plain, comma=comma) or formula(plain, comma=comma)
    return Scale(*line) if isinstance(line, Line) else line


def _first(found: Found) -> str:
    return "".join(group for group in found.groups() if group)


def _factor(found: Found, comma: bool | None) -> Reading:  # noqa: FBT001 - one signature for all forms
    """`x0.1` multiplies for sure."""
    factor = number(_first(found), comma=comma)
    return None if isinstance(factor, Unclear) or abs(factor) >= 1 else Scale(factor)


def _times(found: Found, comma: bool | None) -> Reading:  # noqa: FBT001 - as above
    factor = number(found["n"], comma=comma)
    return factor if isinstance(factor, Unclear) else Scale(factor)


def _over(found: Found, comma: bool | None) -> Reading:  # noqa: FBT001 - as above
    return _inverse(number(found["n"], comma=comma), found[0])


def _fraction(found: Found, comma: bool | None) -> Reading:  # noqa: FBT001 - as above
    del comma
    return Scale(Fraction(int(found["a"]), int(found["b"]))) if int(found["b"]) else Unclear(f"{found[0]} divides by 0")


def _power(found: Found, comma: bool | None) -> Reading:  # noqa: FBT001 - as above
    del comma
    return _ten_to(int(_first(found).translate(_RAISED)), found[0])


def _digits(found: Found, comma: bool | None) -> Reading:  # noqa: FBT001 - as above
    del comma
    return _ten_to(-int(_first(found)), found[0])


def _pattern(found: Found, comma: bool | None) -> Reading:  # noqa: FBT001 - as above
    del comma
    return _ten_to(-len(_first(found)), found[0])


_FORMS: tuple[tuple[re.Pattern[str], Callable[[Found, bool | None], Reading]], ...] = (
    (_POWER, _power),
    (_DIGITS, _digits),
    (_PATTERN, _pattern),
    (_FACTOR, _factor),
    (_TIMES, _times),
    (_OVER, _over),
    (_FRACTION, _fraction),
)
"""Forms of a cell, the first that fits counts."""


def _ten_to(exponent: int, text: str) -> Scale | Unclear:
    if abs(exponent) > MOST_DECIMALS:
        return Unclear(f"the scale {quoted(text)} is beyond ten to the power of {MOST_DECIMALS}")
    return Scale(Fraction(10) ** exponent)


def _inverse(found: Fraction | Unclear, text: str) -> Scale | Unclear:
    if isinstance(found, Unclear):
        return found
    return Scale(1 / found) if found else Unclear(f"{quoted(text)} divides by 0")


def _bare(found: Fraction, way: Way | None, text: str) -> Scale | Unclear:
    """A bare number, as the column says; 1 neither multiplies nor divides."""
    if way in {Way.DECIMALS, Way.EXPONENT}:
        if found.denominator != 1 or (way is Way.DECIMALS and found < 0):
            return Unclear(f"{quoted(text)} is no {'number of digits' if way is Way.DECIMALS else 'power of ten'}")
        return _ten_to(int(found) if way is Way.EXPONENT else -int(found), text)
    if found == 1:
        return PLAIN
    if way is None:
        return Unclear(f"it is not clear whether the scale {quoted(text)} multiplies or divides: say it for the column")
    return Scale(found) if way is Way.MULTIPLY else _inverse(found, text)


def _unread(plain: str, text: str, why: Unclear) -> Scale | Unclear:
    """A cell that is neither: a number with its unit, the name of a register, or something else."""
    if (found := _WITH_UNIT.fullmatch(plain)) and isinstance(factor := number(found["n"]), Fraction):
        if factor > 1:
            return Unclear(f"{quoted(text)} may be the step of the value or something else")
        return Scale(factor, unit=found["unit"].strip())
    if _NAME.fullmatch(plain):
        return Unclear(f"the register {quoted(text)} holds the scale, as a power of ten or a number", "`exponent`")
    return why if re.search(r"[0-9],[0-9]{3}", plain) else Unclear(f"{quoted(text)} is no scale")


def parse_offset(text: str, *, comma: bool | None = None) -> Fraction | Unclear | None:
    """Read a cell of what is added to the scaled number."""
    plain = clean(text)
    return None if plain.casefold() in _SAYS_NOTHING | _NONE else number(plain, comma=comma)
