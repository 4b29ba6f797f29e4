"""Options of a service: transport, latency, patience, and the hooks between line and device."""

from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum

from regscribe.simulate.line.server_context import Foreign
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.framing import Frame


class Transport(StrEnum):
    """How clients reach the devices: MBAP, RTU or ASCII on TCP, RTU on a serial device or on a pty made here."""

    TCP = "tcp"
    RTU_OVER_TCP = "rtu-tcp"
    ASCII_OVER_TCP = "ascii-tcp"
    SERIAL = "serial"
    PTY = "pty"


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
class Service:
    """Where and how to serve.

    `host` and `port` (0: any free one) are for TCP, `path` for a serial device. `line` is its speed and format, and
    that of the line which a pty or TCP stands for: character times count with it (None: the first device's default).
    `latency` is `off`, `real` (the map's times by function and word), or a factor. `paced` lets the bytes on a pty
    take their time at the speed of the line, frames end by silence; with `strict_gaps`, a request that comes too soon
    after an answer is lost, too. Simulated time passes `speed` times as fast as real time for devices with a process
    (0: only by `advance`). `foreign` is what a unit that is not there gets (None: over MBAP a gateway's
    exception, elsewhere silence). `arrival` and `delivery` stand between device and line (`LineFaults` has both),
    `recorder` is told of each request to a device here, `watcher` of each exchange. `connections`: how many clients at
    once. `patience` None: 1 s for half a frame and 10 minutes for an idle client on TCP, 0.1 s and for ever on a line.
    """

    transport: Transport = Transport.TCP
    host: str = "127.0.0.1"
    port: int = 0
    path: str = ""
    line: SerialLine | None = None
    latency: float | str = "off"
    paced: bool = False
    strict_gaps: bool = False
    speed: float = 1.0
    foreign: Foreign | None = None
    connections: int = 64
    patience: Patience | None = None
    arrival: Arrival | None = None
    delivery: Delivery | None = None
    recorder: Recorder | None = None
    watcher: Watcher | None = None
