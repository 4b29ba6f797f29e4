"""What is longer than a request (a text, raw bytes): read and written in portions."""

from collections.abc import Iterable

from regscribe_runtime.planning.address_ranges import places
from regscribe_runtime.values.views import Placed
from regscribe_runtime.wire.requests import Request


def portions_of(request: Request, most: int, registers: Iterable[Placed]) -> list[Request]:
    """The requests that go out for one, of `most` addresses each; itself where the device takes it at once.

    Only one value is divided: a request for several that is too long is nobody's intention, and goes out as it is, so
    that the device refuses it.
    """
    if request.quantity <= most or not (align := _alignment(request, registers)):
        return [request]
    return request.portions(most - most % align)


def _alignment(request: Request, registers: Iterable[Placed]) -> int:
    """What addresses and counts must be multiples of there; 0 if the request is for more than one value."""
    return max(
        (
            view.align
            for register in registers
            for view, address in places(register)
            if view.space is request.space
            and address <= request.address
            and request.address + request.quantity <= _end(address + view.words, view.align)
        ),
        default=0,
    )


def _end(address: int, align: int) -> int:
    """Where the words of a value end with what is read along for its alignment."""
    return -(-address // align) * align
