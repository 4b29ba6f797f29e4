"""Every transport carries every function, for threads and for tasks."""

import asyncio
from typing import Any

import pytest

from regscribe.model import RegisterMap
from regscribe.simulate import simulate
from regscribe_devices.athena.platinum_m5000 import AsyncAthenaM5000, AthenaM5000
from regscribe_devices.athena.series_c import AsyncAthena16C, Athena16C
from regscribe_runtime import NoAnswer, Trace, WrongAnswer
from regscribe_runtime.link import connect
from regscribe_runtime.wire.requests import Request

from .conftest import FarEnd

TRANSPORTS = ["tcp", "rtu-tcp", "ascii-tcp", "pty"]


def made(cls: Any, running: Any, transport: str, **more: Any) -> Any:
    if transport == "pty":
        return cls.rtu(running.path, unit=1, baud=19200, **more)
    return cls.tcp(running.host, port=running.port, unit=1, framing=transport.removesuffix("-tcp"), **more)


@pytest.fixture(params=TRANSPORTS)
def transport(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_a_synchronous_driver_reads_writes_and_tests_the_line(athena: RegisterMap, transport: str) -> None:
    with simulate(athena, "16C", unit=1, transport=transport) as running, made(Athena16C, running, transport) as device:
        device.setpoint_ram.write(150)
        assert device.setpoint_ram.read() == 150
        assert device.loopback(0x1234) == 0x1234


def test_an_asyncio_driver_does_the_same(athena: RegisterMap, transport: str) -> None:
    async def talk(running: Any) -> tuple[float, int]:
        async with made(AsyncAthena16C, running, transport) as device:
            await device.setpoint_ram.write(150)
            return await device.setpoint_ram.read(), await device.loopback(0x1234)

    with simulate(athena, "16C", unit=1, transport=transport) as running:
        assert asyncio.run(talk(running)) == (150, 0x1234)


def test_bits_and_the_exception_status_come_over_every_transport(platinum: RegisterMap, transport: str) -> None:
    async def talk(running: Any) -> tuple[int, ...]:
        async with made(AsyncAthenaM5000, running, transport) as device:
            return await device.exception_status(), *(await device.link.call(1, Request(1, 0, 16))).words

    with simulate(platinum, "M5000", unit=1, transport=transport) as running:
        with made(AthenaM5000, running, transport) as device:
            found = (device.exception_status(), *device.link.call(1, Request(1, 0, 16)).words)
        assert found == asyncio.run(talk(running))
        assert len(found) == 17


@pytest.mark.parametrize("transport_", TRANSPORTS)
def test_jbus_addresses_are_one_higher_on_the_line_and_the_same_to_the_driver(
    platinum: RegisterMap, transport_: str
) -> None:
    traced: list[Trace] = []
    with (
        simulate(platinum, "M5000", unit=1, transport=transport_, addressing="jbus") as running,
        made(AthenaM5000, running, transport_, addressing="jbus", trace=traced.append) as device,
    ):
        device.link.call(1, Request(3, 5, 2))
        reply = device.link.call(1, Request(6, 2, 1, (0,)))
    assert reply.exception or reply.address == 2
    if transport_ == "tcp":
        assert traced[0].frame[8:12] == b"\x00\x06\x00\x02"


def test_ascii_frames_go_over_a_serial_line(far: FarEnd) -> None:
    answer = b":010302002AD0\r\n"  # LRC: 01h + 03h + 02h + 00h + 2Ah = 30h, 100h - 30h = D0h
    far.echo = lambda data: answer if data.endswith(b"\r\n") else b""
    link = connect.serial(far.path, baud=19200, framing="ascii", timeout=2, echo=False)
    link.open()
    assert link.call(1, Request(3, 0)).words == (42,)
    link.close()


@pytest.mark.parametrize("bad", [b":010302002AD1\r\n", b":010302002A\r\n", b"rubbish\r\n", b":zz0302002AD0\r\n"])
def test_an_ascii_frame_with_a_wrong_check_is_no_answer(far: FarEnd, bad: bytes) -> None:
    far.echo = lambda data: bad if data.endswith(b"\r\n") else b""
    link = connect.serial(far.path, baud=19200, framing="ascii", timeout=0.1, echo=False)
    link.open()
    with pytest.raises((WrongAnswer, NoAnswer)):
        link.call(1, Request(3, 0))
    link.close()


def test_a_strict_device_hears_every_request_because_of_the_silence(athena: RegisterMap) -> None:
    with (
        simulate(athena, "16C", unit=1, transport="pty", strict_gaps=True) as running,
        Athena16C.rtu(running.path, unit=1) as device,
    ):
        assert [device.controller_id.read() for _ in range(5)] == [1] * 5


@pytest.mark.parametrize("wrong", [{"framing": "tcp"}, {"framing": "xyz"}, {"addressing": "plc"}, {"timeout": 0}])
def test_a_setting_that_does_not_exist_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match=r"framing|addressing|timeout"):
        connect.serial("/dev/null", baud=9600, **wrong)


@pytest.mark.parametrize("kind", ["sync", "async"])
def test_a_port_that_the_system_cannot_wait_for_is_looked_at_again_and_again(athena: RegisterMap, kind: str) -> None:
    """As on Windows; here a serial port of a terminal server, which pyserial reaches by a URL."""
    with simulate(athena, "16C", unit=1, transport="rtu-tcp") as running:
        port = f"socket://{running.host}:{running.port}"

        async def talk() -> int:
            async with AsyncAthena16C.rtu(port, unit=1) as device:
                return await device.controller_id.read()

        if kind == "async":
            assert asyncio.run(talk()) == 1
        else:
            with Athena16C.rtu(port, unit=1) as device:
                assert device.controller_id.read() == 1
