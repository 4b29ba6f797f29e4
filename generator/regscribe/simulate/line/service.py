"""The simulator's front door: choose a transport, and serve devices from asyncio."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial

from regscribe.model import SerialDefaults
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.line.connection import Arrival, ConnectionPolicy, Delivery, Patience, Recorder, Watcher
from regscribe.simulate.line.paced_line import LineTransport, PacedTransport
from regscribe.simulate.line.response_delay import Pace, factor_of
from regscribe.simulate.line.serial_ports import OpenLine, open_pseudo_terminal, open_serial
from regscribe.simulate.line.server_context import Foreign, ServerContext
from regscribe.simulate.line.servers import LineServer, Server, TcpServer, Wiring
from regscribe.simulate.process.clock import speed_of, tick
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.framing import ASCII, RTU, TCP
from regscribe_runtime.wire.server_framing import Framer, RtuFramer, SilenceFramer

LOOPBACK = "127.0.0.1"
MOST_CONNECTIONS = 64
SERIAL_GAP = 0.1
"""Seconds of silence that end a frame on a serial line: longer than 3.5 characters, for adapters deliver in chunks."""


class Transport(StrEnum):
    """How clients reach the devices: MBAP, RTU or ASCII on TCP, RTU on a serial device or on a pty made here."""

    TCP = "tcp"
    RTU_OVER_TCP = "rtu-tcp"
    ASCII_OVER_TCP = "ascii-tcp"
    SERIAL = "serial"
    PTY = "pty"


_FRAMINGS = {
    Transport.TCP: TCP,
    Transport.RTU_OVER_TCP: RTU,
    Transport.ASCII_OVER_TCP: ASCII,
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Service:
    """Where and how to serve.

    `host` and `port` (0: any free one) are for TCP, `path` for a serial device. `line` is its speed and format, and
    that of the line which a pty or TCP stands for: character times count with it (None: the first device's default).
    `latency` is `off`, `real` (the map's times by function and word), or a factor. `paced` lets the bytes on a pty
    take their time at the speed of the line, frames end by silence; with `strict_gaps`, a request that comes too soon
    after an answer is lost, too. Simulated time passes `speed` times as fast as real time for devices with a process
    (0: only by `advance`). `foreign` is what a unit that is not there gets (None: over MBAP a gateway's
    exception, elsewhere silence). `arrival` and `delivery` stand between device and line (`Faults` has both),
    `recorder` is told of each request to a device here, `watcher` of each exchange. `connections`: how many clients at
    once. `patience` None: 1 s for half a frame and 10 minutes for an idle client on TCP, 0.1 s and for ever on a line.
    """

    transport: Transport = Transport.TCP
    host: str = LOOPBACK
    port: int = 0
    path: str = ""
    line: SerialLine | None = None
    latency: float | str = "off"
    paced: bool = False
    strict_gaps: bool = False
    speed: float = 1.0
    foreign: Foreign | None = None
    connections: int = MOST_CONNECTIONS
    patience: Patience | None = None
    arrival: Arrival | None = None
    delivery: Delivery | None = None
    recorder: Recorder | None = None
    watcher: Watcher | None = None


async def start(devices: Sequence[SimulatedDevice], service: Service) -> Server:
    """Serve `devices` until the returned server is stopped.

    Raises SimulatorError where the port is taken, the serial device cannot be opened, two devices share a unit, or the
    service asks for something impossible.
    """
    transport = Transport(service.transport)
    speed_of(service.speed)
    usual = Foreign.GATEWAY if transport is Transport.TCP else Foreign.SILENCE
    station = ServerContext(devices, foreign=service.foreign or usual)
    if service.paced and transport is not Transport.PTY:
        message = f"only a pty can be paced, not {transport}: a serial device has its own speed, TCP has none"
        raise SimulatorError(message)
    server: TcpServer | LineServer
    if transport in _FRAMINGS:
        manners = _manners(devices, service, Patience())
        server = TcpServer(station, _FRAMINGS[transport], manners, most=service.connections)
        await server.listen(service.host, service.port)
    else:
        manners = _manners(devices, service, Patience(idle=None, gap=SERIAL_GAP))
        server = LineServer(_open(transport, devices, service), station, manners, *_wiring(devices, service))
    moving = [device for device in devices if device.moves]
    if moving and service.speed:
        server.accompany(tick(moving, service.speed))
    return server


def _wiring(devices: Sequence[SimulatedDevice], service: Service) -> tuple[Wiring, Framer]:
    if not service.paced:
        return LineTransport, RtuFramer()
    line = service.line or line_of(devices)
    gap = _gap(devices, line)
    return partial(PacedTransport, line=line, gap=gap, strict=service.strict_gaps), SilenceFramer()


def line_of(devices: Sequence[SimulatedDevice]) -> SerialLine:
    """The line that the first device has as delivered, as far as its map says."""
    return devices[0].register_map.protocol.serial.line if devices else SerialLine()


def _gap(devices: Sequence[SimulatedDevice], line: SerialLine) -> float:
    """Seconds of silence that separate frames: what the most demanding device here needs."""
    characters = (device.register_map.protocol.serial.gap for device in devices)
    return float(max(characters, default=SerialDefaults().gap)) * line.character


async def serve(
    devices: Sequence[SimulatedDevice],
    service: Service,
    *,
    ready: Callable[[Server], None] | None = None,
) -> None:
    """Serve `devices` until cancelled; `ready` is called once with the started server (its bound port, its path).

    Raises SimulatorError as `start` does, and when a serial device is lost.
    """
    server = await start(devices, service)
    try:
        if ready is not None:
            ready(server)
        await server.wait()
    finally:
        await server.stop()


def _manners(devices: Sequence[SimulatedDevice], service: Service, usual: Patience) -> ConnectionPolicy:
    factor, line = factor_of(service.latency), service.line or line_of(devices)
    return ConnectionPolicy(
        patience=service.patience or usual,
        pace=Pace(devices, line, factor=factor) if factor else None,
        arrival=service.arrival,
        delivery=service.delivery,
        recorder=service.recorder,
        watcher=service.watcher,
    )


def _open(transport: Transport, devices: Sequence[SimulatedDevice], service: Service) -> OpenLine:
    if transport is Transport.PTY:
        return open_pseudo_terminal()
    if not service.path:
        message = "no serial device is named: give its path, such as /dev/ttyUSB0"
        raise SimulatorError(message)
    return open_serial(service.path, service.line or line_of(devices))
