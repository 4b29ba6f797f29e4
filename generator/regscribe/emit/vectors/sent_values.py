"""What a device sends while it holds a number between two steps of a view, or one beyond the view's ends."""

from collections.abc import Iterator
from typing import Any

from regscribe.emit.vectors.offered_values import stored_numbers
from regscribe.emit.vectors.vector_sets import view_facts
from regscribe.model import Order, Register, RegisterMap, Rounding, View, show
from regscribe.reference import RefusedError, transmit

Json = dict[str, Any]


def transmissions(register_map: RegisterMap) -> list[Json]:
    """Return one entry for each kind of view that rounds or clips: stored numbers and the words that are sent."""
    registers: Iterator[Register] = (register for model in register_map.models for register in model.registers)
    views = (
        view._replace(offset=0, region=None, order=order)
        for register in registers
        for view in register.views
        for order in _orders(view)
    )
    return [{"view": view_facts(view), "sends": list(_sends(view))} for view in dict.fromkeys(views) if _alters(view)]


def _orders(view: View) -> tuple[Order, ...]:
    """Every order of words that the view may have; where a register sets it, each that it can set."""
    if isinstance(view.order, Order):
        return (view.order,)
    return tuple(dict.fromkeys(order for _, order in view.order.codes))


def _alters(view: View) -> bool:
    return view.type.is_integer and (view.saturates or view.rounding is not Rounding.NONE)


def _sends(view: View) -> Iterator[Json]:
    for stored, note in dict(reversed(list(stored_numbers(view)))).items():
        try:
            yield {"stored": show(stored), "words": list(transmit(view, stored)), "note": note}
        except RefusedError:
            continue
