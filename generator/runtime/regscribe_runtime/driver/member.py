"""The link of a bus as one of its devices sees it: all the same, but closing it leaves the bus open."""

from regscribe_runtime.link.links import AsyncLink, Link
from regscribe_runtime.link.retry import Retry
from regscribe_runtime.values.serial_line import LineChange, SerialLine
from regscribe_runtime.wire.requests import Reply, Request


class _Common:
    """What is told of the link as it is now."""

    def __init__(self, link: Link | AsyncLink) -> None:
        self._link = link

    @property
    def epoch(self) -> int:
        """See `Link.epoch`."""
        return self._link.epoch

    @property
    def line(self) -> SerialLine | None:
        """See `Link.line`."""
        return self._link.line

    @property
    def timeout(self) -> float | None:
        """See `Link.timeout`."""
        return self._link.timeout

    @property
    def retry(self) -> Retry:
        """See `Link.retry`."""
        return self._link.retry

    @property
    def addressing(self) -> str:
        """See `Link.addressing`."""
        return self._link.addressing

    def retune(self, change: LineChange) -> None:
        """See `Link.retune`; it concerns all devices of the bus."""
        self._link.retune(change)


class Member(_Common):
    """The link of a `Bus` for one of its devices."""

    def __init__(self, link: Link) -> None:
        super().__init__(link)
        self.lock = link.lock
        self._open, self._call = link.open, link.call

    def open(self) -> None:
        """Open the bus, if it is not open."""
        self._open()

    def close(self) -> None:
        """Leave the bus open: it is for others too."""

    def call(self, unit: int, request: Request) -> Reply:
        """See `Link.call`."""
        return self._call(unit, request)


class AsyncMember(_Common):
    """The link of an `AsyncBus` for one of its devices."""

    def __init__(self, link: AsyncLink) -> None:
        super().__init__(link)
        self.lock = link.lock
        self._open, self._call = link.open, link.call

    async def open(self) -> None:
        """Open the bus, if it is not open."""
        await self._open()

    async def close(self) -> None:
        """Leave the bus open: it is for others too."""

    async def call(self, unit: int, request: Request) -> Reply:
        """See `Link.call`."""
        return await self._call(unit, request)
