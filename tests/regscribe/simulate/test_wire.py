"""Devices on real sockets and ptys, asked by pymodbus' bare clients and by raw bytes."""

import asyncio
import contextlib
import errno
import os
import socket
import struct
import time
from collections.abc import Callable, Coroutine, Iterator
from contextlib import closing, contextmanager
from typing import Any

import pytest
from pymodbus import FramerType
from pymodbus.client import AsyncModbusSerialClient, AsyncModbusTcpClient, ModbusSerialClient, ModbusTcpClient
from pymodbus.exceptions import ModbusIOException

from regscribe.model import RegisterMap
from regscribe.simulate import (
    Exchange,
    Foreign,
    Patience,
    Running,
    SerialLine,
    Server,
    Service,
    SimulatedDevice,
    SimulatorError,
    Transport,
    serve,
    simulate,
    start,
)

TRANSPORTS = ("tcp", "rtu-tcp", "ascii-tcp", "pty")
FRAMERS = {"tcp": FramerType.SOCKET, "rtu-tcp": FramerType.RTU, "ascii-tcp": FramerType.ASCII}
SyncClient = ModbusTcpClient | ModbusSerialClient
READ_PV = bytes.fromhex("0001 0000 0006 01 03 0002 0001")
PV_READ = bytes.fromhex("0001 0000 0005 01 03 02 004D")


@contextmanager
def sync_client(running: Running, transport: str, timeout: float = 2) -> Iterator[SyncClient]:
    client: SyncClient
    if transport == "pty":
        client = ModbusSerialClient(running.path, baudrate=115200, timeout=timeout, retries=0)
    else:
        framer = FRAMERS[transport]
        client = ModbusTcpClient(running.host, port=running.port, framer=framer, timeout=timeout, retries=0)
    assert client.connect()
    try:
        yield client
    finally:
        client.close()  # type: ignore[no-untyped-call]  # pymodbus left it without types


def async_client(running: Running, transport: str) -> AsyncModbusTcpClient | AsyncModbusSerialClient:
    if transport == "pty":
        return AsyncModbusSerialClient(running.path, baudrate=115200, timeout=2, retries=0)
    return AsyncModbusTcpClient(running.host, port=running.port, framer=FRAMERS[transport], timeout=2, retries=0)


@contextmanager
def raw(running: Running | Server) -> Iterator[socket.socket]:
    with closing(socket.create_connection((running.host, running.port), timeout=3)) as link:
        yield link


def receive(link: socket.socket, size: int) -> bytes:
    data = b""
    while len(data) < size and (more := link.recv(size - len(data))):
        data += more
    return data


def serving(work: Callable[[Server], Coroutine[Any, Any, None]], *devices: SimulatedDevice, **options: Any) -> None:
    async def run() -> None:
        server = await start(devices, Service(**options))
        try:
            await work(server)
        finally:
            await server.stop()

    asyncio.run(run())


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_a_sync_client_reads_writes_and_is_refused(controller: RegisterMap, transport: str) -> None:
    with simulate(controller, "16C", transport=transport) as running, sync_client(running, transport) as client:
        assert client.read_holding_registers(2, count=3).registers == [77, 65486, 9000]
        assert not client.write_registers(8004, [0, 0x437A]).isError()
        assert running.device.peek("setpoint") == 250
        assert client.write_register(4049, 23).exception_code == 3
        assert client.read_holding_registers(1).exception_code == 2
        assert client.diag_query_data(b"\xaa\xbb").message == b"\xaa\xbb"  # type: ignore[attr-defined]  # untyped answer
    assert [pdu[0] for pdu in running.requests] == [3, 16, 6, 3, 8]


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_an_async_client_gets_each_answer_to_its_own_request(controller: RegisterMap, transport: str) -> None:
    async def talk(running: Running) -> None:
        client = async_client(running, transport)
        assert await client.connect()
        answers = await asyncio.gather(*(client.read_holding_registers(address) for address in (2, 4, 4049, 2)))
        assert [answer.registers[0] for answer in answers] == [77, 9000, 3, 77]
        client.close()

    with simulate(controller, "16C", transport=transport) as running:
        asyncio.run(talk(running))


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_over_long_requests_get_no_answer_and_the_next_is_answered(controller: RegisterMap, transport: str) -> None:
    with simulate(controller, "16C", transport=transport) as running:
        with sync_client(running, transport, timeout=0.2) as client, pytest.raises(ModbusIOException):
            client.read_holding_registers(0, count=25)
        with sync_client(running, transport) as client:
            assert client.read_holding_registers(2).registers == [77]


def test_a_partial_write_answers_the_count_of_what_was_written(controller: RegisterMap) -> None:
    with simulate(controller, "16C") as running, sync_client(running, "tcp") as client:
        answer = client.write_registers(2, [100, 0, 500, 1])
        assert (answer.address, answer.count) == (2, 3)


def test_the_word_order_switches_on_the_wire(controller: RegisterMap) -> None:
    with simulate(controller, "16C") as running, sync_client(running, "tcp") as client:
        assert client.read_holding_registers(8004, count=2).registers == [0, 0x429A]
        client.write_register(4084, 0)
        assert client.read_holding_registers(8004, count=2).registers == [0x429A, 0]


def test_pipelined_requests_in_one_segment_are_all_answered_in_order(controller: RegisterMap) -> None:
    requests = [struct.pack(">HHHBBHH", tid, 0, 6, 1, 3, 2, 1) for tid in range(200)]
    with simulate(controller, "16C") as running, raw(running) as link:
        link.sendall(b"".join(requests))
        answers = receive(link, 200 * 11)
    assert answers == b"".join(struct.pack(">HHHBBBH", tid, 0, 5, 1, 3, 2, 77) for tid in range(200))


def test_a_frame_in_single_bytes_is_answered(controller: RegisterMap) -> None:
    with simulate(controller, "16C") as running, raw(running) as link:
        link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        for byte in READ_PV:
            link.sendall(bytes((byte,)))
            time.sleep(0.002)
        assert receive(link, len(PV_READ)) == PV_READ


@pytest.mark.parametrize(("gap", "pause", "kept"), [(10, 0.05, True), (0.05, 0.3, False)])
def test_on_a_line_half_a_frame_is_kept_for_a_while_only(
    controller: RegisterMap, gap: float, pause: float, *, kept: bool
) -> None:
    request, answer = bytes.fromhex("01030002000125CA"), bytes.fromhex("010302004D")

    async def talk(server: Server) -> None:
        fd = os.open(server.path, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        try:
            os.write(fd, request[:4])
            await asyncio.sleep(pause)
            os.write(fd, request[4:])
            assert (await _read_soon(fd))[:5] == (answer if kept else b"")
            await asyncio.sleep(pause)
            os.write(fd, request)
            assert (await _read_soon(fd))[:5] == answer
        finally:
            os.close(fd)

    serving(talk, SimulatedDevice(controller, "16C"), transport=Transport.PTY, patience=Patience(idle=None, gap=gap))


async def _read_soon(fd: int) -> bytes:
    for _ in range(40):
        await asyncio.sleep(0.01)
        with contextlib.suppress(BlockingIOError):
            return os.read(fd, 100)
    return b""


@pytest.mark.parametrize("transport", ["rtu-tcp", "ascii-tcp", "pty"])
def test_a_foreign_unit_gets_silence_on_a_line(controller: RegisterMap, transport: str) -> None:
    with simulate(controller, "16C", unit=7, transport=transport) as running:
        with sync_client(running, transport, timeout=0.2) as client, pytest.raises(ModbusIOException):
            client.read_holding_registers(2, device_id=8)
        with sync_client(running, transport) as client:
            assert client.read_holding_registers(2, device_id=7).registers == [77]
    assert len(running.requests) == 1


def test_a_foreign_unit_gets_a_gateway_exception_or_silence_over_mbap(controller: RegisterMap) -> None:
    with simulate(controller, "16C", unit=7) as running, sync_client(running, "tcp") as client:
        assert client.read_holding_registers(2, device_id=8).exception_code == 0x0B
    with (
        simulate(controller, "16C", unit=7, foreign=Foreign.SILENCE) as running,
        sync_client(running, "tcp", timeout=0.2) as client,
        pytest.raises(ModbusIOException),
    ):
        client.read_holding_registers(2, device_id=8)


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_a_broadcast_is_written_and_not_answered(controller: RegisterMap, transport: str) -> None:
    with simulate(controller, "16C", transport=transport) as running, sync_client(running, transport) as client:
        client.write_register(2, 55, device_id=0, no_response_expected=True)
        assert client.read_holding_registers(2).registers == [55]


def test_a_broadcast_that_the_device_does_not_know_changes_nothing(bit_device: RegisterMap) -> None:
    with simulate(bit_device, "IO") as running, sync_client(running, "tcp") as client:
        client.write_register(40, 55, device_id=0, no_response_expected=True)
        assert client.read_holding_registers(40).registers == [0]


def test_units_on_one_line_are_apart_but_for_a_broadcast(controller: RegisterMap) -> None:
    devices = [SimulatedDevice(controller, "16C", unit=unit) for unit in (1, 2)]

    async def talk(server: Server) -> None:
        client = AsyncModbusTcpClient(server.host, port=server.port, timeout=2, retries=0)
        await client.connect()
        await client.write_register(2, 10, device_id=2)
        assert [device.peek("setpoint") for device in devices] == [77, 10]
        await client.write_register(2, 20, device_id=0, no_response_expected=True)
        await client.read_holding_registers(2, device_id=1)
        assert [device.peek("setpoint") for device in devices] == [20, 20]
        client.close()

    serving(talk, *devices)


def test_a_delivery_may_delay_change_or_drop_what_is_sent(controller: RegisterMap) -> None:
    seen: list[Exchange] = []

    async def third_only(exchange: Exchange) -> bytes:
        seen.append(exchange)
        await asyncio.sleep(0.01)
        return exchange.frame * 2 if len(seen) == 3 else b""

    with simulate(controller, "16C", delivery=third_only) as running, raw(running) as link:
        link.sendall(READ_PV * 3)
        assert receive(link, 2 * len(PV_READ)) == PV_READ * 2
    assert [exchange.answer for exchange in seen] == [PV_READ[7:]] * 3


def test_a_port_in_use_is_one_clear_message(controller: RegisterMap) -> None:
    async def again(server: Server) -> None:
        with pytest.raises(SimulatorError, match=f"cannot listen on 127.0.0.1 port {server.port}: .*Choose another"):
            await start([SimulatedDevice(controller, "16C")], Service(port=server.port))

    serving(again, SimulatedDevice(controller, "16C"))


@pytest.mark.parametrize("port", [-1, 65536])
def test_an_impossible_port_is_one_clear_message(controller: RegisterMap, port: int) -> None:
    with pytest.raises(SimulatorError, match=f"port {port}"):
        asyncio.run(start([SimulatedDevice(controller, "16C")], Service(port=port)))


@pytest.mark.parametrize("path", ["", "/nonexistent/ttyUSB0"])
def test_an_absent_serial_device_is_one_clear_message(controller: RegisterMap, path: str) -> None:
    with pytest.raises(SimulatorError, match="serial device"):
        asyncio.run(start([SimulatedDevice(controller, "16C")], Service(transport=Transport.SERIAL, path=path)))


def test_an_impossible_character_format_is_one_clear_message(controller: RegisterMap) -> None:
    service = Service(transport=Transport.SERIAL, path="/dev/null", line=SerialLine(data_bits=9))
    with pytest.raises(SimulatorError, match="cannot open serial device '/dev/null' with 9600 baud 9N1: character"):
        asyncio.run(start([SimulatedDevice(controller, "16C")], service))


def test_two_devices_of_one_unit_are_one_clear_message(controller: RegisterMap) -> None:
    devices = [SimulatedDevice(controller, "16C"), SimulatedDevice(controller, "25C")]
    with pytest.raises(SimulatorError, match="two simulated devices have unit 1"):
        asyncio.run(start(devices, Service()))


def test_a_serial_device_is_served_until_it_is_gone(controller: RegisterMap) -> None:
    master, slave = os.openpty()
    lost: list[str] = []

    async def run() -> None:
        device = SimulatedDevice(controller, "16C")
        service = Service(transport=Transport.SERIAL, path=os.ttyname(slave))
        started = asyncio.Event()
        task = asyncio.create_task(serve([device], service, ready=lambda _: started.set()))
        await started.wait()
        os.write(master, bytes.fromhex("01030002000125CA"))
        await asyncio.sleep(0.1)
        assert os.read(master, 100)[:5] == bytes.fromhex("010302004D")
        os.close(slave)
        os.close(master)
        with pytest.raises(SimulatorError, match="is gone") as error:
            await asyncio.wait_for(task, 5)
        lost.append(str(error.value))

    asyncio.run(run())
    assert lost


def test_an_adapter_that_is_pulled_out_is_told_once_and_not_logged(
    controller: RegisterMap, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    read = os.read

    async def run() -> None:
        server = await start([SimulatedDevice(controller, "16C")], Service(transport=Transport.PTY))
        client = os.open(server.path, os.O_RDWR | os.O_NOCTTY)

        def pulled_out(descriptor: int, most: int) -> bytes:
            if os.isatty(descriptor):
                raise OSError(errno.ENXIO, os.strerror(errno.ENXIO))
            return read(descriptor, most)

        with monkeypatch.context() as patch:
            patch.setattr(os, "read", pulled_out)
            os.write(client, READ_PV)
            with pytest.raises(SimulatorError, match=r"is gone: .*No such device"):
                await asyncio.wait_for(server.wait(), 5)
        os.close(client)
        await server.stop()

    asyncio.run(run())
    assert caplog.records == []


def test_an_idle_client_is_disconnected_and_an_active_one_stays(controller: RegisterMap) -> None:
    async def wait(server: Server) -> None:
        silent, unused = await asyncio.open_connection(server.host, server.port)
        active, writer = await asyncio.open_connection(server.host, server.port)
        for _ in range(5):
            writer.write(READ_PV)
            assert await active.readexactly(len(PV_READ)) == PV_READ
            await asyncio.sleep(0.08)
        assert await asyncio.wait_for(silent.read(), 1) == b""
        for each in (unused, writer):
            each.close()

    serving(wait, SimulatedDevice(controller, "16C"), patience=Patience(idle=0.25))


def test_one_client_too_many_costs_the_most_silent_one_its_place(controller: RegisterMap) -> None:
    async def crowd(server: Server) -> None:
        clients = [await asyncio.open_connection(server.host, server.port) for _ in range(2)]
        for reader, writer in clients[::-1]:
            writer.write(READ_PV)
            assert await reader.readexactly(len(PV_READ)) == PV_READ
        clients.append(await asyncio.open_connection(server.host, server.port))
        clients[2][1].write(READ_PV)
        assert await clients[2][0].readexactly(len(PV_READ)) == PV_READ
        assert await asyncio.wait_for(clients[1][0].read(), 1) == b""
        clients[0][1].write(READ_PV)
        assert await clients[0][0].readexactly(len(PV_READ)) == PV_READ
        for _, writer in clients:
            writer.close()

    serving(crowd, SimulatedDevice(controller, "16C"), connections=2)


def test_clients_that_flood_or_never_read_do_not_stop_the_others(controller: RegisterMap) -> None:
    with simulate(controller, "16C") as running, raw(running) as flood, sync_client(running, "tcp", 60) as client:
        flood.settimeout(0)
        for _ in range(200):
            try:
                flood.send(READ_PV * 1000)
            except BlockingIOError:
                break
        assert client.read_holding_registers(2).registers == [77]


def test_stopping_disconnects_and_frees_the_port(controller: RegisterMap) -> None:
    with simulate(controller, "16C") as running, raw(running) as link:
        link.sendall(READ_PV)
        receive(link, len(PV_READ))
    with pytest.raises(OSError, match="refused"):
        socket.create_connection((running.host, running.port), timeout=1)
