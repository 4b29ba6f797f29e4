"""Codes beside a number: `0=off` of a timer from 0 to 120 is a value with a name, and no enum."""

from fractions import Fraction
from typing import Any

from regscribe.draft.numbers import plain
from regscribe.files import OneLine
from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.enums import Codes
from regscribe.importers.table.cells.ranges import Limits, settle_range
from regscribe.importers.table.cells.scales import PLAIN
from regscribe.importers.table.cells.units import UnitCell, parse_unit
from regscribe.importers.table.making import Making
from regscribe.importers.table.meanings import unlike
from regscribe.importers.table.whole import Whole


def is_number(making: Making, whole: Whole, index: int, codes: Codes) -> bool:
    """Whether a register is a number of which some values have names: what else its row says makes it one."""
    item = making.item
    if codes.flags or making.type.kind == "enum":
        return False
    scaled = any(cells.cells[index] not in {None, PLAIN} for cells in (whole.scales, whole.decimals))
    if scaled or item["offset"] or isinstance(parse_unit(item["unit"]), UnitCell):
        return True
    return len(codes.labels) == 1 or _is_wider(making, whole.limits[index], codes)


def _is_wider(making: Making, limits: Limits | Unclear | None, codes: Codes) -> bool:
    """Whether a range is other than that of the codes, and no range of the whole type."""
    if not isinstance(limits, Limits) or limits.low is None or limits.high is None or making.wire.is_octets:
        return False
    ends = making.wire.ends
    whole_type = limits.low <= ends[0] or limits.high >= ends[1]
    is_codes = limits.low == min(codes.labels) and limits.high == max(codes.labels)
    return not is_codes and (not whole_type or 0 < limits.high < ends[1])


def add_special(making: Making, codes: Codes) -> None:
    """Set the values with names; which values they are hangs on the scale, as of a range."""
    found: dict[Any, Any] = {}
    for code, label in unlike(dict(codes.labels)).items():
        value = _value(making, Fraction(code))
        if isinstance(value, Unclear):
            making.ask("codes-unclear", f"code {code} is not in the map: {value.message}")
        else:
            found[plain(value)] = label
    if found:
        making.set({"special": OneLine(found)})
    for low, high, label in codes.ranges:
        making.lose("codes-range", f"`{low}..{high} = {label[:40]}` is not in the map beside a number")
    if codes.other:
        making.lose("codes-other", f"all other values are called `{codes.other[:40]}`, which a number cannot say")


def _value(making: Making, code: Fraction) -> Fraction | Unclear:
    if making.scale is None:
        return Unclear("it cannot be read while the scale is unclear")
    settled = settle_range(Limits(code, code), making.wire, making.scale)
    return settled if isinstance(settled, Unclear) else settled.limits.low or Fraction(0)
