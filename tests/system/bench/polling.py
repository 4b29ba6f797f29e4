"""What a driver costs over the bare pymodbus client, 1 and 100 registers, both kinds of it; and a plant of 100 devices.

Both sides talk to the same simulated device, which runs in a process of its own.
"""

import asyncio
import contextlib
import subprocess
import sys
import time
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from measure import Row, at_most, milliseconds
from pymodbus.client import AsyncModbusSerialClient, AsyncModbusTcpClient, ModbusSerialClient, ModbusTcpClient

from regscribe_runtime import AsyncBus, AsyncDevice, Device, ReadOnly, WireType, integer, word

READS = 100
RUNS = 25
COUNT = 100
BAUD = 115_200
NO_SILENCE = 0.0
"""The silence of 1.75 ms that the standard wants between frames is left out here: pymodbus keeps none."""
BUSES, UNITS, ROUNDS = 10, 10, 20
HERE = Path(__file__).parent
SINGLE, BLOCK = 1.15, 2.0
"""Budgets: of one register (design 10), and of a block, whose 100 values are decoded besides."""

SERVE = """
import asyncio, sys
sys.path.insert(0, {here!r})
from synthetic import yaml_map
from regscribe import lower, source
from regscribe.simulate import Service, SimulatedDevice, Transport, start
document, _ = source.parse(yaml_map(200), name="bench")
register_map, _ = lower.lower(document)
async def main():
    servers = []
    for _ in range({buses}):
        devices = [SimulatedDevice(register_map, "Unit", unit=1 + number) for number in range({units})]
        servers.append(await start(devices, Service(transport=Transport({transport!r}))))
    print(*(server.path or server.port for server in servers), flush=True)
    await asyncio.Event().wait()
asyncio.run(main())
"""

_REGISTERS: dict[str, Any] = {f"value_{at}": ReadOnly(at, word(WireType.INT16), integer) for at in range(COUNT)}
Hundred = type("Hundred", (Device,), dict(_REGISTERS))
AsyncHundred = type("AsyncHundred", (AsyncDevice,), dict(_REGISTERS))


class Times(NamedTuple):
    """Seconds of one read by the driver and by the bare client, the fastest of several turns."""

    ours: float
    theirs: float


def rows() -> Iterator[Row]:
    """Overheads over TCP and on a pty, then the plant."""
    with served("tcp") as (port,):
        yield from _overhead("TCP", *_tcp(int(port)))
    with served("pty") as (path,):
        yield from _overhead("a pty", *_pty(path))
    with served("tcp", buses=BUSES, units=UNITS) as ports:
        yield plant([int(port) for port in ports])


@contextlib.contextmanager
def served(transport: str, *, buses: int = 1, units: int = 1) -> Iterator[list[str]]:
    """Ports or paths of simulated lines in another process."""
    code = SERVE.format(here=str(HERE), transport=transport, buses=buses, units=units)
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:  # noqa: S603 (own code)
        assert process.stdout is not None
        try:
            yield process.stdout.readline().split()
        finally:
            process.kill()


def _tcp(port: int) -> tuple[Any, ...]:
    return (
        lambda: Hundred.tcp("127.0.0.1", port=port, unit=1),
        lambda: ModbusTcpClient("127.0.0.1", port=port, retries=0),
        lambda: AsyncHundred.tcp("127.0.0.1", port=port, unit=1),
        lambda: AsyncModbusTcpClient("127.0.0.1", port=port, retries=0),
    )


def _pty(path: str) -> tuple[Any, ...]:
    line = {"baudrate": BAUD, "retries": 0}
    return (
        lambda: Hundred.rtu(path, baud=BAUD, unit=1, gap=NO_SILENCE),
        lambda: ModbusSerialClient(path, **line),
        lambda: AsyncHundred.rtu(path, baud=BAUD, unit=1, gap=NO_SILENCE),
        lambda: AsyncModbusSerialClient(path, **line),
    )


def _overhead(where: str, driver: Any, client: Any, async_driver: Any, async_client: Any) -> Iterator[Row]:
    for count in (1, COUNT):
        yield _row(f"sync driver, {count} registers over {where} (bare client)", _sync(driver, client, count), count)
        times = asyncio.run(_async(async_driver, async_client, count))
        yield _row(f"async driver, {count} registers over {where} (bare client)", times, count)


def _row(what: str, times: Times, count: int) -> Row:
    ratio = times.ours / times.theirs
    return at_most(what, milliseconds(times.ours), milliseconds(times.theirs), ratio, SINGLE if count == 1 else BLOCK)


def _sync(driver: Any, client: Any, count: int) -> Times:
    """In turns, each with a connection of its own: a serial line has room for one."""

    def ours() -> float:
        with driver() as device:
            read = device.read if count > 1 else device.value_0.read
            return _repeated(read)

    def theirs() -> float:
        bare = client()
        bare.connect()
        try:
            return _repeated(lambda: bare.read_holding_registers(0, count=count, device_id=1).registers)
        finally:
            bare.close()

    pairs = [(ours(), theirs()) for _ in range(RUNS)]
    return Times(min(one for one, _ in pairs), min(other for _, other in pairs))


def _repeated(read: Callable[[], object]) -> float:
    read()  # the first finds out what is remembered later
    start = time.perf_counter()
    for _ in range(READS):
        read()
    return (time.perf_counter() - start) / READS


async def _async(driver: Any, client: Any, count: int) -> Times:
    async def ours() -> float:
        async with driver() as device:
            return await _awaited(device.read if count > 1 else device.value_0.read)

    async def theirs() -> float:
        bare = client()
        await bare.connect()
        try:
            return await _awaited(lambda: bare.read_holding_registers(0, count=count, device_id=1))
        finally:
            bare.close()

    pairs = [(await ours(), await theirs()) for _ in range(RUNS)]
    return Times(min(one for one, _ in pairs), min(other for _, other in pairs))


async def _awaited(read: Callable[[], Awaitable[object]]) -> float:
    await read()
    start = time.perf_counter()
    for _ in range(READS):
        await read()
    return (time.perf_counter() - start) / READS


def plant(ports: list[int]) -> Row:
    """100 devices of 100 registers on 10 buses, polled by one process: values a second, and its share of a core."""
    values, seconds, cpu = asyncio.run(_polled(ports))
    what = f"{BUSES * UNITS} devices on {BUSES} buses, one process: values/s, share of a core"
    return Row(what, f"{values / seconds:,.0f}/s", f"{100 * cpu / seconds:.0f} %", float("nan"), "-", kept=True)


async def _polled(ports: list[int]) -> tuple[int, float, float]:
    async with contextlib.AsyncExitStack() as stack:
        buses = [await stack.enter_async_context(AsyncBus.tcp("127.0.0.1", port=port)) for port in ports]
        devices: list[Any] = [bus.device(AsyncHundred, unit=unit) for bus in buses for unit in range(1, UNITS + 1)]
        await asyncio.gather(*(device.read() for device in devices))
        start, cpu = time.perf_counter(), time.process_time()
        found = await asyncio.gather(*(_rounds(device) for device in devices))
        return sum(found), time.perf_counter() - start, time.process_time() - cpu


async def _rounds(device: Any) -> int:
    return sum([len(await device.read()) for _ in range(ROUNDS)])
