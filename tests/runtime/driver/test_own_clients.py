"""Pages, units behind a gateway and registers of 32 bits with pymodbus: as a client of its own, and under a driver."""

import asyncio
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

import pytest
from pymodbus import FramerType
from pymodbus.client import AsyncModbusTcpClient, ModbusTcpClient

from regscribe.simulate import simulate
from regscribe_runtime import NotConfigured, ValueRefused

from .test_enron import MAP as ENRON
from .test_pages import MAP as PAGES
from .test_units_behind import MAP as UNITS
from .test_write_and_read import MAP as AT_ONCE

FRAMINGS = {
    "tcp": ("tcp", FramerType.SOCKET),
    "rtu": ("rtu-tcp", FramerType.RTU),
    "ascii": ("ascii-tcp", FramerType.ASCII),
}
Asked = tuple[Any, ModbusTcpClient]
"""A running simulation, and a client that nobody here wrote."""


@pytest.fixture
def asking(build: Callable[[str], Any]) -> Iterator[Callable[..., Asked]]:
    """Simulate the device of a map on TCP, and connect a client of pymodbus to it."""
    with ExitStack() as opened:

        def make(text: str, framing: str = "tcp") -> Asked:
            transport, framer = FRAMINGS[framing]
            running = opened.enter_context(simulate(build(text).map, "A", unit=1, transport=transport))
            client = ModbusTcpClient(running.host, port=running.port, framer=framer, timeout=2, retries=0)
            opened.callback(client.close)
            assert client.connect()
            return running, client

        yield make


def test_a_client_selects_a_page_and_reads_and_writes_on_it(asking: Callable[..., Asked]) -> None:
    running, client = asking(PAGES)
    running.device.poke("alpha", 2.5)
    running.device.poke("gamma", 7)

    assert client.read_holding_registers(10, device_id=1).exception_code == 2  # no page is selected
    client.write_register(2, 5, device_id=1)
    assert client.read_holding_registers(10, count=3, device_id=1).registers == [25, 0, 0]
    client.write_registers(11, [1, 4464], device_id=1)
    client.write_register(2, 6, device_id=1)
    assert client.read_holding_registers(10, device_id=1).registers == [7]
    client.write_register(10, 8, device_id=1)

    assert [running.device.peek(path) for path in ("alpha", "beta", "gamma")] == [2.5, 70000, 8]


def test_a_client_asks_the_units_behind_a_gateway(asking: Callable[..., Asked]) -> None:
    running, client = asking(UNITS)
    for path, value in {"alpha": 1, "power": -2, "flow": 4}.items():
        running.device.poke(path, value)

    found = [client.read_holding_registers(10, count=2, device_id=unit).registers for unit in (1, 3)]
    assert found == [[1, 0], [0xFFFF, 0xFFFE]]
    assert client.read_holding_registers(10, count=2, device_id=4).exception_code == 2
    client.write_registers(10, [1, 4464], device_id=3)
    client.write_register(10, 9, device_id=4)

    assert [running.device.peek(path) for path in ("alpha", "power", "flow")] == [1, 70000, 9]


def test_a_client_selects_a_page_and_reads_it_by_one_request(asking: Callable[..., Asked]) -> None:
    running, client = asking(AT_ONCE)
    running.device.poke("alpha", 2.5)
    running.device.poke("beta", 70000)

    asked = {"read_address": 10, "read_count": 3, "write_address": 2, "values": [5, 1, 4464]}
    assert client.readwrite_registers(**asked, device_id=1).registers == [25, 1, 4464]
    assert [running.device.peek(path) for path in ("bank", "row")] == [5, 70000]
    asked["values"] = [7, 1, 4464]
    assert client.readwrite_registers(**asked, device_id=1).exception_code == 2  # nothing stands on that page


@pytest.mark.parametrize("framing", ["tcp", "rtu", "ascii"])
def test_a_client_reads_four_bytes_where_it_asks_for_one_register_of_32_bits(
    asking: Callable[..., Asked], framing: str
) -> None:
    running, client = asking(ENRON, framing)
    running.device.poke("total", 70000)
    running.device.poke("rate", 1.5)
    running.device.poke("mode", 5)

    found = [client.read_holding_registers(at, device_id=1).registers for at in (5001, 7001, 3001)]
    assert found == [[1, 4464], [0x3FC0, 0], [5]]
    assert client.write_registers(5001, [0, 1], device_id=1).exception_code == 3  # it announces two, of two bytes each
    assert running.device.peek("total") == 70000


@pytest.mark.parametrize("framing", ["tcp", "rtu", "ascii"])
def test_a_driver_over_a_client_reads_and_writes_registers_of_32_bits(
    build: Callable[[str], Any], asking: Callable[..., Asked], framing: str
) -> None:
    running, client = asking(ENRON, framing)
    device = build(ENRON).driver("A").over(client, unit=1)

    device.total.write(70000)
    device.configure({"rate": 1.5, "energy": -2.5, "mode": 3})

    assert (device.total.read(), device.read()["energy"]) == (70000, -2.5)
    peek = running.device.peek
    assert [peek(path) for path in ("total", "rate", "energy", "mode")] == [70000, 1.5, -2.5, 3]


def test_an_asyncio_driver_over_a_client_does_so(build: Callable[[str], Any], asking: Callable[..., Asked]) -> None:
    running, _ = asking(ENRON)

    async def talk() -> Any:
        client = AsyncModbusTcpClient(running.host, port=running.port, timeout=2, retries=0)
        assert await client.connect()
        device = build(ENRON).module.AsyncFlowA.over(client, unit=1)
        await device.total.write(70000)
        found = await device.total.read()
        with pytest.raises(ValueRefused, match="function 06"):
            await device.alone.write(1)
        client.close()
        await asyncio.sleep(0)  # the transport closes in the next turn of the loop
        return found

    assert asyncio.run(talk()) == 70000


def test_a_register_of_32_bits_that_takes_function_6_alone_is_not_written_over_a_client(
    build: Callable[[str], Any], asking: Callable[..., Asked]
) -> None:
    running, client = asking(ENRON)
    device = build(ENRON).driver("A").over(client, unit=1)

    with pytest.raises(ValueRefused, match=r"enron 7050: .* make the driver by `tcp` or `rtu`"):
        device.alone.write(1)
    with pytest.raises(NotConfigured) as caught:
        device.configure({"total": 5, "alone": 1})

    fates = {one.register: one.fate for one in caught.value.report.changes}
    assert fates == {"total": "restored", "alone": "not written"}
    assert running.device.peek("total") == 0
    assert [pdu for pdu in running.requests if pdu[0] == 6] == []


def test_a_driver_over_a_client_selects_pages_and_asks_units(
    build: Callable[[str], Any], asking: Callable[..., Asked]
) -> None:
    for text in (PAGES, AT_ONCE):
        running, client = asking(text)
        device = build(text).driver("A").over(client, unit=1)
        device.alpha.write(2.5)
        device.gamma.write(7)
        found = device.read()
        assert (found["alpha"], found["gamma"]) == (2.5, 7)
        assert [running.device.peek(path) for path in ("alpha", "gamma")] == [2.5, 7]
    running, client = asking(UNITS)
    device = build(UNITS).driver("A").over(client, unit=1)
    device.power.write(-2)
    assert (device.power.read(), device.alpha.read(), running.device.peek("power")) == (-2, 0, -2)
