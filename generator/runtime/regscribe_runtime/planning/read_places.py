"""The places where a register can be read, and the first of them that this unit has.

A driver decodes the view to prefer. Another view is as good only if it transmits the same number in the same type:
equal type, length, factor, rounding and clipping; so an integer view never stands in for an IEEE one. Aliases repeat
the base view, so they count where the base view does. The others are for units that lack the first.
"""

from collections.abc import Iterator
from typing import NamedTuple

from regscribe_runtime.planning.address_ranges import AddressRanges, RegisterSpan, places
from regscribe_runtime.values.views import Placed, View, read_view


class ReadPlace(NamedTuple):
    """One place to read a register at, and the view that decodes it."""

    view: View
    span: RegisterSpan


def read_places(register: Placed) -> tuple[ReadPlace, ...]:
    """All places to read a register at, the view to prefer first; at least one."""
    preferred = read_view(register)
    if len(register.views) == 1 and not register.aliases:
        return (_place(preferred, preferred.address(register.at)),)
    found: dict[RegisterSpan, ReadPlace] = {}
    for view, address in _from_preferred(register, preferred):
        if view is preferred or same_number(view, preferred):
            place = _place(view, address)
            found.setdefault(place.span, place)
    readable = tuple(place for place in found.values() if place.view.readable)
    return readable or tuple(found.values())[:1]


def place_of(register: Placed, ranges: AddressRanges) -> ReadPlace | None:
    """The first place that may be read; None if this unit has the register nowhere."""
    return next((place for place in read_places(register) if ranges.stretch(place.span) is not None), None)


def same_number(view: View, other: View) -> bool:
    """Whether a view transmits the same number as another with the same precision, and needs to know no more for it."""
    return (
        set(view.needs()) <= set(other.needs()) and view.byte_order == other.byte_order and same_precision(view, other)
    )


def same_precision(view: View, other: View) -> bool:
    """Whether two views transmit the same number, in whatever order of words and bytes."""
    return (
        view.type,
        view.words,
        view.factor,
        view.rounding,
        view.saturates,
    ) == (
        other.type,
        other.words,
        other.factor,
        other.rounding,
        other.saturates,
    )


def _from_preferred(register: Placed, preferred: View) -> Iterator[tuple[View, int]]:
    yield preferred, preferred.address(register.at)
    yield from places(register)


def _place(view: View, address: int) -> ReadPlace:
    return ReadPlace(view, RegisterSpan(view.space, address, view.words))
