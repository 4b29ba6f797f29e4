"""A serial line as a transport: bytes as they come, or at the pace of a speed in baud."""

import asyncio
import os
from collections.abc import Callable
from dataclasses import dataclass

from regscribe_runtime.values.serial_line import SerialLine

CHUNK = 4096
MOST_BUFFERED = 1 << 16
"""Bytes that wait to be written before the other side counts as not reading."""

TICK = 0.002
"""Seconds between two portions of a paced answer: finer than any reader looks."""


@dataclass(frozen=True, slots=True)
class Events:
    """Whom a line tells of what happens."""

    received: Callable[[bytes], None]
    lost: Callable[[OSError | None], None]
    paused: Callable[[], None]
    resumed: Callable[[], None]


class LineTransport:
    """Reads and writes a file descriptor without blocking; what cannot be written at once waits in a buffer."""

    def __init__(self, fd: int, events: Events) -> None:
        self._fd = fd
        self._events = events
        self._loop = asyncio.get_running_loop()
        self._buffer = bytearray()
        self._full = False
        self._open = True
        self._reading = False
        self.resume_reading()

    def write(self, data: bytes) -> None:
        """Send now, or as soon as the line takes it."""
        if not self._open:
            return
        if not self._buffer:
            data = data[self._put(data) :]
            if data and self._open:
                self._loop.add_writer(self._fd, self._flush)
        self._buffer += data
        self._tell()

    def pause_reading(self) -> None:
        """Leave what comes in the line."""
        if self._reading:
            self._loop.remove_reader(self._fd)
            self._reading = False

    def resume_reading(self) -> None:
        """Take what comes."""
        if self._open and not self._reading:
            self._loop.add_reader(self._fd, self._read)
            self._reading = True

    def close(self) -> None:
        """Stop; what the line does not take at once is lost."""
        self.abort()

    def abort(self) -> None:
        """Stop."""
        self.pause_reading()
        if self._buffer:
            self._loop.remove_writer(self._fd)
            self._buffer.clear()
        self._open = False

    def _read(self) -> None:
        try:
            data = os.read(self._fd, CHUNK)
        except BlockingIOError:
            return
        except OSError as problem:
            self._lose(problem)
            return
        if data:
            self._arrived(data)
        else:
            self._lose(None)

    def _arrived(self, data: bytes) -> None:
        self._events.received(data)

    def _lose(self, problem: OSError | None) -> None:
        self.abort()
        self._events.lost(problem)

    def _put(self, data: bytes | bytearray) -> int:
        try:
            return os.write(self._fd, data)
        except BlockingIOError:
            return 0
        except OSError as problem:
            self._lose(problem)
            return len(data)

    def _flush(self) -> None:
        del self._buffer[: self._put(self._buffer)]
        if not self._buffer and self._open:
            self._loop.remove_writer(self._fd)
        self._tell()

    def _tell(self) -> None:
        """Say when the other side stops reading what is sent, and when it goes on."""
        if self._open and self._full != (len(self._buffer) > MOST_BUFFERED):
            self._full = not self._full
            (self._events.paused if self._full else self._events.resumed)()


class PacedTransport(LineTransport):
    """A line whose bytes take the time that they take at `line`'s speed, in both directions.

    Frames end by silence, as RTU has it: bytes that follow each other within `gap` seconds are one frame. Requests
    without silence between them are one bad frame. With `strict`, so is a request that begins within the gap after the
    end of the answer before it.
    """

    def __init__(self, fd: int, events: Events, line: SerialLine, *, gap: float, strict: bool) -> None:
        self._character = line.character
        self._gap = gap
        self._strict = strict
        self._frame = bytearray()
        self._arrival = 0.0
        self._ending: asyncio.TimerHandle | None = None
        self._spoilt = False
        self._queue = bytearray()
        self._sent = 0.0
        self._ticking: asyncio.TimerHandle | None = None
        super().__init__(fd, events)

    def write(self, data: bytes) -> None:
        """Send at the pace of the line."""
        now = self._loop.time()
        if not self._queue:
            self._sent = max(self._sent, now)
        self._queue += data
        if self._ticking is None:
            self._tick()

    def abort(self) -> None:
        """Stop."""
        for handle in (self._ending, self._ticking):
            if handle is not None:
                handle.cancel()
        self._queue.clear()
        super().abort()

    def _arrived(self, data: bytes) -> None:
        now = self._loop.time()
        if not self._frame:
            self._spoilt = self._strict and (bool(self._queue) or now < self._sent + self._gap)
        self._arrival = max(self._arrival, now) + len(data) * self._character
        self._frame += data[:CHUNK]
        if self._ending is not None:
            self._ending.cancel()
        self._ending = self._loop.call_at(self._arrival + self._gap, self._ended)

    def _ended(self) -> None:
        self._ending = None
        frame, self._frame = bytes(self._frame), bytearray()
        if not self._spoilt:
            self._events.received(frame)

    def _tick(self) -> None:
        """Write what is due: a byte is readable when its last bit has passed."""
        self._ticking = None
        due = min(len(self._queue), int((self._loop.time() - self._sent) / self._character))
        if due:
            super().write(bytes(self._queue[:due]))
            del self._queue[:due]
            self._sent += due * self._character
        if self._queue:
            self._ticking = self._loop.call_at(self._sent + max(self._character, TICK), self._tick)
