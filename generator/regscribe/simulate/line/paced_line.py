"""A serial line at the pace of a speed in baud, in both directions."""

import asyncio

from regscribe.simulate.line.serial_ports import OpenLine
from regscribe.simulate.line.server_context import ServerContext
from regscribe.simulate.line.servers import LineServer
from regscribe.simulate.line.service import Service
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.server_framing import SilenceFramer

TICK = 0.002
"""Seconds between two portions of a paced answer: finer than any reader looks."""


class PacedLineServer(LineServer):
    """Serves a line whose bytes take the time that they take at the speed of `serial`, in both directions.

    Frames end by silence, as RTU has it: bytes that follow each other within `gap` seconds are one frame. Requests
    without silence between them are one bad frame. With `strict_gaps`, so is a request that begins within the gap
    after the end of the answer before it.
    """

    def __init__(
        self, line: OpenLine, station: ServerContext, service: Service, serial: SerialLine, gap: float
    ) -> None:
        super().__init__(line, station, service, SilenceFramer())
        self._character = serial.character
        self._silence = gap
        self._strict = service.strict_gaps
        self._frame = bytearray()
        self._arrival = 0.0
        self._ending: asyncio.TimerHandle | None = None
        self._spoilt = False
        self._queue = bytearray()
        self._sent = 0.0
        self._ticking: asyncio.TimerHandle | None = None

    def data_received(self, data: bytes) -> None:
        """Wait for the silence that ends a frame."""
        loop = asyncio.get_running_loop()
        now = loop.time()
        if not self._frame:
            self._spoilt = self._strict and (bool(self._queue) or now < self._sent + self._silence)
        self._arrival = max(self._arrival, now) + len(data) * self._character
        self._frame += data
        if self._ending is not None:
            self._ending.cancel()
        self._ending = loop.call_at(self._arrival + self._silence, self._end_frame)

    def connection_lost(self, exc: Exception | None) -> None:
        """Send and receive no more."""
        super().connection_lost(exc)
        self._queue.clear()
        for handle in (self._ending, self._ticking):
            if handle is not None:
                handle.cancel()

    def _end_frame(self) -> None:
        self._ending = None
        frame, self._frame = bytes(self._frame), bytearray()
        if not self._spoilt:
            super().data_received(frame)

    def _write(self, data: bytes) -> None:
        now = self._loop.time()
        if not self._queue:
            self._sent = max(self._sent, now)
        self._queue += data
        if self._ticking is None:
            self._tick()

    def _tick(self) -> None:
        """Write what is due: a byte is readable when its last bit has passed."""
        self._ticking = None
        due = min(len(self._queue), int((self._loop.time() - self._sent) / self._character))
        if due:
            super()._write(bytes(self._queue[:due]))
            del self._queue[:due]
            self._sent += due * self._character
        if self._queue:
            self._ticking = self._loop.call_at(self._sent + max(self._character, TICK), self._tick)
