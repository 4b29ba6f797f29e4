"""Where the bytes of a value stand on the wire, and which functions write them."""

from regscribe.export.device.points import Point
from regscribe.model import Order
from regscribe_runtime.values.protocol import Protocol


def places_of(point: Point) -> list[int]:
    """Return the places of a value's bytes among those that its registers take, the most significant first."""
    count, words = point.words, point.wire.words
    if isinstance(words, Order):
        steps = list(range(count)) if words is Order.BIG else list(range(count - 1, -1, -1))
    else:
        steps = [place - 1 for place in words]
    swapped = point.wire.bytes is not Order.BIG
    return [2 * step + (place ^ swapped) for step in steps for place in (0, 1)]


def write_functions(protocol: Protocol, point: Point) -> list[int]:
    """Return the functions of a device that write a value as a whole, that of one word or coil first."""
    view = point.register.write_view
    usable = [one for one in view.space.write_functions if view.allows(one) and one in protocol.functions]
    return [one for one in usable if point.words == 1 or one == view.space.write_functions[-1]]
