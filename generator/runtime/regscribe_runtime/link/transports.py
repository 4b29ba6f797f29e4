"""Links over TCP and over serial ports, for threads and for asyncio: they open, close, wait and open again.

`exchange` has the protocol. After silence, noise or a cancelled call a TCP connection is closed and the next request
opens a new one, so that nothing late can reach it; a serial port stays open, and its line discipline handles late
answers (opening a port costs time and resets some devices).
"""

import time

from regscribe_runtime.errors import LinkLost, NotOpen, RegscribeError
from regscribe_runtime.link.exchange import Conversation
from regscribe_runtime.link.links import LinkSettings, Retry, Tracer
from regscribe_runtime.link.locks import AsyncTurns, Turns
from regscribe_runtime.link.streams import Stream, open_serial, open_tcp, open_tcp_async, wait, wait_async
from regscribe_runtime.link.timing import more_in_ascii
from regscribe_runtime.values.serial_line import LineChange, SerialLine
from regscribe_runtime.wire.requests import Reply, Request

USUAL_GAP = 3.5
"""Characters of silence between frames, by the standard."""

TRUST_SECONDS = 0.01
"""How long after an answer a connection is not checked before a read: servers close idle ones only."""

Place = tuple[str, int] | SerialLine
"""Host and port, or a serial line."""


class _Base:
    """Common parts of both kinds of link; see `LinkState` for the attributes."""

    def __init__(self, place: Place, settings: LinkSettings) -> None:
        self.timeout = settings.get("timeout")
        if self.timeout is not None and self.timeout <= 0:
            message = f"a timeout of {self.timeout} s lets nobody answer"
            raise ValueError(message)
        self.retry = settings.get("retry") or Retry()
        self.framing = settings.get("framing", "tcp")
        self.epoch = 0
        self.opened = False
        line = place.checked() if isinstance(place, SerialLine) else None
        self._place, self._tuned = place, line
        self._echo, gap = settings.get("echo"), settings.get("gap", USUAL_GAP)
        self.addressing = settings.get("addressing", "modbus")
        self._talk = Conversation(self.framing, addressing=self.addressing, line=line, gap=gap, echo=self._echo)
        self._talk.trace = settings.get("trace")
        self._wire: Stream | None = None
        self._renewing = False
        self._trusted_until = 0.0

    @property
    def name(self) -> str:
        """The port, or host and port as tcp://host:port."""
        return self._place.port if isinstance(self._place, SerialLine) else f"tcp://{self._place[0]}:{self._place[1]}"

    @property
    def line(self) -> SerialLine | None:
        """The serial line; None over TCP. Setting it makes the next request use the other speed or format."""
        return self._place if isinstance(self._place, SerialLine) else None

    @line.setter
    def line(self, line: SerialLine) -> None:
        if not isinstance(self._place, SerialLine):
            message = f"{self.name} has no serial line whose settings could change"
            raise ValueError(message)  # noqa: TRY004 (a value that this link cannot have)
        self._place = line.checked()

    def retune(self, change: LineChange) -> None:
        """See `LinkState.retune`; over TCP there is no speed and no format to change."""
        if change.addressing is not None:
            self._talk.set_addressing(change.addressing)
            self.addressing = change.addressing
        if change.line and self.line is not None:
            self.line = self.line._replace(**change.line)

    @property
    def trace(self) -> Tracer | None:
        """The tracer that is called with every frame, or None."""
        return self._talk.trace

    @trace.setter
    def trace(self, trace: Tracer | None) -> None:
        self._talk.trace = trace

    def _drop(self, *, renew: bool = False) -> None:
        """Close the wire; `renew` if it was in order, so that opening it anew counts as no new epoch."""
        self._renewing = renew
        if self._wire is not None:
            self._wire.close()
            self._wire = None

    def _opened(self, wire: Stream) -> Stream:
        self._wire = wire
        self._talk.tainted = False
        if self._talk.discipline is not None and self.line is not None:
            self._talk.discipline.tune(self.line, echo=self._echo)
            self._tuned = self.line
        self.epoch += not self._renewing
        self._renewing = False
        return wire

    def _usable(self, request: Request) -> Stream | None:
        """The open wire; None if there is none, it broke, or unexpected bytes came since the last request.

        A write to a connection that the server had closed before would leave open whether it was carried out.
        """
        if not self.opened:
            message = f"{self.name} is not open: use the driver in a `with` statement, or call open()"
            raise NotOpen(message)
        if self._wire is None:
            return None
        if self._tuned != self.line:
            self._drop(renew=True)
        elif self._tuned is None and (time.monotonic() > self._trusted_until or not request.reads):
            try:
                if self._wire.read():
                    self._drop(renew=True)
            except OSError:
                self._drop()
        return self._wire

    def _timed(self, request: Request) -> Request:
        if self.timeout and not request.seconds:
            return request._replace(seconds=self.timeout)
        if self.framing == "ascii" and self._tuned is not None and request.seconds:
            return request._replace(seconds=request.seconds + more_in_ascii(request, self._tuned))
        return request

    def _failed(self, error: BaseException) -> LinkLost | None:
        """Clean up after a failed exchange; returns the error to raise in place of one of the system."""
        if isinstance(error, OSError) and not isinstance(error, RegscribeError):
            self._drop()
            message = f"{self.name}: the link was lost ({error}). The next request tries to open it again"
            return LinkLost(message)
        if self._tuned is None:
            self._drop(renew=True)
        return None

    def _finished(self) -> None:
        if self._talk.framing.decisive:
            self._trusted_until = time.monotonic() + TRUST_SECONDS
        if not self.opened:  # closed by another one meanwhile
            self._drop()
        elif self._talk.tainted and self._tuned is None:
            self._drop(renew=True)


class SyncTransport(_Base):
    """A `Link` for threads."""

    def __init__(self, place: Place, settings: LinkSettings) -> None:
        super().__init__(place, settings)
        self.lock = Turns()

    def open(self) -> None:
        """Open it, if it is not open; LinkLost with advice."""
        with self.lock.line:
            if self._wire is None:
                self._connect()
            self.opened = True

    def _connect(self) -> Stream:
        place = self._place
        return self._opened(open_serial(place) if isinstance(place, SerialLine) else open_tcp(*place))

    def close(self) -> None:
        """Close it, after the request that is under way; harmless if it is closed."""
        self.opened = False
        with self.lock.line:
            self._drop()

    def call(self, unit: int, request: Request) -> Reply:
        """Send one request once; see `Link.call`."""
        with self.lock.line:
            wire = self._usable(request) or self._connect()
            steps = self._talk.exchange(wire, unit, self._timed(request))
            try:
                seconds = next(steps)
                while True:
                    seconds = steps.send(wait(wire, seconds))
            except StopIteration as done:
                reply: Reply = done.value
                return reply
            except BaseException as error:
                steps.close()
                if lost := self._failed(error):
                    raise lost from error
                raise
            finally:
                self._finished()


class AsyncTransport(_Base):
    """An `AsyncLink`, for the tasks of one event loop."""

    def __init__(self, place: Place, settings: LinkSettings) -> None:
        super().__init__(place, settings)
        self.lock = AsyncTurns()

    async def open(self) -> None:
        """Open it, if it is not open; LinkLost with advice."""
        async with self.lock.line:
            if self._wire is None:
                await self._connect()
            self.opened = True

    async def _connect(self) -> Stream:
        place = self._place
        return self._opened(open_serial(place) if isinstance(place, SerialLine) else await open_tcp_async(*place))

    async def close(self) -> None:
        """Close it, after the request that is under way; harmless if it is closed."""
        self.opened = False
        async with self.lock.line:
            self._drop()

    async def call(self, unit: int, request: Request) -> Reply:
        """Send one request once; see `Link.call`."""
        async with self.lock.line:
            wire = self._usable(request) or await self._connect()
            steps = self._talk.exchange(wire, unit, self._timed(request))
            try:
                seconds = next(steps)
                while True:
                    seconds = steps.send(await wait_async(wire, seconds))
            except StopIteration as done:
                reply: Reply = done.value
                return reply
            except BaseException as error:
                steps.close()
                if lost := self._failed(error):
                    raise lost from error
                raise
            finally:
                self._finished()
