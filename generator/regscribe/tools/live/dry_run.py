"""A link that keeps writes instead of sending them; they read back as if they had been sent."""

from typing import Any, cast

from regscribe_runtime import BareDevice, Link
from regscribe_runtime.wire.requests import BLOCK_WRITES, READ_SPACES, SPACES, WRITES, Reply, Request


def dry(device: BareDevice) -> "DryLink":
    """Keep a driver from writing; the link has what it would have written."""
    link = DryLink(device.link)
    device.link = cast("Link", link)
    return link


class DryLink:
    """Passes reads to a link and answers writes itself, as a device that accepts every value."""

    def __init__(self, link: Link) -> None:
        self._link = link
        self.written: list[Request] = []
        self._held: dict[tuple[int, str, int], int] = {}

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401 - whatever else the link has
        return getattr(self._link, name)

    def retune(self, change: object) -> None:
        """Keep the line as it is: what would have changed it was not written."""

    def call(self, unit: int, request: Request) -> Reply:
        """Answer a write with its echo; send a read, and lay what was written over its answer."""
        if request.function not in WRITES:
            reply = self._link.call(unit, request)
            space = READ_SPACES.get(request.function)
            if space is None or reply.exception is not None:
                return reply
            held = (self._held.get((unit, space, request.address + at), word) for at, word in enumerate(reply.words))
            return reply._replace(words=tuple(held))
        self.written.append(request)
        space = SPACES[request.function]
        for offset, word in enumerate(request.words):
            self._held[unit, space, request.address + offset] = word
        words = () if request.function in BLOCK_WRITES else request.words
        return Reply(request.function, words, request.address, len(request.words))
