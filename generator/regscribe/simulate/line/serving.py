"""Serves simulated devices from asyncio by the transport of a service, and moves their time."""

import asyncio
import math
from collections.abc import Callable, Sequence

from regscribe.model import SerialDefaults
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.line.paced_line import PacedLineServer
from regscribe.simulate.line.serial_ports import open_pseudo_terminal, open_serial
from regscribe.simulate.line.server_context import Foreign, ServerContext, factor_of
from regscribe.simulate.line.servers import FRAMINGS, LineServer, Server, TcpServer
from regscribe.simulate.line.service import Service, Transport
from regscribe_runtime.values.serial_line import SerialLine

CLOCK_TICK = 0.25
"""Real seconds between two advances of the devices."""

MOST_BEHIND = 3600.0
"""Simulated seconds that are caught up with at once; what is beyond is left out (the computer slept)."""


async def start(devices: Sequence[SimulatedDevice], service: Service) -> Server:
    """Serve `devices` until the returned server is stopped.

    Raises SimulatorError where the port is taken, the serial device cannot be opened, two devices share a unit, or the
    service asks for something impossible.
    """
    speed = service.speed
    if not 0 <= speed < math.inf:
        message = f"speed {speed!r} is no factor of 0 or more (0: time stands still, 60: a minute a second)"
        raise SimulatorError(message)
    server = _server(devices, service)
    await server.listen()
    moving = [device for device in devices if device.moves]
    if moving and speed:
        server.clock = asyncio.get_running_loop().create_task(_tick(moving, speed))
    return server


def _server(devices: Sequence[SimulatedDevice], service: Service) -> TcpServer | LineServer:
    transport = Transport(service.transport)
    usual = Foreign.GATEWAY if transport is Transport.TCP else Foreign.SILENCE
    line, factor = service.line or line_of(devices), factor_of(service.latency)
    station = ServerContext(devices, foreign=service.foreign or usual, line=line, factor=factor)
    if service.paced and transport is not Transport.PTY:
        message = f"only a pty can be paced, not {transport}: a serial device has its own speed, TCP has none"
        raise SimulatorError(message)
    if transport in FRAMINGS:
        return TcpServer(station, service)
    opened = open_pseudo_terminal() if transport is Transport.PTY else open_serial(service.path, line)
    if not service.paced:
        return LineServer(opened, station, service)
    gap = max((each.register_map.protocol.serial.gap for each in devices), default=SerialDefaults().gap)
    return PacedLineServer(opened, station, service, line, float(gap) * line.character)


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
