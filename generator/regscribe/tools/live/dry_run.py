"""A link that keeps writes instead of sending them; they read back as if they had been sent."""

from contextlib import suppress
from typing import Any, cast

from regscribe_runtime import BareDevice, Link, Register, ValueRefused
from regscribe_runtime.operations.session import Session
from regscribe_runtime.registers import codec
from regscribe_runtime.values.wire_types import PAGE_BITS, WRITE_AND_READ, Space
from regscribe_runtime.wire.requests import (
    BLOCK_WRITES,
    MASK_REGISTER,
    READ_HOLDING,
    SPACES,
    WRITES,
    Reply,
    Request,
)


def dry(device: BareDevice) -> "DryLink":
    """Keep a driver from writing; the link has what it would have written."""
    link = DryLink(device.link, device.session)
    device.link = cast("Link", link)
    return link


class DryLink:
    """Passes reads to a link and answers writes itself, as a device that accepts every value."""

    def __init__(self, link: Link, session: Session) -> None:
        self._link, self._session = link, session
        self.written: list[Request] = []
        self._held: dict[tuple[object, ...], int] = {}
        self._unread: dict[tuple[str, int], tuple[Register[Any], Any]] = {}

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - whatever else the link has
        return getattr(self._link, name)

    def retune(self, change: object) -> None:
        """Keep the line as it is: what would have changed it was not written."""

    def call(self, unit: int, request: Request) -> Reply:
        """Answer a write with its echo; send a read, and lay what was written over its answer."""
        if request.selects and not request.fetches:  # reads would show another page
            return self._link.call(unit, request)
        address = request.page << PAGE_BITS | request.address
        if request.function == MASK_REGISTER:
            return self._mask(unit, request, address)
        if request.function not in WRITES:
            reply = self._link.call(unit, request)
            space = Space.HOLDING if request.function == WRITE_AND_READ else request.space
            if space is None or reply.exception is not None:
                return reply
            held = (self._held.get((unit, space, address + at), word) for at, word in enumerate(reply.words))
            return reply._replace(words=tuple(held))
        self.written.append(request)
        self._unread = {
            (view.space, view.address(register.at)): (register, view)
            for register in self._session.registers.values()  # those in blocks stand somewhere since these were found
            for view in register.views
            if register.access.writable and not (view.readable and register.access.readable)
        }
        self._hold(unit, request.space or Space.HOLDING, address, request.words)
        words = () if request.function in BLOCK_WRITES else request.words
        return Reply(request.function, words, request.address, len(request.words))

    def _mask(self, unit: int, request: Request, address: int) -> Reply:
        """Keep some bits of a word, as if they had been written."""
        keep, put = request.words
        (word,) = self.call(unit, Request(READ_HOLDING, request.address, page=request.page)).words
        self.written.append(request)
        self._hold(unit, SPACES[READ_HOLDING], address, ((word & keep) | put,))
        return Reply(request.function, request.words, request.address)

    def _hold(self, unit: int, space: str, address: int, words: tuple[int, ...]) -> None:
        """Keep words where they are read back: where they are written, unless a register is read elsewhere."""
        if not words:
            return
        register, view = self._unread.get((space, address), (None, None))
        count = view.words if view else 1
        if register is None or view is None:
            self._held[unit, space, address] = words[0]
        elif register.access.readable:
            seen, session = register.seen_in(view), self._session
            with suppress(ValueRefused):
                carried = codec.carried_over(register, view, seen, words[:count], session.memory, session.givens)
                start = seen.address(register.at)
                self._held.update(((unit, seen.space, start + at), word) for at, word in enumerate(carried))
        self._hold(unit, space, address + count, words[count:])
