"""One connection: bytes in, requests to the station, answers out, in the order of the requests."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from regscribe.simulate.line.response_delay import Pace
from regscribe.simulate.line.server_context import ServerContext
from regscribe_runtime.wire.framing import Frame
from regscribe_runtime.wire.server_framing import Framer

CHUNK = 4096
"""Bytes that are taken from one client before the others have their turn."""

MOST_WAITING = 64
"""Requests of one client that wait for their turn before no more are read from it."""


@dataclass(frozen=True, slots=True)
class Exchange:
    """A request, the device's answer (None: silence) and the frame that would be sent (empty: nothing)."""

    request: Frame
    answer: bytes | None
    frame: bytes


@dataclass(frozen=True, slots=True)
class Chunk:
    """Bytes that are sent after `pause` seconds; with `hangup` the client is disconnected then."""

    data: bytes = b""
    pause: float = 0.0
    hangup: bool = False


Delivery = Callable[[Exchange], Awaitable[bytes | Sequence[Chunk]]]
"""Stands between the device and the line: awaited for each exchange, it returns the bytes to send.

The place for faults: waiting, changing, dropping or doubling frames. Exchanges of one connection pass one after the
other; the device's own latency has passed before.
"""

Arrival = Callable[[Frame, Callable[[], bytes | None]], bytes | None]
"""Stands between the line and the device: called with each request, and with what lets the device act on it.

It returns the answer. If it does not let the device act, the request never arrived.
"""

Recorder = Callable[[Frame], None]
"""Told of each request that concerns a device here, before it is handled."""

Watcher = Callable[[Exchange], None]
"""Told of each exchange, requests to foreign units among them, before its frame is sent."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Patience:
    """Seconds: `idle` until a silent client is disconnected, `gap` until half a frame is given up."""

    idle: float | None = 600.0
    gap: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectionPolicy:
    """How a connection treats its client: patience, pace, and who stands between the device and the line."""

    patience: Patience = field(default_factory=Patience)
    pace: Pace | None = None
    arrival: Arrival | None = None
    delivery: Delivery | None = None
    recorder: Recorder | None = None
    watcher: Watcher | None = None

    @property
    def immediate(self) -> bool:
        """Whether each answer is sent as soon as it is known."""
        return self.pace is None and self.delivery is None


class Outlet(Protocol):
    """Where frames go: what a connection needs of an asyncio transport."""

    def write(self, data: bytes) -> None:
        """Send, sooner or later."""

    def pause_reading(self) -> None:
        """Let the client wait."""

    def resume_reading(self) -> None:
        """Let it go on."""

    def close(self) -> None:
        """Send what is left, and close."""

    def abort(self) -> None:
        """Close at once."""


class Connection:
    """Serves one client (or one serial line): `received` is called with its bytes, all else follows.

    What it keeps is bounded: half a frame, `MOST_WAITING` requests and a chunk's, and what `outlet` has buffered when
    it says `paused`; then the client is not read from until `resumed`.
    """

    __slots__ = (
        *("_expiry", "_framer", "_leaving", "_loop", "_manners", "_outlet"),
        *("_room", "_station", "_task", "_waiting", "heard"),
    )

    def __init__(self, framer: Framer, station: ServerContext, manners: ConnectionPolicy, outlet: Outlet) -> None:
        self._loop = asyncio.get_running_loop()
        self.heard = self._loop.time()
        self._framer = framer
        self._station = station
        self._manners = manners
        self._outlet = outlet
        self._waiting: deque[Frame] = deque()
        self._task: asyncio.Task[None] | None = None
        self._expiry: asyncio.TimerHandle | None = None
        self._leaving = False
        self._room = asyncio.Event()
        self._room.set()

    def received(self, data: bytes) -> None:
        """Act on bytes of the client."""
        self.heard = self._loop.time()
        self._take(self._framer.feed(data))
        if self._expiry is not None:
            self._expiry.cancel()
            self._expiry = None
        if self._framer.pending:
            self._expiry = self._loop.call_later(self._manners.patience.gap, self._expire)

    def finish(self) -> None:
        """Close once all that was asked is answered."""
        self._leaving = True
        if self._task is None:
            self._outlet.close()

    def paused(self) -> None:
        """The client does not read: ask no more of it."""
        self._room.clear()
        self._outlet.pause_reading()

    def resumed(self) -> None:
        """It reads again."""
        self._room.set()
        if len(self._waiting) < MOST_WAITING:
            self._outlet.resume_reading()

    def end(self) -> None:
        """Forget what is still to be done: the client is gone."""
        if self._expiry is not None:
            self._expiry.cancel()
        if self._task is not None:
            self._task.cancel()

    def _expire(self) -> None:
        self._expiry = None
        self._take(self._framer.expire())

    def _take(self, requests: list[Frame]) -> None:
        if not requests:
            return
        if self._manners.immediate:
            frames = [self._exchange(request).frame for request in requests]
            self._outlet.write(b"".join(frames))
            return
        self._waiting.extend(requests)
        if len(self._waiting) >= MOST_WAITING:
            self._outlet.pause_reading()
        if self._task is None:
            self._task = self._loop.create_task(self._work_off())

    def _exchange(self, request: Frame) -> Exchange:
        manners = self._manners
        if manners.recorder is not None and self._station.has(request.unit):
            manners.recorder(request)
        act, arrival = self._station.answer, manners.arrival
        unit, pdu = request.unit, request.pdu
        answer = act(unit, pdu) if arrival is None else arrival(request, lambda: act(unit, pdu))
        exchange = Exchange(request, answer, b"" if answer is None else self._framer.answer(request, answer))
        if manners.watcher is not None:
            manners.watcher(exchange)
        return exchange

    async def _work_off(self) -> None:
        try:
            while self._waiting:
                await self._deliver(self._exchange(self._waiting.popleft()))
                await self._room.wait()
                if len(self._waiting) == MOST_WAITING - 1:
                    self._outlet.resume_reading()
        except BaseException:
            self._outlet.abort()
            raise
        finally:
            self._task = None
        if self._leaving:
            self._outlet.close()

    async def _deliver(self, exchange: Exchange) -> None:
        pace, delivery = self._manners.pace, self._manners.delivery
        if pace is not None and exchange.answer is not None:
            await asyncio.sleep(pace.seconds(exchange.request))
        sent = exchange.frame if delivery is None else await delivery(exchange)
        for piece in (Chunk(sent),) if isinstance(sent, bytes) else sent:
            await self._send(piece)

    async def _send(self, piece: Chunk) -> None:
        if piece.pause:
            await asyncio.sleep(piece.pause)
        if piece.data:
            self._outlet.write(piece.data)
        if piece.hangup:
            self._waiting.clear()
            self._outlet.close()
