"""What is longer than a request (a text, raw bytes): read and written in portions."""

from collections.abc import Iterable

from regscribe_runtime.planning.address_ranges import places
from regscribe_runtime.values.views import Placed
from regscribe_runtime.wire.requests import Request


def portions_of(request: Request, most: int, registers: Iterable[Placed]) -> list[Request]:
    """The requests that go out for one, of `most` addresses each; itself where the device takes it at once."""
    if request.quantity <= most:
        return [request]
    return request.portions(most - most % _alignment(request, registers))


def _alignment(request: Request, registers: Iterable[Placed]) -> int:
    """What addresses and counts must be multiples of there."""
    space = request.space
    return max(
        view.align
        for register in registers
        for view, address in places(register)
        if view.space is space and address <= request.address < address + view.words
    )
