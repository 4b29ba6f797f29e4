"""The places where a register can be read, and the first of them that this unit has.

The preferred view is decoded. Another view is as good only if it transmits the same number with the same precision, so
an integer view never replaces an IEEE one. Aliases repeat the base view. The others serve units that lack the first.
"""

from operator import attrgetter
from typing import NamedTuple

from regscribe_runtime.planning.address_ranges import AddressRanges, RegisterSpan, places, span_of
from regscribe_runtime.values.views import Placed, View, read_view

_precision = attrgetter("type", "words", "factor", "times", "rounding", "saturates")


class ReadPlace(NamedTuple):
    """One place to read a register at, and the view that decodes it."""

    view: View
    span: RegisterSpan


def read_places(register: Placed) -> tuple[ReadPlace, ...]:
    """All places to read a register at, that of the preferred view first; at least one."""
    preferred = read_view(register)
    first = ReadPlace(preferred, span_of(preferred, preferred.address(register.at)))
    if len(register.views) == 1 and not register.aliases:
        return (first,)
    found = {first.span: first}
    for view, address in places(register):
        if (
            set(view.needs()) <= set(preferred.needs())
            and view.byte_order == preferred.byte_order
            and same_precision(view, preferred)
        ):
            span = span_of(view, address)
            found.setdefault(span, ReadPlace(view, span))
    return tuple(place for place in found.values() if place.view.readable) or (first,)


def place_of(register: Placed, ranges: AddressRanges) -> ReadPlace | None:
    """The first place that may be read; None if this unit has the register nowhere."""
    return next((place for place in read_places(register) if ranges.stretch(place.span) is not None), None)


def same_precision(view: View, other: View) -> bool:
    """Whether two views transmit the same number, in whatever order of words and bytes."""
    return bool(_precision(view) == _precision(other))
