"""Links, which carry requests to units and answers back: protocols, settings, traces; nothing of pymodbus."""

from collections.abc import Callable
from typing import NamedTuple, Protocol, TypedDict

from regscribe_runtime.link.locks import AsyncTurns, Turns
from regscribe_runtime.values.serial_line import LineChange, SerialLine
from regscribe_runtime.wire.requests import Reply, Request

MODBUS_TCP_PORT = 502
SENT, RECEIVED = "sent", "received"


class Trace(NamedTuple):
    """One frame as it stood on the line, with its CRC, LRC or MBAP header.

    `seconds` is the clock's time (seconds since 1970), `direction` is sent or received, `unit` that of the request.
    Bytes that are no frame (noise, an answer cut short, a repeated one) are received too, in the pieces they came in.
    """

    seconds: float
    direction: str
    unit: int
    frame: bytes


Tracer = Callable[[Trace], None]
"""Called in the thread or task that talks, while it holds the line: it must be quick, and must not talk itself."""


class Retry(NamedTuple):
    """How often a read is sent again after NoAnswer, WrongAnswer or LinkLost, each time after `pause` seconds.

    A write is never sent again, whatever stands here: it may have been carried out although its answer was lost.
    """

    reads: int = 2
    pause: float = 0.05


class LinkSettings(TypedDict, total=False):
    """How to talk over a link.

    `framing` is tcp (MBAP), rtu or ascii, `addressing` modbus or jbus (for a unit that counts its addresses from 1).
    `timeout` in seconds overrides the response timeouts that follow from the manual; `retry` is for reads alone.
    `trace` is called with every frame. On a serial line `gap` is the silence between frames in characters, and `echo`
    whether the adapter echoes what is sent (None: find out).
    """

    framing: str
    addressing: str
    timeout: float | None
    retry: Retry | None
    trace: Tracer | None
    gap: float
    echo: bool | None


class LineSettings(LinkSettings, total=False):
    """As `LinkSettings`, with the character format of a serial line: `parity` is N, E or O."""

    data_bits: int
    parity: str
    stop_bits: int


class ClientSettings(TypedDict, total=False):
    """How to talk over a pymodbus client of one's own: `addressing`, `retry` and `gap` as in `LinkSettings`.

    Framing, timeout, speed and echo are the client's.
    """

    addressing: str
    retry: Retry | None
    gap: float


class SyncClient(Protocol):
    """A client of pymodbus for threads, connected: `ModbusTcpClient`, `ModbusSerialClient`, ..."""

    def connect(self) -> bool:
        """Connect; a driver never does."""
        raise NotImplementedError


class AsyncClient(Protocol):
    """A client of pymodbus for asyncio, connected: `AsyncModbusTcpClient`, `AsyncModbusSerialClient`, ..."""

    async def connect(self) -> bool:
        """Connect; a driver never does."""
        raise NotImplementedError


class LinkState(Protocol):
    """The settings and the state of a link, for threads or for asyncio."""

    @property
    def epoch(self) -> int:
        """How often it was opened."""
        raise NotImplementedError

    @property
    def line(self) -> SerialLine | None:
        """The serial line, None over TCP."""

    @property
    def timeout(self) -> float | None:
        """The response timeout that overrides all others, in seconds."""

    @property
    def retry(self) -> Retry:
        """Which reads are sent again."""
        raise NotImplementedError

    @property
    def addressing(self) -> str:
        """How units count their addresses: modbus from 0, jbus from 1."""
        raise NotImplementedError

    def retune(self, change: LineChange) -> None:
        """Talk at another speed, in another format or with other addresses from the next request on."""


class Link(LinkState, Protocol):
    """A synchronous link, for any number of threads.

    Requests go out one after the other, first come, first served; the lock of a unit (`link.lock.of(unit)`) is held for
    a whole operation.
    """

    @property
    def lock(self) -> Turns:
        """The locks of the line and of its units."""
        raise NotImplementedError

    def open(self) -> None:
        """Open it, if it is not open; LinkLost if that fails."""

    def close(self) -> None:
        """Close it; harmless if it is closed."""

    def call(self, unit: int, request: Request) -> Reply:
        """Send one request once and wait for its answer; NoAnswer, WrongAnswer or LinkLost.

        A link that was lost is opened again first. A write to unit 0 is a broadcast: it returns after the request's
        `seconds`, which the units have to carry it out, with a reply that no unit sent.
        """
        raise NotImplementedError


class AsyncLink(LinkState, Protocol):
    """An asyncio link, for any number of tasks of one event loop; otherwise as `Link`."""

    @property
    def lock(self) -> AsyncTurns:
        """The locks of the line and of its units."""
        raise NotImplementedError

    async def open(self) -> None:
        """Open it, if it is not open; LinkLost if that fails."""

    async def close(self) -> None:
        """Close it; harmless if it is closed."""

    async def call(self, unit: int, request: Request) -> Reply:
        """As `Link.call`; a task that is cancelled here leaves the link in order."""
        raise NotImplementedError
