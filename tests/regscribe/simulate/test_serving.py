"""Many devices and many clients: different models on one line, a thousand in one process, nobody stops another."""

import asyncio
import contextlib
import os
import struct
import time
import tracemalloc
from pathlib import Path

from pymodbus.client import ModbusSerialClient

from regscribe.model import RegisterMap
from regscribe.simulate import (
    Exchange,
    Patience,
    Server,
    Service,
    SimulatedDevice,
    Transport,
    find_map,
    in_thread,
    start,
)
from regscribe.simulate.line.connection import MOST_WAITING, Connection
from regscribe.simulate.line.server_context import ServerContext
from regscribe_runtime.wire.server_framing import framer_for

READ = bytes.fromhex("0001 0000 0006 01 03 0002 0001")
ANSWER = 11


def test_different_models_share_one_line(furnace: RegisterMap, controller: RegisterMap) -> None:
    devices = (
        SimulatedDevice(furnace, "F1", unit=1),
        SimulatedDevice(controller, "16C", unit=2),
        SimulatedDevice(find_map("fdc/series-100"), "C91", unit=3, givens={"linear_inputs": {16}}),
    )
    with in_thread(devices, Service(transport=Transport.PTY)) as server:
        client = ModbusSerialClient(server.path, baudrate=115200, timeout=2, retries=0)
        assert client.connect()
        found = [client.read_holding_registers(2, device_id=unit).registers for unit in (1, 2)]
        program = client.read_holding_registers(71, device_id=3).registers
        client.write_register(2, 90, device_id=0, no_response_expected=True)
        assert client.read_holding_registers(2, device_id=2).registers == [90]
        client.close()
    assert (found, program) == ([[1000], [77]], [3400])
    assert devices[0].peek("setpoint_ram") == 9
    assert devices[2].peek("sp3") == 10


async def exchange(server: Server) -> bytes:
    """The answer to one read by a new client."""
    reader, writer = await asyncio.open_connection(server.host, server.port)
    writer.write(READ)
    answer = await asyncio.wait_for(reader.readexactly(ANSWER), 60)
    writer.close()
    with contextlib.suppress(OSError):
        await writer.wait_closed()
    return answer


def test_clients_that_flood_stall_or_send_rubbish_keep_nobody_from_being_served(controller: RegisterMap) -> None:
    async def slow(each: Exchange) -> bytes:
        if each.request.transaction == 7:
            await asyncio.sleep(30)
        return each.frame

    async def run() -> None:
        service = Service(delivery=slow, connections=20, patience=Patience(idle=60, gap=0.2))
        server = await start([SimulatedDevice(controller, "16C")], service)
        rude = [await asyncio.open_connection(server.host, server.port) for _ in range(12)]
        for number, (_, writer) in enumerate(rude):
            burst = (READ * 2000, os.urandom(4000), READ[:5], b"\0\7" + READ[2:])[number % 4]
            writer.write(burst)
        for _ in range(20):
            assert len(await exchange(server)) == ANSWER
        for _, writer in rude:
            writer.transport.abort()
        await server.stop()

    asyncio.run(run())


class Outlet(asyncio.Transport):
    """A client that takes nothing until it is told to."""

    def __init__(self) -> None:
        super().__init__()
        self.reading = True
        self.sent = b""

    def write(self, data: object) -> None:
        assert isinstance(data, bytes)
        self.sent += data

    def pause_reading(self) -> None:
        self.reading = False

    def resume_reading(self) -> None:
        self.reading = True

    def close(self) -> None:
        self.reading = False

    def abort(self) -> None:
        self.reading = False


def connected(device: SimulatedDevice, policy: Service) -> tuple[Connection, Outlet]:
    connection, outlet = Connection(framer_for("tcp"), ServerContext([device]), policy), Outlet()
    connection.connection_made(outlet)
    return connection, outlet


def test_a_client_that_does_not_read_is_not_read_from_until_it_does(controller: RegisterMap) -> None:
    async def run() -> None:
        connection, outlet = connected(SimulatedDevice(controller, "16C"), Service())
        connection.pause_writing()
        assert not outlet.reading
        connection.resume_writing()
        assert outlet.reading

    asyncio.run(run())


def test_a_client_with_too_many_requests_waiting_is_not_read_from_until_they_are_done(controller: RegisterMap) -> None:
    async def run() -> None:
        let_go = asyncio.Event()

        async def hold(each: Exchange) -> bytes:
            await let_go.wait()
            return each.frame

        connection, outlet = connected(SimulatedDevice(controller, "16C"), Service(delivery=hold))
        connection.data_received(READ * (MOST_WAITING - 1))
        assert outlet.reading
        connection.data_received(READ * 2)
        assert not outlet.reading
        let_go.set()
        async with asyncio.timeout(5):
            while len(outlet.sent) < (MOST_WAITING + 1) * ANSWER:  # noqa: ASYNC110 - let the tasks that are due run
                await asyncio.sleep(0)
        assert outlet.reading

    asyncio.run(run())


def test_a_server_that_stops_lets_go_of_everything(controller: RegisterMap) -> None:
    async def run() -> None:
        before = len(asyncio.all_tasks())
        server = await start([SimulatedDevice(controller, "16C")], Service())
        clients = [await asyncio.open_connection(server.host, server.port) for _ in range(5)]
        await exchange(server)
        await server.stop()
        for reader, writer in clients:
            assert await asyncio.wait_for(reader.read(), 5) == b""
            writer.close()
        assert len(asyncio.all_tasks()) == before

    descriptors = len(list(Path("/proc/self/fd").iterdir()))
    asyncio.run(run())
    assert len(list(Path("/proc/self/fd").iterdir())) <= descriptors


def test_a_thousand_devices_take_little_memory_and_time(furnace: RegisterMap) -> None:
    SimulatedDevice(furnace, "F1")
    tracemalloc.start()
    begun = time.process_time()
    devices = [SimulatedDevice(furnace, "F1", seed=number) for number in range(1000)]
    for device in devices:
        assert device.handle(struct.pack(">BHH", 6, 1, 1234)) is not None
    took, size = time.process_time() - begun, tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    assert size / len(devices) < 20_000
    assert took < 10
    assert {device.peek("setpoint_ram") for device in devices} == {devices[0].peek("setpoint")}


def test_two_hundred_devices_answer_on_ports_of_their_own(furnace: RegisterMap) -> None:
    async def run() -> None:
        devices = [SimulatedDevice(furnace, "F1") for _ in range(200)]
        for number, device in enumerate(devices):
            device.poke("scratch", number)
        servers = [await start([device], Service()) for device in devices]
        for number, server in enumerate(servers):
            reader, writer = await asyncio.open_connection(server.host, server.port)
            writer.write(bytes.fromhex("0001 0000 0006 01 03 0013 0001"))
            assert (await reader.readexactly(ANSWER))[-2:] == number.to_bytes(2, "big")
            writer.close()
        await asyncio.gather(*(server.stop() for server in servers))

    asyncio.run(run())
