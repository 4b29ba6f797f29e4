"""A link that was lost is opened again by the next request; a read survives it, a write is never sent twice."""

import asyncio
import os
import socket
import threading
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from regscribe.simulate import SimulatedDevice, simulate
from regscribe_devices.athena.series_c import AsyncAthena16C, Athena16C
from regscribe_runtime import LinkLost, NoAnswer, RegscribeError, Retry
from regscribe_runtime.link import connect
from regscribe_runtime.wire.requests import Request

from .conftest import FarEnd, serving
from .test_late import value_of

WRITE = Request(6, 28, 1, (7,))


def test_a_server_that_comes_back_is_found_again(units: list[SimulatedDevice]) -> None:
    with serving(units) as server:
        port = server.port
        device = Athena16C.tcp("127.0.0.1", port=port, unit=1)
        device.open()
        device.controller_id.read()
    with pytest.raises(LinkLost, match=r"cannot open tcp://127.0.0.1.*refuses the connection"):
        device.controller_id.read()
    with serving(units, port=port):
        assert device.controller_id.read() == 1
    device.close()


def test_an_asyncio_driver_finds_its_server_again(units: list[SimulatedDevice]) -> None:
    async def talk(device: AsyncAthena16C) -> int:
        return await device.controller_id.read()

    runner = asyncio.Runner()
    with serving(units) as server:
        port = server.port
        device = AsyncAthena16C.tcp("127.0.0.1", port=port, unit=1)
        runner.run(device.open())
        runner.run(talk(device))
    with pytest.raises(LinkLost, match="cannot open"):
        runner.run(talk(device))
    with serving(units, port=port):
        assert runner.run(talk(device)) == 1
        runner.run(device.close())
    runner.close()


def test_a_connection_that_the_server_closed_for_idleness_is_noticed_before_a_write(
    units: list[SimulatedDevice],
) -> None:
    with serving(units) as server:
        port = server.port
        link = connect.tcp("127.0.0.1", port=port)
        link.open()
        link.call(1, Request(3, 28))
    with serving(units, port=port):
        time.sleep(0.02)
        assert link.call(1, Request(6, 28, 1, (0,))).address == 28
        link.close()


def test_what_is_remembered_of_a_device_is_forgotten_with_the_link(units: list[SimulatedDevice]) -> None:
    with serving(units) as server:
        port = server.port
        device = Athena16C.tcp("127.0.0.1", port=port, unit=1)
        device.open()
        assert device.setpoint_ram.read() == 77
    units[0].poke("ieee_register_ordering", 0)
    with serving(units, port=port):
        assert device.setpoint_ram.read() == 77
    device.close()


def test_after_silence_the_device_may_be_another_one(athena: Any) -> None:
    mute = False

    async def deliver(exchange: Any) -> bytes:
        return b"" if mute else bytes(exchange.frame)

    with (
        simulate(athena, "16C", unit=1, delivery=deliver) as running,
        Athena16C.tcp(running.host, port=running.port, unit=1, timeout=0.2, retry=Retry(0)) as device,
    ):
        assert device.setpoint_ram.read() == 77
        mute = True
        with pytest.raises(NoAnswer):
            device.setpoint_ram.read()
        running.device.poke("ieee_register_ordering", 0)
        mute = False
        assert device.setpoint_ram.read() == 77


class Adapter:
    """A serial adapter that can be pulled out and put in again: a symbolic link to a pty that is there or not."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.ends: tuple[int, int] = (-1, -1)

    def put_in(self) -> FarEnd:
        self.ends = os.openpty()
        tty.setraw(self.ends[1])
        self.path.symlink_to(os.ttyname(self.ends[1]))
        return FarEnd(str(self.path), self.ends[0])

    def pull_out(self) -> None:
        for end in self.ends:
            os.close(end)
        self.path.unlink()


@contextmanager
def running(end: FarEnd) -> Iterator[FarEnd]:
    thread = threading.Thread(target=end.serve, daemon=True)
    thread.start()
    try:
        yield end
    finally:
        end._stop = True
        thread.join()


@pytest.mark.parametrize("kind", ["sync", "async"])
def test_an_adapter_that_is_pulled_out_and_put_in_again(tmp_path: Path, kind: str) -> None:
    adapter = Adapter(tmp_path / "ttyUSB0")
    make = connect.serial if kind == "sync" else connect.async_serial
    link: Any = make(str(adapter.path), baud=9600, timeout=2, echo=False)
    runner = asyncio.Runner()

    def do(result: Any) -> Any:
        return result if kind == "sync" else runner.run(result)

    with running(adapter.put_in()) as end:
        end.plan = lambda request: [(0.0, value_of(request))]
        do(link.open())
        assert do(link.call(1, Request(3, 28))).words == (28,)
    adapter.pull_out()
    with pytest.raises(LinkLost, match=r"the link was lost \(.*\). The next request tries to open it again"):
        do(link.call(1, Request(3, 28)))
    with pytest.raises(LinkLost, match=r"cannot open .*ttyUSB0: there is no such port. Plug the adapter in"):
        do(link.call(1, Request(3, 28)))
    with running(adapter.put_in()) as end:
        end.plan = lambda request: [(0.0, value_of(request))]
        assert do(link.call(1, Request(3, 28))).words == (28,)
        do(link.close())
    adapter.pull_out()
    runner.close()


def test_an_adapter_that_is_pulled_out_in_the_middle_is_one_clear_error(tmp_path: Path) -> None:
    adapter = Adapter(tmp_path / "ttyUSB0")
    end = adapter.put_in()
    link = connect.serial(str(adapter.path), baud=9600, timeout=5, echo=False)
    link.open()
    os.close(adapter.ends[1])

    threading.Timer(0.1, lambda: os.close(end.fd)).start()
    with pytest.raises(LinkLost, match="the link was lost"):  # not NoAnswer, as after the timeout
        link.call(1, Request(3, 28))
    link.close()


@pytest.mark.parametrize("framing", ["tcp", "rtu", "ascii"])
def test_a_write_whose_answer_is_lost_is_sent_once(athena: Any, framing: str) -> None:
    async def deliver(_: Any) -> bytes:
        return b""

    transport = framing if framing == "tcp" else f"{framing}-tcp"
    with simulate(athena, "16C", unit=1, transport=transport, delivery=deliver) as running:
        device = Athena16C.tcp(
            running.host, port=running.port, unit=1, framing=framing, timeout=0.1, retry=Retry(reads=3, pause=0)
        )
        with device, pytest.raises(RegscribeError):
            device.input_filter.write_raw((7,), view="base")
        assert [one for one in running.requests if one[0] in {6, 16}] == [bytes([6, 0, 30, 0, 7])]


@pytest.mark.parametrize(("lost", "asked"), [(0, 1), (1, 2), (2, 3)])
def test_a_read_is_sent_again_as_often_as_the_policy_says(athena: Any, lost: int, asked: int) -> None:
    left = iter([b""] * lost)

    async def deliver(exchange: Any) -> bytes:
        return bytes(next(left, exchange.frame))

    with (
        simulate(athena, "16C", unit=1, delivery=deliver) as running,
        Athena16C.tcp(running.host, port=running.port, unit=1, timeout=0.3, retry=Retry(2, 0)) as device,
    ):
        assert device.controller_id.read() == 1
        assert len(running.requests) == asked


def test_a_garbled_answer_to_a_read_is_asked_for_again(athena: Any) -> None:
    left = iter([b"\x01\x03\x02\x00"])

    async def deliver(exchange: Any) -> bytes:
        return bytes(next(left, exchange.frame))

    with (
        simulate(athena, "16C", unit=1, transport="rtu-tcp", delivery=deliver) as running,
        Athena16C.tcp(running.host, port=running.port, unit=1, framing="rtu", timeout=0.3) as device,
    ):
        assert device.controller_id.read() == 1
        assert len(running.requests) == 2


def test_a_device_may_have_a_policy_of_its_own(athena: Any) -> None:
    async def deliver(_: Any) -> bytes:
        return b""

    with (
        simulate(athena, "16C", unit=1, delivery=deliver) as running,
        Athena16C.tcp(running.host, port=running.port, unit=1, timeout=0.05) as device,
    ):
        device.session.retry = Retry(0)
        with pytest.raises(NoAnswer):
            device.controller_id.read()
        assert len(running.requests) == 1


def test_a_host_that_does_not_answer_fails_in_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("regscribe_runtime.link.streams.CONNECT_SECONDS", 0.1)
    with socket.socket() as full:
        full.bind(("127.0.0.1", 0))
        full.listen(0)
        waiting = [socket.socket() for _ in range(4)]
        for one in waiting:
            one.settimeout(0)
            one.connect_ex(full.getsockname())
        with pytest.raises(LinkLost, match=r"did not answer within 0.1 s. Check power"):
            connect.tcp("127.0.0.1", port=full.getsockname()[1]).open()
        for one in waiting:
            one.close()


def test_a_link_that_cannot_be_opened_is_tried_twice_however_many_times_reads_are_tried(
    monkeypatch: pytest.MonkeyPatch, units: list[SimulatedDevice]
) -> None:
    with serving(units) as server:
        device = Athena16C.tcp("127.0.0.1", port=server.port, unit=1, retry=Retry(reads=9, pause=0))
        device.open()
        device.controller_id.read()
    time.sleep(0.02)
    tried: list[int] = []

    def refuse(_: str, port: int) -> None:
        tried.append(port)
        message = "refused"
        raise LinkLost(message)

    monkeypatch.setattr("regscribe_runtime.link.transports.open_tcp", refuse)
    with pytest.raises(LinkLost, match="refused"):
        device.controller_id.read()
    device.close()
    assert len(tried) == 2


@contextmanager
def curt(heard: list[bytes]) -> Iterator[int]:
    """A server that answers one request of each connection, with words that are 0, and closes it."""
    with socket.create_server(("127.0.0.1", 0)) as server:

        def serve() -> None:
            while True:
                connection, _ = server.accept()
                with connection:
                    request = connection.recv(100)
                    if request == b"stop":
                        return
                    if request:
                        heard.append(request)
                        count = 2 * request[11]
                        data = request[6:8] + bytes([count]) + bytes(count) if request[7] == 3 else request[6:]
                        connection.sendall(request[:4] + len(data).to_bytes(2, "big") + data)

        thread = threading.Thread(target=serve)
        thread.start()
        try:
            yield server.getsockname()[1]
        finally:
            with socket.create_connection(server.getsockname()) as last:
                last.sendall(b"stop")
            thread.join()


@pytest.mark.parametrize("kind", ["sync", "async"])
def test_a_server_that_closes_after_each_answer_is_talked_to_all_the_same(kind: str) -> None:
    """Each request opens the link anew, under each operation."""

    async def talk(port: int) -> tuple[float, int]:
        async with AsyncAthena16C.tcp("127.0.0.1", port=port, unit=1) as device:
            return await device.setpoint_ram.read(), device.link.epoch

    with curt([]) as port:
        if kind == "async":
            value, opened = asyncio.run(talk(port))
        else:
            with Athena16C.tcp("127.0.0.1", port=port, unit=1) as device:
                value, opened = device.setpoint_ram.read(), device.link.epoch
    assert value == 0
    assert 2 <= opened <= 20


@pytest.mark.parametrize("kind", ["sync", "async"])
def test_a_write_to_a_connection_that_the_server_just_closed_is_sent_over_a_new_one(kind: str) -> None:
    heard: list[bytes] = []

    async def talk(port: int) -> tuple[int, ...]:
        link = connect.async_tcp("127.0.0.1", port=port)
        await link.open()
        await link.call(1, Request(3, 28))
        await asyncio.sleep(0.002)  # less than an answer is trusted for
        found = (await link.call(1, WRITE)).words
        await link.close()
        return found

    with curt(heard) as port:
        if kind == "async":
            assert asyncio.run(talk(port)) == (7,)
        else:
            link = connect.tcp("127.0.0.1", port=port)
            link.open()
            link.call(1, Request(3, 28))
            time.sleep(0.002)  # as above
            assert link.call(1, WRITE).words == (7,)
            link.close()
    assert [one[7] for one in heard] == [3, 6]
