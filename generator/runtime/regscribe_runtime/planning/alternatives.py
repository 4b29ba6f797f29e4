"""The ways to read a register: every place that gives the same value with the same precision.

A driver decodes the preferred view. Another view is as good only if it transmits the same number in the same type:
equal type, length, factor, rounding and clipping; so an integer view never stands in for an IEEE one. Aliases repeat
the base view, so they count where the base view does. Of what is left, the planner may take the cheapest.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from regscribe_runtime.planning.address_ranges import AddressRanges, RegisterSpan, places
from regscribe_runtime.values.specs import View

if TYPE_CHECKING:
    from regscribe_runtime.registers.register import Register


class Way(NamedTuple):
    """One place to read a register at, and the view that decodes it."""

    view: View
    item: RegisterSpan


def ways(register: "Register[Any]") -> tuple[Way, ...]:
    """All ways to read a register, the view to prefer first; at least one."""
    preferred = register.read_view()
    if len(register.views) == 1 and not register.aliases:
        return (_way(preferred, preferred.address(register.at)),)
    found: dict[RegisterSpan, Way] = {}
    for view, address in _from_preferred(register, preferred):
        if view is preferred or same_number(view, preferred):
            way = _way(view, address)
            found.setdefault(way.item, way)
    readable = tuple(way for way in found.values() if way.view.readable)
    return readable or tuple(found.values())[:1]


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


def open_ways(register: "Register[Any]", ground: AddressRanges) -> tuple[Way, ...]:
    """The ways that the ground leaves open: none, if this unit has the register at no place."""
    return tuple(way for way in ways(register) if ground.stretch(way.item) is not None)


def _from_preferred(register: "Register[Any]", preferred: View) -> Iterator[tuple[View, int]]:
    yield preferred, preferred.address(register.at)
    yield from places(register)


def _way(view: View, address: int) -> Way:
    return Way(view, RegisterSpan(view.space, address, view.words))
