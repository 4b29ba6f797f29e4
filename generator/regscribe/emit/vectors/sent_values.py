"""What a device sends while it holds a number between two steps of a view, or one beyond the view's ends."""

from collections.abc import Iterator
from fractions import Fraction
from typing import Any

from regscribe.emit.vectors.candidates import Proposal
from regscribe.emit.vectors.vector_sets import view_facts
from regscribe.model import RegisterMap, Rounding, View, orders_of, show
from regscribe.reference import RefusedError, transmit

Json = dict[str, Any]
PARTS = {Fraction(1, 2): "half a step", Fraction(49, 100): "below a half", Fraction(51, 100): "above a half"}


def transmissions(register_map: RegisterMap) -> list[Json]:
    """Return one entry for each kind of view that rounds or clips: stored numbers and the words that are sent."""
    views = (
        view._replace(offset=0, region=None, order=order, byte_order=turned)
        for model in register_map.models
        for register in model.registers
        for view in register.views
        if view.type.is_integer and view.times is None and (view.saturates or view.rounding is not Rounding.NONE)
        for order in orders_of(view.order)
        for turned in orders_of(view.byte_order)
    )
    return [{"view": view_facts(view), "sends": list(_sends(view))} for view in dict.fromkeys(views)]


def _stored_numbers(view: View) -> Iterator[Proposal]:
    """Yield numbers that a device may hold, to see what it makes of them on the wire."""
    for whole in (0, 1, 2, 120, 121, -1, -2, -120):
        if whole >= 0 or view.type.minimum < 0:
            yield from (Proposal((whole + part) / view.factor, note) for part, note in PARTS.items())
    if view.saturates:
        ends = ((view.type.maximum, 1), (view.type.minimum, -1))
        yield from (Proposal(Fraction(end) / view.factor, "exactly the end") for end, _ in ends)
        yield from (
            Proposal(Fraction(end + 1000 * outward) / view.factor, "beyond the end: clipped") for end, outward in ends
        )


def _sends(view: View) -> Iterator[Json]:
    for stored, note in dict(reversed(list(_stored_numbers(view)))).items():
        try:
            yield {"stored": show(stored), "words": list(transmit(view, stored)), "note": note}
        except RefusedError:
            continue
