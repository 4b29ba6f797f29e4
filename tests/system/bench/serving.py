"""The simulator as a server, against pymodbus' own: requests a second from one raw client, and memory of many devices.

Each server runs in a process of its own; the client sends one frame after the other and knows the length of the answer.
"""

import contextlib
import os
import socket
import subprocess
import sys
import termios
import tty
from collections.abc import Callable, Iterator
from pathlib import Path

from measure import Row, at_least, at_most, milliseconds, paired

REQUESTS = 200
RUNS = 12
DEVICES = 1000
MOST_MEGABYTES = 64
HERE = Path(__file__).parent

OURS = """
import asyncio, sys
sys.path.insert(0, {here!r})
from synthetic import yaml_map
from regscribe import lower, source
from regscribe.simulate import Service, SimulatedDevice, Transport, serve
document, _ = source.parse(yaml_map(200), name="bench")
register_map, _ = lower.lower(document)
device = SimulatedDevice(register_map, "Unit", unit=1)
service = Service(transport=Transport({transport!r}))
asyncio.run(serve([device], service, ready=lambda server: print(server.path or server.port, flush=True)))
"""

THEIRS_TCP = """
import asyncio
from pymodbus.server import ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice
async def main():
    device = SimDevice(id=1, simdata=[SimData(address=0, count=200, values=1, datatype=DataType.REGISTERS)])
    server = ModbusTcpServer(context=device, address=("127.0.0.1", 0))
    await server.serve_forever(background=True)
    print(server.transport.sockets[0].getsockname()[1], flush=True)
    await asyncio.Event().wait()
asyncio.run(main())
"""

THEIRS_PTY = """
import asyncio, os, sys, tty
from pymodbus import FramerType
from pymodbus.server import ModbusSerialServer
from pymodbus.simulator import DataType, SimData, SimDevice
async def main():
    device = SimDevice(id=1, simdata=[SimData(address=0, count=200, values=1, datatype=DataType.REGISTERS)])
    server = ModbusSerialServer(context=device, framer=FramerType.RTU, port=sys.argv[1], baudrate=115200)
    await server.serve_forever(background=True)
    print(sys.argv[1], flush=True)
    await asyncio.Event().wait()
asyncio.run(main())
"""

MEMORY = """
import os, sys
from pathlib import Path
from regscribe.pipeline import compile_map
from regscribe.simulate import SimulatedDevice
def resident():
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
register_map = compile_map(Path({map!r})).map
SimulatedDevice(register_map, {model!r}, unit=1)
before = resident()
devices = [SimulatedDevice(register_map, {model!r}, unit=1 + number % 247) for number in range({count})]
for number, device in enumerate(devices):
    device.handle(bytes((6, 0, 6, 0, number % 100)))
    device.handle(bytes((3, 0, 0, 0, 100)))
print(resident() - before)
"""
"""Each device is written to and read, so that it has a state of its own."""


def rows() -> Iterator[Row]:
    """Requests a second over TCP and a pty, then memory."""
    with (
        _server(OURS.format(here=str(HERE), transport="tcp")) as ours,
        _server(THEIRS_TCP) as theirs,
        _tcp(ours) as mine,
        _tcp(theirs) as other,
    ):
        for count in (1, 100):
            yield _row(f"serve {count} registers over TCP (pymodbus' server)", mine, other, _mbap(count))
    master, slave = os.openpty()
    tty.setraw(master)
    with (
        _server(OURS.format(here=str(HERE), transport="pty")) as path,
        _server(THEIRS_PTY, os.ttyname(slave)),
        _line(path) as mine,
    ):
        for count in (1, 100):
            yield _row(f"serve {count} registers on a pty (pymodbus' server)", mine, _file(master), _rtu(count))
    os.close(master)
    os.close(slave)
    yield memory()


def memory() -> Row:
    """What 1,000 devices of the largest model take beyond the map."""
    root = HERE.parents[2]
    code = MEMORY.format(map=str(root / "maps/athena/platinum-x5000.yaml"), model="X5000", count=DEVICES)
    found = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)  # noqa: S603 (own code)
    megabytes = float(found.stdout)
    what = f"memory of {DEVICES:,} simulated X5000 (the budget, in MB)"
    return at_most(what, f"{megabytes:.0f} MB", f"{MOST_MEGABYTES} MB", megabytes / MOST_MEGABYTES, 1)


Exchange = Callable[[bytes, int], None]
"""Send a frame, receive that many bytes."""


def _row(what: str, mine: Exchange, other: Exchange, frame: tuple[bytes, int]) -> Row:
    def work(exchange: Exchange) -> Callable[[], None]:
        def repeat() -> None:
            for _ in range(REQUESTS):
                exchange(*frame)

        return repeat

    ours, theirs = paired(work(mine), work(other), runs=RUNS)
    return at_least(what, milliseconds(ours / REQUESTS), milliseconds(theirs / REQUESTS), theirs / ours, 1)


def _mbap(count: int) -> tuple[bytes, int]:
    return bytes((0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, count)), 9 + 2 * count


def _rtu(count: int) -> tuple[bytes, int]:
    frame = bytes((1, 3, 0, 0, 0, count))
    crc = 0xFFFF
    for byte in frame:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0xA001 if crc & 1 else 0)
    return frame + crc.to_bytes(2, "little"), 5 + 2 * count


@contextlib.contextmanager
def _server(code: str, *arguments: str) -> Iterator[str]:
    command = [sys.executable, "-c", code, *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:  # noqa: S603 (own code)
        assert process.stdout is not None
        try:
            yield process.stdout.readline().strip()
        finally:
            process.kill()


@contextlib.contextmanager
def _tcp(port: str) -> Iterator[Exchange]:
    with socket.create_connection(("127.0.0.1", int(port)), timeout=5) as link:
        link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

        def exchange(frame: bytes, length: int) -> None:
            link.sendall(frame)
            while length > 0:
                got = len(link.recv(length))
                assert got, "the server hung up"
                length -= got

        yield exchange


@contextlib.contextmanager
def _line(path: str) -> Iterator[Exchange]:
    descriptor = os.open(path, os.O_RDWR | os.O_NOCTTY)
    tty.setraw(descriptor, termios.TCSANOW)
    try:
        yield _file(descriptor)
    finally:
        os.close(descriptor)


def _file(descriptor: int) -> Exchange:
    def exchange(frame: bytes, length: int) -> None:
        os.write(descriptor, frame)
        while length > 0:
            length -= len(os.read(descriptor, length))

    return exchange
