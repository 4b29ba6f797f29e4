"""A task that is cancelled at any await leaves the bus usable, and its late answer is never another one's."""

import asyncio
import time
from typing import Any

import pytest

from regscribe.simulate import SimulatedDevice
from regscribe_devices.athena.series_c import AsyncAthena16C
from regscribe_runtime import AsyncBus, Retry
from regscribe_runtime.link import connect
from regscribe_runtime.link.streams import wait
from regscribe_runtime.wire.requests import Request

from .conftest import FarEnd, serving
from .test_late import value_of

SPREAD = [0.0, 0.001, 0.004, 0.01, 0.02, 0.03, 0.05]


async def cancelled_after(work: Any, seconds: float) -> None:
    task = asyncio.ensure_future(work)
    await asyncio.sleep(seconds)
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)


@pytest.mark.parametrize("transport", ["tcp", "rtu-tcp", "pty"])
def test_a_task_may_be_cancelled_at_any_time(units: list[SimulatedDevice], transport: str) -> None:
    async def deliver(exchange: Any) -> bytes:
        await asyncio.sleep(0.02)
        return bytes(exchange.frame)

    # over RTU on TCP the connection is closed, and a late answer could come to the next one for a second
    moments = SPREAD[::3] if transport == "rtu-tcp" else SPREAD

    async def talk(server: Any) -> list[int]:
        framing = "rtu" if transport == "rtu-tcp" else "tcp"
        made = AsyncBus.tcp(server.host, port=server.port, framing=framing)
        async with AsyncBus.rtu(server.path, baud=9600) if server.path else made as bus:
            devices = [bus.device(AsyncAthena16C, unit=unit) for unit in (1, 2)]
            found = []
            for seconds in moments:
                await cancelled_after(devices[0].setpoint_high_limit.read_raw(view="base"), seconds)
                found.append((await devices[1].setpoint_ram.read_raw(view="base"))[0])
            found.append((await devices[0].setpoint_ram.read_raw(view="base"))[0])
            return found

    for unit in units:
        unit.poke("setpoint_ram", 200 + unit.unit)
    with serving(units, transport=transport, delivery=deliver) as server:
        assert asyncio.run(talk(server)) == [202] * len(moments) + [201]


def test_a_cancelled_read_keeps_the_line_until_its_answer_came(far: FarEnd) -> None:
    far.plan = lambda request: [(0.15, value_of(request))]

    async def talk() -> tuple[int, ...]:
        link = connect.async_serial(far.path, baud=115200, timeout=2, echo=False, retry=Retry(0))
        await link.open()
        await cancelled_after(link.call(1, Request(3, 28)), 0.05)
        found = (await link.call(2, Request(3, 29))).words
        await link.close()
        return found

    assert asyncio.run(talk()) == (29,)
    assert far.times[1] - far.times[0] >= 0.14


def test_a_task_that_waits_for_its_turn_may_be_cancelled(far: FarEnd) -> None:
    far.plan = lambda request: [(0.05, value_of(request))]

    async def talk() -> list[tuple[int, ...]]:
        link = connect.async_serial(far.path, baud=115200, timeout=2, echo=False)
        await link.open()
        first, second, third = (asyncio.ensure_future(link.call(1, Request(3, at))) for at in (28, 29, 30))
        await asyncio.sleep(0.01)
        second.cancel()
        found = [(await first).words, (await third).words]
        await link.close()
        return found

    assert asyncio.run(talk()) == [(28,), (30,)]
    assert len(far.heard) == 2


def test_nothing_stays_behind(units: list[SimulatedDevice], open_descriptors: Any) -> None:
    async def talk(server: Any) -> None:
        bus = AsyncBus.tcp(server.host, port=server.port)
        await bus.open()
        device = bus.device(AsyncAthena16C, unit=1)
        for seconds in SPREAD:
            await cancelled_after(device.controller_id.read(), seconds / 10)
        await bus.close()
        assert len(asyncio.all_tasks()) == 1

    with serving(units) as server:
        asyncio.run(talk(server))
        before = open_descriptors()
        for _ in range(3):
            asyncio.run(talk(server))
        for _ in range(200):  # the server, which is in this process too, notices in its own time
            if open_descriptors() <= before:
                break
            time.sleep(0.05)
        assert open_descriptors() <= before


def test_closing_while_a_request_is_under_way_waits_for_its_end(far: FarEnd) -> None:
    far.plan = lambda request: [(0.1, value_of(request))]

    async def talk() -> tuple[int, ...]:
        link = connect.async_serial(far.path, baud=115200, timeout=2, echo=False)
        await link.open()
        reading = asyncio.ensure_future(link.call(1, Request(3, 28)))
        await asyncio.sleep(0.01)
        await link.close()
        return (await reading).words

    assert asyncio.run(talk()) == (28,)


def test_a_thread_that_is_interrupted_leaves_the_line_in_order(far: FarEnd, monkeypatch: pytest.MonkeyPatch) -> None:
    far.plan = lambda request: [(0.1, value_of(request))]
    sent: list[Any] = []
    link = connect.serial(far.path, baud=115200, timeout=2, echo=False, retry=Retry(0), trace=sent.append)
    link.open()

    def interrupted(wire: Any, seconds: float) -> bool:
        if sent:
            raise KeyboardInterrupt
        return wait(wire, seconds)

    with monkeypatch.context() as patched:
        patched.setattr("regscribe_runtime.link.transports.wait", interrupted)
        with pytest.raises(KeyboardInterrupt):
            link.call(1, Request(3, 28))
    assert link.call(2, Request(3, 29)).words == (29,)
    assert link.call(1, Request(3, 30)).words == (30,)
    link.close()


def test_a_tracer_that_fails_does_not_break_the_link(far: FarEnd) -> None:
    far.plan = lambda request: [(0.0, value_of(request))]
    failing = iter([True])

    def trace(_: Any) -> None:
        if next(failing, False):
            message = "the disk is full"
            raise ValueError(message)

    link = connect.serial(far.path, baud=115200, timeout=2, echo=False, trace=trace)
    link.open()
    with pytest.raises(ValueError, match="disk is full"):
        link.call(1, Request(3, 28))
    assert link.call(1, Request(3, 29)).words == (29,)
    link.close()
