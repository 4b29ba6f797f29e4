"""Scales that a description says beside other things: read if it says nothing else, else told as a doubt."""

import re

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.factors import Scale
from regscribe.importers.table.cells.numbers import NUMBER, clean
from regscribe.importers.table.cells.scale_cells import bare_number, parse_scale
from regscribe.importers.table.cells.units import UnitCell, may_scale, parse_unit

_WORDS = r"scale[ds]?|scaling|factor|gain|resolution|multipl\w+|divid\w+|divisor|faktor|skalier\w+|aufl\u00f6sung"
_TALK = re.compile(
    rf"\b(?:{_WORDS})\b[^.;]{{0,20}}?{NUMBER}"
    r"|(?<![\w.])1\s*(?:lsb|bit|digit|count)?\s*=\s*0?[.,][0-9]+"
    r"|(?<![\w.])[x*\u00d7]\s*(?:0[.,][0-9]+|10+)\b"
    r"|(?<![\w.])0[.,]0*1\s*(?:[^\W\d_]{1,3}|[\u00b0%][CF]?)?[ -]?(?:steps?|units?|per|/)\b"
    r"|(?<=[\s(])/\s*10+\b|\btenths?\b|\bhundredths?\b|\b(?:one|[1-9]) decimals?\b",
    re.IGNORECASE,
)
"""What people say of a scale in prose."""


_IN_BRACKETS = re.compile(r"[(\[\uff08]\s*([^()\[\]\uff08\uff09]{1,24})\s*[)\]\uff09]\s*$")


def scale_in_name(name: str) -> Scale | Unclear | None:
    """The scale in brackets behind a name (`Voltage (0.1 V)`); Unclear if a name speaks of one otherwise."""
    plain = clean(name)
    if (found := _IN_BRACKETS.search(plain)) and re.search(r"[0-9]", found[1]):
        unit = parse_unit(found[1])
        if isinstance(unit, UnitCell) and unit.known and unit.factor is not None:
            return Scale(unit.factor, unit=unit.symbol)
        if may_scale(found[1]) and _FACTOR.search(found[1]):
            return Unclear(f"the name {quoted(name)} may say a scale")
    return None


_FACTOR = re.compile(r"[x*\u00d7/]\s*1?0|0[.,][0-9]", re.IGNORECASE)


def scale_in(text: str) -> Scale | Unclear | None:
    """The scale that a description says, if it says nothing else (`1 = 0.1 A`); Unclear if it speaks of one."""
    plain = clean(text)
    if bare_number(plain) is None and isinstance(found := parse_scale(plain), Scale):
        return _only_a_scale(plain, found)
    if talk := _TALK.search(plain):
        return Unclear(f"the description says something of a scale, {quoted(talk[0])}")
    return None


_NUMBER_FIRST = re.compile(rf"{NUMBER}\s*[^\W\d_\u00b0%]")


def _only_a_scale(plain: str, found: Scale) -> Scale | Unclear | None:
    """A scale that is a whole description; a number with a word may be part of a sentence (`3 phase power`)."""
    if not found.unit or "=" in plain or not _NUMBER_FIRST.match(plain):
        return found
    unit = parse_unit(found.unit)
    is_unit, is_part = isinstance(unit, UnitCell) and unit.known, 0 < found.multiply < 1
    if is_unit and is_part:
        return found
    return Unclear(f"the description {quoted(plain)} may say a scale") if is_unit or is_part else None
