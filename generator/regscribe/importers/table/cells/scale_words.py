"""Scales that a description says beside other things: read if it says nothing else, else told as a doubt."""

import re

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.factors import Scale
from regscribe.importers.table.cells.numbers import NUMBER, clean
from regscribe.importers.table.cells.scale_cells import bare_number, parse_scale

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


def scale_in(text: str) -> Scale | Unclear | None:
    """The scale that a description says, if it says nothing else (`1 = 0.1 A`); Unclear if it speaks of one."""
    plain = clean(text)
    if bare_number(plain) is None and isinstance(found := parse_scale(plain), Scale):
        return found
    if talk := _TALK.search(plain):
        return Unclear(f"the description says something of a scale, {quoted(talk[0])}")
    return None
