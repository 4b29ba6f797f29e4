"""What a remark or a range says against the type of its row: then the type is not sure, and the number hangs on it."""

import re
from fractions import Fraction

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.factors import Scale
from regscribe.importers.table.cells.limits import Limits
from regscribe.importers.table.cells.numbers import clean
from regscribe.model import WireType, show

_SIGNED = re.compile(r"(?<!un)(?<!non-)\bsigned\b|\btwo'?s complement\b|\bvorzeichenbehaftet\b|\bsigné", re.IGNORECASE)
_OTHER_FORM = re.compile(r"\bBCD\b|\bIEEE[- ]?754\b|\bfloat(?:ing point)?\b|\b(?:two|2) ascii\b", re.IGNORECASE)

_BELOW = re.compile(
    r"(?<![\w.)\]-])[-\u2212]\s?([0-9]+)\s*(?:°\s?[CF]|℃|℉|%)?\s*(?:[~\uff5e]|\.\.+|…|\bto\b|\bbis\b)\s*[-+]?[0-9]"
)
"""A range of whole numbers that begins below 0, inside a text."""


def against_type(text: str, wire: WireType) -> Unclear | None:
    """What a description says of the number that its type does not (`signed` beside WORD, `BCD` beside UINT)."""
    plain = clean(text)
    if not wire.is_integer or wire.bits == 1 or wire.spelling:
        return None
    found = _OTHER_FORM.search(plain) or (_SIGNED.search(plain) if wire.minimum == 0 else None)
    return Unclear(f"the type is {wire}, and the description says {quoted(found[0])}") if found else None


def below_in(text: str) -> Limits | None:
    """The lower end of a range in a description that begins below 0 (`Actual value: -20~18`); None without one."""
    found = _BELOW.search(clean(text))
    return Limits(-Fraction(found[1]), None) if found else None


def below_type(limits: Limits, wire: WireType, scale: Scale) -> Unclear | None:
    """A range with numbers below 0 beside a type that has none, however it is counted."""
    if limits.low is None or not wire.is_integer or wire.minimum < 0 or limits.low >= 0 or scale.back(limits.low) >= 0:
        return None
    return Unclear(f"the type is {wire}, and the range begins at {show(limits.low)}: perhaps it has a sign")
