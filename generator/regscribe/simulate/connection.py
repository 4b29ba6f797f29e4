"""One connection: bytes in, requests to the station, answers out, in the order of the requests."""

import asyncio
import contextlib
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field

from regscribe.simulate.framing import Framer, Request
from regscribe.simulate.station import Station

CHUNK = 4096
"""Bytes that are taken from one client before the others have their turn."""

_FAREWELL = 0.5
"""Seconds that a client has to take the last answers when its connection is closed."""


@dataclass(frozen=True, slots=True)
class Exchange:
    """A request, the device's answer (None: silence) and the frame that would be sent (empty: nothing)."""

    request: Request
    answer: bytes | None
    frame: bytes


Delivery = Callable[[Exchange], Awaitable[bytes]]
"""Stands between the device and the line: awaited for each exchange, it returns the bytes to send.

The place for latency, and for faults: waiting, changing, dropping or doubling frames. Exchanges of one connection pass
one after the other.
"""

Recorder = Callable[[Request], None]
"""Told of each request that concerns a device here, before it is handled."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Patience:
    """Seconds: `idle` until a silent client is disconnected, `gap` until half a frame is given up."""

    idle: float | None = 600.0
    gap: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Manners:
    """How a connection treats its client: patience, and who stands between the device and the line."""

    patience: Patience = field(default_factory=Patience)
    delivery: Delivery | None = None
    recorder: Recorder | None = None


class Connection:
    """Serves one client (or one serial line) until it leaves, stays silent too long, or stops reading."""

    __slots__ = ("_framer", "_manners", "_reader", "_station", "_writer", "heard")

    def __init__(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        framer: Framer,
        station: Station,
        manners: Manners,
    ) -> None:
        self.heard = time.monotonic()
        self._reader = reader
        self._writer = writer
        self._framer = framer
        self._station = station
        self._manners = manners

    async def serve(self) -> None:
        """Answer until the client is gone; raises TimeoutError when it was idle too long, OSError when it broke."""
        while (data := await self._receive()) != b"":
            self.heard = time.monotonic()
            requests = self._framer.expire() if data is None else self._framer.feed(data)
            for request in requests:
                await self._exchange(request)
            async with asyncio.timeout(self._manners.patience.idle):
                await self._writer.drain()
            if data is not None and len(data) == CHUNK:
                await asyncio.sleep(0)

    async def close(self) -> None:
        """Send what is left, without waiting for a client that does not read, and close."""
        self._writer.close()
        with contextlib.suppress(OSError, TimeoutError):
            async with asyncio.timeout(_FAREWELL):
                await self._writer.wait_closed()
        self._writer.transport.abort()

    async def _receive(self) -> bytes | None:
        """Return the next bytes, b"" at the end, None when the rest of a frame did not come."""
        patience, waits_for_rest = self._manners.patience, self._framer.pending
        try:
            async with asyncio.timeout(patience.gap if waits_for_rest else patience.idle):
                return await self._reader.read(CHUNK)
        except TimeoutError:
            if waits_for_rest:
                return None
            raise

    async def _exchange(self, request: Request) -> None:
        if self._manners.recorder is not None and self._station.has(request.unit):
            self._manners.recorder(request)
        answer = self._station.answer(request.unit, request.pdu)
        frame = b"" if answer is None else self._framer.answer(request, answer)
        if self._manners.delivery is not None:
            frame = await self._manners.delivery(Exchange(request, answer, frame))
        if frame:
            self._writer.write(frame)
