"""What is longer than a request (a text, raw bytes): read and written in portions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from regscribe_runtime.errors import ExceptionAnswer, PartialWrite, is_lost
from regscribe_runtime.planning.address_ranges import places
from regscribe_runtime.wire.requests import SPACES, Request

if TYPE_CHECKING:
    from regscribe_runtime.operations.session import Operation, Session
    from regscribe_runtime.report import Words


def in_portions(session: Session, request: Request) -> Operation[Words]:
    """Send a request by several; PartialWrite if the device takes some of a write, and refuses the next."""
    words: Words = ()
    for portion in portions_of(session, request):
        try:
            words += yield from session.exchange(portion)
        except (ExceptionAnswer, PartialWrite) as error:
            done = portion.address - request.address
            if request.reads or not done or is_lost(error):
                raise
            done += error.written if isinstance(error, PartialWrite) else 0
            raise PartialWrite(
                unit=session.unit, address=request.address, sent=request.quantity, written=done
            ) from error
    if request.reads and session.absences.heard(request):
        session.prepared.clear()
    return words


def portions_of(session: Session, request: Request) -> list[Request]:
    """The requests that go out for one; itself where the device takes it at once."""
    most = session.most.get(request.function, request.quantity)
    if request.quantity <= most:
        return [request]
    return request.portions(most - most % _alignment(session, request))


def _alignment(session: Session, request: Request) -> int:
    """What addresses and counts must be multiples of there."""
    space = SPACES[request.function]
    return max(
        view.align
        for register in session.registers.values()
        for view, address in places(register)
        if view.space is space and address <= request.address < address + view.words
    )
