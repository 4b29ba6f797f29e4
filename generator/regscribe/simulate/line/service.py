"""The simulator's front door: choose a transport, and serve devices from asyncio."""

import asyncio
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from regscribe.model import SerialDefaults
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.line.connection import ConnectionPolicy, Patience
from regscribe.simulate.line.paced_line import PacedLineServer
from regscribe.simulate.line.serial_ports import open_pseudo_terminal, open_serial
from regscribe.simulate.line.server_context import Foreign, ServerContext, factor_of
from regscribe.simulate.line.servers import LineServer, Server, TcpServer
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.framing import ASCII, RTU, TCP

LOOPBACK = "127.0.0.1"
MOST_CONNECTIONS = 64
SERIAL_GAP = 0.1
"""Seconds of silence that end a frame on a serial line: longer than 3.5 characters, for adapters deliver in chunks."""

CLOCK_TICK = 0.25
"""Real seconds between two advances of the devices."""

MOST_BEHIND = 3600.0
"""Simulated seconds that are caught up with at once; what is beyond is left out (the computer slept)."""


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
class Service(ConnectionPolicy):
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


async def start(devices: Sequence[SimulatedDevice], service: Service) -> Server:
    """Serve `devices` until the returned server is stopped.

    Raises SimulatorError where the port is taken, the serial device cannot be opened, two devices share a unit, or the
    service asks for something impossible.
    """
    transport, speed = Transport(service.transport), _checked_speed(service.speed)
    usual = Foreign.GATEWAY if transport is Transport.TCP else Foreign.SILENCE
    line, factor = service.line or line_of(devices), factor_of(service.latency)
    station = ServerContext(devices, foreign=service.foreign or usual, line=line, factor=factor)
    if service.paced and transport is not Transport.PTY:
        message = f"only a pty can be paced, not {transport}: a serial device has its own speed, TCP has none"
        raise SimulatorError(message)
    server: TcpServer | LineServer
    if transport in _FRAMINGS:
        server = TcpServer(station, _FRAMINGS[transport], service, most=service.connections)
        await server.listen(service.host, service.port)
    else:
        policy = replace(service, patience=service.patience or Patience(idle=None, gap=SERIAL_GAP))
        opened = open_pseudo_terminal() if transport is Transport.PTY else open_serial(service.path, line)
        if service.paced:
            gap = max((each.register_map.protocol.serial.gap for each in devices), default=SerialDefaults().gap)
            silence = float(gap) * line.character
            server = PacedLineServer(opened, station, policy, serial=line, gap=silence, strict=service.strict_gaps)
        else:
            server = LineServer(opened, station, policy)
        await server.listen()
    moving = [device for device in devices if device.moves]
    if moving and speed:
        server.clock = asyncio.get_running_loop().create_task(_tick(moving, speed))
    return server


def line_of(devices: Sequence[SimulatedDevice]) -> SerialLine:
    """The line that the first device has as delivered, as far as its map says."""
    return devices[0].register_map.protocol.serial.line if devices else SerialLine()


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


def _checked_speed(speed: float) -> float:
    """The speed; SimulatorError if it is negative or not finite."""
    if not 0 <= speed < math.inf:
        message = f"speed {speed!r} is no factor of 0 or more (0: time stands still, 60: a minute a second)"
        raise SimulatorError(message)
    return speed


async def _tick(devices: Sequence[SimulatedDevice], speed: float) -> None:
    """Advance the devices with real time, or faster, until cancelled; the loop is free between two devices."""
    loop = asyncio.get_running_loop()
    before = loop.time()
    while True:
        await asyncio.sleep(CLOCK_TICK)
        now = loop.time()
        for device in devices:
            device.advance(min((now - before) * speed, MOST_BEHIND))
            await asyncio.sleep(0)
        before = now
