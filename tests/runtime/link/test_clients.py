"""A driver over a pymodbus client of one's own: as over our links, and the client stays its owner's."""

import asyncio
import inspect
import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from pymodbus import FramerType
from pymodbus import client as clients

from regscribe.model import RegisterMap
from regscribe.simulate import SimulatedDevice, simulate
from regscribe_devices.athena.platinum_m5000 import AsyncAthenaM5000, AthenaM5000
from regscribe_devices.athena.series_c import AsyncAthena16C, Athena16C, OutputAction
from regscribe_devices.fdc.series_100 import FdcBTC9100
from regscribe_runtime import AsyncBus, Bus, ExceptionAnswer, LinkLost, NoAnswer, NotWritten, Retry, WrongAnswer
from regscribe_runtime.link import connect
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.wire.requests import Request, verify

from .conftest import FarEnd, serving, sound
from .test_late import value_of

READ, OTHER, WRITE = Request(3, 28), Request(3, 29), Request(6, 28, 1, (7,))
TRANSPORTS = {"tcp": FramerType.SOCKET, "rtu-tcp": FramerType.RTU, "ascii-tcp": FramerType.ASCII, "pty": FramerType.RTU}
CLOSE = b""


class Owner:
    """Who has a client, and drivers over it: `run` is the value, or what is awaited of it."""

    def __init__(self, kind: str, made: Callable[[Any], Any]) -> None:
        self.runner = asyncio.Runner() if kind == "async" else None
        self.client = self.run(self._made(made)) if self.runner else made(clients)
        assert self.run(self.client.connect())

    async def _made(self, made: Callable[[Any], Any]) -> Any:  # an asyncio client is made where its loop runs
        return made(clients)

    def run(self, value: Any) -> Any:
        return self.runner.run(value) if self.runner and inspect.isawaitable(value) else value

    def link(self, **settings: Any) -> Any:
        return (connect.async_over if self.runner else connect.over)(self.client, **settings)

    def driver(self, cls: str = "Athena16C", **settings: Any) -> Any:
        kinds = {"Athena16C": (Athena16C, AsyncAthena16C), "AthenaM5000": (AthenaM5000, AsyncAthenaM5000)}
        made: Any = kinds[cls][self.runner is not None]
        return made.over(self.client, **{"unit": 1, **settings})

    def reconnected(self) -> None:
        """Let an asyncio client open its connection again; a synchronous one does so when it is used."""

        async def wait() -> None:
            while not self.client.connected:  # noqa: ASYNC110 (nothing tells of it)
                await asyncio.sleep(0.01)

        if self.runner:
            self.runner.run(wait())

    def own_read(self, address: int = 28) -> Any:
        return self.run(self.client.read_holding_registers(address, device_id=1)).registers


@pytest.fixture(params=["sync", "async"])
def owning(request: pytest.FixtureRequest) -> Iterator[Callable[..., Owner]]:
    """Make an owner of a client of either kind, connected to a port (a number) or a pty (a path)."""
    owners: list[Owner] = []
    prefix = "Async" if request.param == "async" else ""

    def make(place: Any, transport: str = "tcp", **settings: Any) -> Owner:
        settings = {"timeout": 2, "framer": TRANSPORTS[transport], **settings}

        def made(module: Any) -> Any:
            if transport == "pty":
                return getattr(module, f"{prefix}ModbusSerialClient")(place, baudrate=19200, **settings)
            return getattr(module, f"{prefix}ModbusTcpClient")("127.0.0.1", port=place, **settings)

        owners.append(Owner(request.param, made))
        return owners[-1]

    yield make
    for owner in owners:
        owner.run(_closed(owner.client) if owner.runner else owner.client.close())
        if owner.runner:
            owner.runner.close()


async def _closed(client: Any) -> None:
    client.close()
    await asyncio.sleep(0)


class Server:
    """A TCP server of MBAP or RTU frames; `answer` says what comes for a PDU, after so many seconds, None: nothing."""

    def __init__(self, *, rtu: bool = False) -> None:
        self.listening = socket.create_server(("127.0.0.1", 0))
        self.port = self.listening.getsockname()[1]
        self.answer: Callable[[bytes], tuple[float, bytes] | None] = lambda _: None
        self.heard: list[bytes] = []
        self.rtu = rtu
        self.threads = [threading.Thread(target=self._serve, daemon=True)]
        self.threads[0].start()

    def _serve(self) -> None:
        while True:
            try:
                connection, _ = self.listening.accept()
            except OSError:
                return
            self.threads.append(threading.Thread(target=self._attend, args=(connection,), daemon=True))
            self.threads[-1].start()

    def _attend(self, connection: socket.socket) -> None:
        with connection:
            data = b""
            while came := connection.recv(1000):
                data += came
                if not (sound(data) if self.rtu else len(data) > 7 and len(data) == 6 + data[5]):
                    continue
                request, data = data, b""
                said = request if self.rtu else request[7:]
                self.heard.append(said)
                found = self.answer(said)
                if found is not None and found[1] == CLOSE:
                    return
                if found is not None:
                    head = b"" if self.rtu else request[:4] + (len(found[1]) + 1).to_bytes(2, "big") + request[6:7]
                    threading.Timer(found[0], self._sent, (connection, head + found[1])).start()

    def _sent(self, connection: socket.socket, data: bytes) -> None:
        try:
            connection.sendall(data)
        except OSError:
            return

    def stop(self) -> None:
        self.listening.shutdown(socket.SHUT_RDWR)
        self.listening.close()


@contextmanager
def server(**how: Any) -> Iterator[Server]:
    made = Server(**how)
    try:
        yield made
    finally:
        made.stop()


def place(running: Any, transport: str) -> Any:
    return running.path if transport == "pty" else running.port


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_a_driver_reads_writes_and_tests_the_line(athena: RegisterMap, owning: Any, transport: str) -> None:
    with simulate(athena, "16C", unit=1, transport=transport) as running:
        owner = owning(place(running, transport), transport)
        device = owner.driver()
        owner.run(device.setpoint_ram.write(150))
        assert owner.run(device.setpoint_ram.read()) == 150
        assert owner.run(device.loopback(0x1234)) == 0x1234
        assert owner.client.connected


@pytest.mark.parametrize("transport", TRANSPORTS)
def test_bits_and_the_exception_status_come_too(platinum: RegisterMap, owning: Any, transport: str) -> None:
    with simulate(platinum, "M5000", unit=1, transport=transport) as running:
        owner = owning(place(running, transport), transport)
        device = owner.driver("AthenaM5000")
        assert 0 <= owner.run(device.exception_status()) <= 255
        for quantity in (1, 7, 16):
            assert len(owner.run(device.link.call(1, Request(1, 0, quantity))).words) == quantity


@pytest.mark.parametrize("transport", ["tcp", "pty"])
def test_jbus_addresses_are_one_higher_on_the_line(platinum: RegisterMap, owning: Any, transport: str) -> None:
    with simulate(platinum, "M5000", unit=1, transport=transport, addressing="jbus") as running:
        owner = owning(place(running, transport), transport)
        device = owner.driver("AthenaM5000", addressing="jbus")
        assert len(owner.run(device.link.call(1, Request(3, 5, 2))).words) == 2
        reply = owner.run(device.link.call(1, Request(6, 2, 1, (0,))))
        assert reply.exception or reply.address == 2


def test_closing_a_driver_leaves_the_client_to_its_owner(athena: RegisterMap, owning: Any) -> None:
    with simulate(athena, "16C", unit=1) as running:
        owner = owning(running.port)
        device = owner.driver()
        owner.run(device.open())
        value = owner.run(device.controller_id.read())
        owner.run(device.close())
        assert owner.client.connected
        assert owner.own_read()
        assert owner.run(device.controller_id.read()) == value


def test_two_units_are_driven_over_one_client(units: list[SimulatedDevice], owning: Any) -> None:
    with serving(units) as running:
        owner = owning(running.port)
        first, second = owner.driver(), owner.driver(unit=2)
        owner.run(first.setpoint_ram.write(100))
        owner.run(second.setpoint_ram.write(200))
        assert (owner.run(first.setpoint_ram.read()), owner.run(second.setpoint_ram.read())) == (100, 200)


def test_a_bus_broadcasts_over_a_client(units: list[SimulatedDevice], owning: Any) -> None:
    with serving(units) as running:
        owner = owning(running.port)
        bus: Any = (AsyncBus if owner.runner else Bus).over(owner.client)
        ovens = [bus.device(type(owner.driver()), unit=unit) for unit in (1, 2, 3)]
        owner.run(bus.broadcast(type(ovens[0]).output_1_low_limit, 20, state={"output_1_high_limit": 100}))
        assert [owner.run(oven.output_1_low_limit.read()) for oven in ovens] == [20, 20, 20]


def reading_ones(far: Server, write: bytes | None = None) -> None:
    """Let a server answer reads with ones, and writes with an exception or (None) not at all."""

    def answer(pdu: bytes) -> tuple[float, bytes] | None:
        if pdu[0] == 3:
            return 0, bytes([3, 2 * pdu[4]]) + b"\0\1" * pdu[4]
        return None if write is None else (0, bytes([pdu[0] | 0x80]) + write)

    far.answer = answer


def test_a_refused_write_has_its_code(owning: Any) -> None:
    with server() as far:
        reading_ones(far, write=b"\3")
        owner = owning(far.port)
        with pytest.raises(ExceptionAnswer) as caught:
            owner.run(owner.driver().output_1_action.write(OutputAction.REVERSE))
        assert (caught.value.code, caught.value.address) == (3, 4051)


@pytest.mark.parametrize("retries", [0, 3])
def test_a_request_is_sent_once_when_no_answer_comes(owning: Any, retries: int) -> None:
    with server() as far:
        owner = owning(far.port, timeout=0.4, retries=retries)
        link = owner.link()
        for request in (WRITE, READ):
            with pytest.raises(NoAnswer, match=r"unit 1 gave no answer .* in 0.4 s"):
                owner.run(link.call(1, request))
        assert [pdu[0] for pdu in far.heard] == [6, 3]
        far.answer = lambda pdu: (0, value_of(b"\1" + pdu)[1:-2])
        assert owner.own_read() == [28]


def test_a_write_without_an_answer_is_decided_by_reading_back(owning: Any) -> None:
    with server() as far:
        reading_ones(far)
        owner = owning(far.port, timeout=0.5)
        with pytest.raises(NotWritten):
            owner.run(owner.driver().output_1_action.write(OutputAction.REVERSE))
        assert [pdu[0] for pdu in far.heard if pdu[0] != 3] == [6]


def test_a_read_is_tried_again_as_the_driver_says(owning: Any) -> None:
    with server() as far:
        owner = owning(far.port, timeout=0.1, retries=3)
        with pytest.raises(NoAnswer):
            owner.run(owner.driver(retry=Retry(reads=1, pause=0)).output_1_action.read())
        assert len(far.heard) == 2


@pytest.mark.parametrize(
    ("request_", "answer"),
    [
        (READ, b"\x04\x02\x00\x07"),
        (READ, b"\x03\x04\x00\x07\x00\x08"),
        (WRITE, b"\x06\x00\x1d\x00\x07"),
        (WRITE, b"\x06\x00\x1c\x00\x08"),
        (Request(16, 28, 2, (1, 2)), b"\x10\x00\x1c\x00\x03"),
        (Request(1, 0, 9), b"\x01\x01\x00"),
        (Request(8, 0, 1, (7,)), b"\x08\x00\x00\x00\x08"),
    ],
    ids=["function", "length", "address", "echo", "count", "bits", "loopback"],
)
def test_an_answer_that_does_not_fit_is_wrong(owning: Any, request_: Request, answer: bytes) -> None:
    with server() as far:
        far.answer = lambda _: (0, answer)
        owner = owning(far.port)
        reply = owner.run(owner.link().call(1, request_))
        with pytest.raises(WrongAnswer):
            verify(request_, reply, unit=1, protocol=Protocol())


def test_an_answer_that_nobody_can_read_is_an_error_of_ours(owning: Any) -> None:
    with server() as far:
        far.answer = lambda _: (0, b"\x03\x09\x00")
        owner = owning(far.port, timeout=0.3)
        with pytest.raises((WrongAnswer, NoAnswer, LinkLost)):
            owner.run(owner.link().call(1, READ))


def test_a_connection_that_breaks_is_lost_and_the_next_one_is_known_as_another(owning: Any) -> None:
    with server() as far:
        owner = owning(far.port, timeout=0.5)
        link = owner.link()
        far.answer = lambda pdu: (0, value_of(b"\1" + pdu)[1:-2])
        assert owner.run(link.call(1, READ)).words == (28,)
        before = link.epoch
        far.answer = lambda _: (0, CLOSE)
        with pytest.raises(LinkLost):
            owner.run(link.call(1, WRITE))
        assert [pdu[0] for pdu in far.heard] == [3, 6]
        far.answer = lambda pdu: (0, value_of(b"\1" + pdu)[1:-2])
        owner.reconnected()
        assert owner.run(link.call(1, READ)).words == (28,)
        assert link.epoch == before + 1


def test_a_client_that_is_not_connected_is_not_opened(owning: Any) -> None:
    with server() as far:
        owner = owning(far.port)
        owner.run(_closed(owner.client) if owner.runner else owner.client.close())
        with pytest.raises(LinkLost, match="is not connected: connect it before"):
            owner.run(owner.driver().open())
        assert not owner.client.connected


@pytest.mark.parametrize("transport", ["tcp", "rtu-tcp"])
def test_a_late_answer_is_not_taken_for_the_next(owning: Any, transport: str) -> None:
    with server(rtu=transport != "tcp") as far:

        def answer(said: bytes) -> tuple[float, bytes]:
            whole = value_of(said if far.rtu else b"\1" + said)
            return 0.9 if len(far.heard) == 1 else 0.3, whole if far.rtu else whole[1:-2]

        far.answer = answer
        owner = owning(far.port, transport, timeout=0.7)
        link = owner.link()
        with pytest.raises(NoAnswer):
            owner.run(link.call(1, READ))
        assert owner.run(link.call(1, OTHER)).words == (29,)
        assert owner.run(link.call(1, READ)).words == (28,)


def test_a_late_answer_on_a_serial_line_is_not_taken_for_the_next(far: FarEnd, owning: Any) -> None:
    far.plan = lambda request: [(0.9 if len(far.heard) == 1 else 0.3, value_of(request))]
    owner = owning(far.path, "pty", timeout=0.7)
    link = owner.link()
    with pytest.raises(NoAnswer):
        owner.run(link.call(1, READ))
    assert owner.run(link.call(1, OTHER)).words == (29,)


def test_a_cancelled_task_is_cancelled_and_leaves_the_client_in_order() -> None:
    async def talk(port: int) -> tuple[int, ...]:
        async with clients.AsyncModbusTcpClient("127.0.0.1", port=port, timeout=30) as client:
            link = connect.async_over(client)
            with pytest.raises(TimeoutError):
                async with asyncio.timeout(0.2):
                    await link.call(1, READ)
            return (await link.call(1, OTHER)).words

    with server() as far:
        far.answer = lambda pdu: (0, value_of(b"\1" + pdu)[1:-2]) if len(far.heard) > 1 else None
        assert asyncio.run(talk(far.port)) == (29,)


def test_threads_share_a_client_with_its_owner(units: list[SimulatedDevice]) -> None:
    wrong: list[object] = []
    with serving(units) as running, clients.ModbusTcpClient("127.0.0.1", port=running.port) as client:

        def poll(read: Callable[[], object], expected: object) -> None:
            wrong.extend(value for _ in range(50) if (value := read()) != expected)

        devices = [Athena16C.over(client, unit=unit) for unit in (1, 2, 3)]
        reads: list[tuple[Callable[[], object], object]] = [
            (one.controller_id.read, n) for n, one in enumerate(devices, 1)
        ]
        own = devices[0].link.call(1, READ).words
        reads.append((lambda: tuple(client.read_holding_registers(28, device_id=1).registers), own))
        threads = [threading.Thread(target=poll, args=one) for one in reads]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert wrong == []


def test_the_wrong_kind_of_client_is_refused_with_the_right_one() -> None:
    sync: Any = clients.ModbusTcpClient("127.0.0.1")

    async def other() -> Any:
        return clients.AsyncModbusTcpClient("127.0.0.1")

    with pytest.raises(TypeError, match=r"an asyncio client .* ModbusTcpClient is the other kind: asyncio drivers"):
        AsyncAthena16C.over(sync, unit=1)
    with pytest.raises(TypeError, match=r"a synchronous client .* AsyncModbusTcpClient is the other kind"):
        Athena16C.over(asyncio.run(other()), unit=1)
    nothing: Any = "127.0.0.1"
    with pytest.raises(TypeError, match="str is no client of pymodbus"):
        Athena16C.over(nothing, unit=1)


def test_a_driver_with_givens_takes_a_client_too() -> None:
    device = FdcBTC9100.over(clients.ModbusTcpClient("127.0.0.1", timeout=4), unit=1, linear_inputs={16})
    assert (device.session.givens["linear_inputs"], device.link.timeout, device.link.line) == ({16}, 4.0, None)


def test_a_serial_client_tells_its_line_and_the_silence_of_the_manual_is_kept() -> None:
    device = Athena16C.over(clients.ModbusSerialClient("/dev/null", baudrate=4800, parity="E"), unit=1)
    assert device.link.line is not None
    assert (device.link.line.baud, device.link.line.format) == (4800, "8E1")


def test_an_addressing_that_does_not_exist_is_refused() -> None:
    with pytest.raises(ValueError, match="addressing 'plc' is none of modbus, jbus"):
        Athena16C.over(clients.ModbusTcpClient("127.0.0.1"), unit=1, addressing="plc")
