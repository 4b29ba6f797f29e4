"""Formulas of a scale: `(x-100)*0.1`, `raw/10`, `0.1x + 5`, `1 = 0.1 A`, as a factor and what is added."""

import ast
import re
from fractions import Fraction
from typing import NamedTuple

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.numbers import NUMBER, clean, number

MOST_LENGTH = 80
"""Characters of a formula; a longer text is prose."""

_NAMES = "x|X|n|N|y|raw|Raw|RAW|val|value|Value|VALUE|reg|register|Register|data|DATA|stored|Wert|valeur|valor"
_SURE = re.compile(r"\b(?:raw|reg|register|data|stored)\b", re.IGNORECASE)
"""Names that stand for what the device sends; `value*10` may be what it sends for the value."""
_STORED = re.compile(rf"(?<![A-Za-z_])(?:{_NAMES})(?![A-Za-z_])")
_RESULT = re.compile(r"\s*(?:y|Y|value|Value|v|V|result|phys\w*|real\w*)\s*=(?!=)\s*")
_SIGNS = str.maketrans({"\u00d7": "*", "\u00b7": "*", "\u00f7": "/", "[": "(", "]": ")", "{": "(", "}": ")"})
_UNIT = r"(?:[^\W\d_]|[°%µΩ℃℉])[^=;]{0,15}?"
_EQUAL = re.compile(
    rf"(?P<stored>{NUMBER})\s*(?:lsb|bits?|digits?|counts?|raw|steps?|units?|inc\w*)?\s*(?:=|≙|->|→)\s*"
    rf"(?P<value>{NUMBER})\s*(?P<unit>{_UNIT})?",
    re.IGNORECASE,
)
_PER = re.compile(
    rf"(?P<value>{NUMBER})\s*(?P<unit>{_UNIT})?\s*(?:/|\bper\b)\s*(?:lsb|bit|digit|count|step|inc\w*|unit)\b",
    re.IGNORECASE,
)


class Line(NamedTuple):
    """slope times the stored number, plus what is added; the unit of the value if the formula names one."""

    slope: Fraction
    add: Fraction = Fraction(0)
    unit: str = ""


def equation(text: str, *, comma: bool | None = None) -> Line | Unclear | None:
    """Read `1 = 0.1 A` or `0.1 V/LSB`; None if the text is of another form."""
    plain = clean(text)
    found = _EQUAL.fullmatch(plain) or _PER.fullmatch(plain)
    if len(plain) > MOST_LENGTH or not found:
        return None
    parts = found.groupdict()
    stored = number(parts.get("stored") or "1", comma=comma)
    value = number(parts["value"], comma=comma)
    if isinstance(stored, Unclear):
        return stored
    if isinstance(value, Unclear):
        return value
    if not stored or not value:
        return None
    return Line(value / stored, unit=(parts["unit"] or "").strip())


def formula(text: str, *, comma: bool | None = None) -> Line | Unclear | None:
    """Read a formula of the stored number; None if the text is none, or not a straight line.

    Unclear: `value*10`, which may as well say that the device sends ten times the value.
    """
    found = _formula(text, comma=comma)
    is_sure = _SURE.search(text) or _RESULT.match(clean(text))
    if found and abs(found.slope) > 1 and not is_sure:
        return Unclear(f"{quoted(text)} may be the value, or what the device sends for it")
    return found


def _formula(text: str, *, comma: bool | None) -> Line | None:
    plain = _RESULT.sub("", clean(text), count=1).translate(_SIGNS)
    if len(plain) > MOST_LENGTH or not _STORED.search(plain):
        return None
    if comma or (comma is None and re.search(r"[0-9],[0-9]", plain)):
        plain = re.sub(r"(?<=[0-9]),(?=[0-9])", ".", plain)
    plain = re.sub(r"(?<=[0-9)])\s*(?=[A-Za-z(])(?![eE][+-]?[0-9])", "*", _STORED.sub("x", plain))
    plain = re.sub(r"(?<=x)\s*(?=\()", "*", plain)
    try:
        return _line(ast.parse(plain, mode="eval").body, plain)
    except (SyntaxError, ValueError, ZeroDivisionError, RecursionError, MemoryError):
        return None


def _line(node: ast.expr, text: str) -> Line:
    """The line of a part of a formula. Raises ValueError for what is none."""
    match node:
        case ast.Name(id="x"):
            return Line(Fraction(1))
        case ast.Constant():
            return Line(Fraction(0), _constant(node, text))
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return _times(_line(inner, text), Fraction(-1))
        case ast.UnaryOp(op=ast.UAdd(), operand=inner):
            return _line(inner, text)
        case ast.BinOp(left=left, op=operation, right=right):
            return _combined(_line(left, text), operation, _line(right, text))
    raise ValueError(ast.dump(node))


def _constant(node: ast.Constant, text: str) -> Fraction:
    found = number(ast.get_source_segment(text, node) or "", comma=False)
    if isinstance(found, Unclear):
        raise ValueError(found.reason)  # noqa: TRY004 - it is the number that is wrong
    return found


def _combined(left: Line, operation: ast.operator, right: Line) -> Line:
    if isinstance(operation, ast.Add):
        return Line(left.slope + right.slope, left.add + right.add)
    if isinstance(operation, ast.Sub):
        return Line(left.slope - right.slope, left.add - right.add)
    if isinstance(operation, ast.Mult) and not (left.slope and right.slope):
        return _times(right, left.add) if not left.slope else _times(left, right.add)
    if isinstance(operation, ast.Div) and not right.slope:
        return _times(left, 1 / right.add)
    raise ValueError(type(operation).__name__)


def _times(line: Line, factor: Fraction) -> Line:
    return Line(line.slope * factor, line.add * factor)
