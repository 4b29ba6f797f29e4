"""Where the bytes of a value stand on the wire, and in which steps they count."""

from fractions import Fraction

from regscribe.export.device.points import Point
from regscribe.model import Order
from regscribe.reference import Surroundings, UnknownValueError, choose, decimal_factor, present_view


def places_of(point: Point) -> list[int]:
    """Return the places of a value's bytes among those that its registers take, the most significant first."""
    count, words = point.words, point.wire.words
    if isinstance(words, Order):
        steps = list(range(count)) if words is Order.BIG else list(range(count - 1, -1, -1))
    else:
        steps = [place - 1 for place in words]
    swapped = point.wire.bytes is not Order.BIG
    return [2 * step + (place ^ swapped) for step in steps for place in (0, 1)]


def step_of(point: Point, known: Surroundings) -> Fraction | None:
    """Return the smallest increment on the wire, None where the map states none; 0 where it is not known now."""
    try:
        conversion = choose(point.register.scale, known)
        if conversion is None or conversion.step is None:
            return None
        factor, view = decimal_factor(conversion.places, known), present_view(point.view, known)
    except UnknownValueError:
        return Fraction(0)
    return Fraction(0) if factor is None or view is None else Fraction(conversion.step) / factor * Fraction(view.factor)
