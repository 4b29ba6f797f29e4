"""The exporter of a C header: addresses, types, exact scales, codes, masks and faults of one model.

ISO C99 and C++11, for any compiler with <stdint.h>. Nothing in it is a float: scales are ratios of whole numbers, the
ends of ranges are numbers as they stand on the wire.
"""

from collections.abc import Mapping, Sequence

from regscribe.export.c_header.header import header
from regscribe.export.c_header.spelling import LIMIT, TYPES
from regscribe.export.device import RESOLVED, Carries, Carry, Point, Request, Target, Wire, exported
from regscribe.export.device.options import CHOICE, MODEL, STATE
from regscribe.losses import Exported
from regscribe.model import Order, RegisterMap

name = "c-header"
summary = "a C header of one model: addresses, types, exact scales, codes, masks"
options = (MODEL, *CHOICE, *STATE)

WHOLE = (
    *("scale-not-stated", "unit", "enum", "flags", "boolean", "version", "bytes", "date", "write", "write-only"),
    *("danger", "string", "padding", "source", "array", "group", "name", "symbol", "description", "limits"),
)
PARTLY = ("condition", "scale", "offset", "range", "sentinel", "special-value", "fields")

carries: Carries = RESOLVED | dict.fromkeys(WHOLE, Carry.WHOLE) | dict.fromkeys(PARTLY, Carry.PARTLY)


def _fits(wire: Wire) -> bool:
    if wire.apart or wire.type not in TYPES:
        return False
    return wire.space.is_bits or (isinstance(wire.words, Order) and isinstance(wire.bytes, Order))


def _refuses(point: Point, _: Request) -> str:
    ratios = (part for number in (point.slope, point.offset) for part in number.as_integer_ratio())
    if any(abs(part) >= LIMIT for part in ratios):
        return "its scale is no ratio of whole numbers of 64 bits"
    return ""


TARGET = Target(
    name=name,
    carries=carries,
    fits=_fits,
    refuses=_refuses,
    verified="gcc 12 (C99) and g++ 12 (C++11)",
    placed=False,
)


def export(maps: Sequence[RegisterMap], options: Mapping[str, str]) -> Exported:
    """Return the header. Raises OptionError."""
    return exported(TARGET, maps, options, header)
