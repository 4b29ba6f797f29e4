"""One connection: bytes in, requests to the station, answers out, in the order of the requests."""

import asyncio
from collections import deque
from typing import cast

from regscribe.simulate.line.server_context import ServerContext
from regscribe.simulate.line.service import Chunk, Exchange, Patience, Service
from regscribe_runtime.wire.framing import Frame
from regscribe_runtime.wire.server_framing import Framer

CHUNK = 4096
"""Bytes that are taken from one client before the others have their turn."""

MOST_WAITING = 64
"""Requests of one client that wait for their turn before no more are read from it."""


class Connection(asyncio.Protocol):
    """Serves one client or one serial line: requests from its bytes, answers in the order of the requests.

    What it keeps is bounded: half a frame, `MOST_WAITING` requests and a chunk's, and what the transport has buffered
    when it pauses writing; then the client is not read from until writing resumes.
    """

    def __init__(self, framer: Framer, station: ServerContext, service: Service) -> None:
        self._loop = asyncio.get_running_loop()
        self.heard = self._loop.time()
        self._framer = framer
        self._station = station
        self._service = service
        self._gap = (service.patience or Patience()).gap
        self._waiting: deque[Frame] = deque()
        self._task: asyncio.Task[None] | None = None
        self._expiry: asyncio.TimerHandle | None = None
        self._leaving = False
        self._room = asyncio.Event()
        self._room.set()

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Take the transport of a client."""
        self._reader: asyncio.ReadTransport = cast("asyncio.Transport", transport)
        self._writer: asyncio.WriteTransport = cast("asyncio.Transport", transport)

    def data_received(self, data: bytes) -> None:
        """Act on bytes of the client."""
        self.heard = self._loop.time()
        self._take(self._framer.feed(data))
        if self._expiry is not None:
            self._expiry.cancel()
            self._expiry = None
        if self._framer.pending:
            self._expiry = self._loop.call_later(self._gap, self._expire)

    def eof_received(self) -> bool:
        """Close once all requests are answered."""
        self._leaving = True
        if self._task is None:
            self._writer.close()
        return True

    def pause_writing(self) -> None:
        """Read no more of a client that does not read."""
        self._room.clear()
        self._reader.pause_reading()

    def resume_writing(self) -> None:
        """Go on with a client that reads again."""
        self._room.set()
        if len(self._waiting) < MOST_WAITING:
            self._reader.resume_reading()

    def connection_lost(self, exc: Exception | None) -> None:  # noqa: ARG002 - how a client ends is its own affair
        """Forget what is still to be done."""
        if self._expiry is not None:
            self._expiry.cancel()
        if self._task is not None:
            self._task.cancel()

    def _write(self, data: bytes) -> None:
        self._writer.write(data)

    def _abort(self) -> None:
        if not self._writer.is_closing():
            self._writer.abort()

    def _expire(self) -> None:
        self._expiry = None
        self._take(self._framer.expire())

    def _take(self, requests: list[Frame]) -> None:
        if not requests:
            return
        if not self._station.factor and self._service.delivery is None:
            frames = [self._exchange(request).frame for request in requests]
            self._write(b"".join(frames))
            return
        self._waiting.extend(requests)
        if len(self._waiting) >= MOST_WAITING:
            self._reader.pause_reading()
        if self._task is None:
            self._task = self._loop.create_task(self._answer_waiting())

    def _exchange(self, request: Frame) -> Exchange:
        service = self._service
        if service.recorder is not None and self._station.has(request.unit):
            service.recorder(request)
        act, arrival = self._station.answer, service.arrival
        unit, pdu = request.unit, request.pdu
        answer = act(unit, pdu) if arrival is None else arrival(request, lambda: act(unit, pdu))
        exchange = Exchange(request, answer, b"" if answer is None else self._framer.answer(request, answer))
        if service.watcher is not None:
            service.watcher(exchange)
        return exchange

    async def _answer_waiting(self) -> None:
        try:
            while self._waiting:
                await self._deliver(self._exchange(self._waiting.popleft()))
                await self._room.wait()
                if len(self._waiting) == MOST_WAITING - 1:
                    self._reader.resume_reading()
        except BaseException:
            self._abort()
            raise
        finally:
            self._task = None
        if self._leaving:
            self._writer.close()

    async def _deliver(self, exchange: Exchange) -> None:
        delivery = self._service.delivery
        if self._station.factor and exchange.answer is not None:
            await asyncio.sleep(self._station.delay(exchange.request))
        sent = exchange.frame if delivery is None else await delivery(exchange)
        for chunk in (Chunk(sent),) if isinstance(sent, bytes) else sent:
            if chunk.pause:
                await asyncio.sleep(chunk.pause)
            if chunk.data:
                self._write(chunk.data)
            if chunk.hangup:
                self._waiting.clear()
                self._writer.close()
