"""Several devices on one line: fair turns, whole operations, threads, tasks, broadcasts."""

import asyncio
import threading
import time
from typing import Any

import pytest

from regscribe.model import RegisterMap
from regscribe.simulate import SimulatedDevice
from regscribe_devices.athena.platinum_m5000 import AthenaM5000
from regscribe_devices.athena.series_c import AsyncAthena16C, Athena16C
from regscribe_devices.fdc.series_100 import FdcC91 as Fdc
from regscribe_runtime import AsyncBus, Bus, ValueRefused
from regscribe_runtime.operations.session import Pause
from regscribe_runtime.wire.requests import Request

from .conftest import serving

Units = list[SimulatedDevice]


def bus_of(kind: type[Any], server: Any, **more: Any) -> Any:
    return kind.rtu(server.path, baud=9600, **more) if server.path else kind.tcp(server.host, port=server.port, **more)


@pytest.mark.parametrize("transport", ["tcp", "pty"])
def test_the_devices_of_a_bus_share_one_line(units: Units, transport: str) -> None:
    with serving(units, transport=transport) as server, bus_of(Bus, server) as bus:
        for unit in (1, 2, 3):
            bus.device(Athena16C, unit=unit).setpoint_ram.write(100 + unit)
        assert [device.setpoint_ram.read() for device in bus] == [101, 102, 103]
        assert (len(bus), bus.units, bus[2].setpoint_ram.read()) == (3, (1, 2, 3), 102)
    assert [unit.peek("setpoint_ram") for unit in units] == [101, 102, 103]


def test_an_asyncio_bus_does_the_same(units: Units) -> None:
    async def talk(server: Any) -> Any:
        async with bus_of(AsyncBus, server) as bus:
            devices = [bus.device(AsyncAthena16C, unit=unit) for unit in (1, 2, 3)]
            await asyncio.gather(*(device.setpoint_ram.write(100 + at) for at, device in enumerate(devices)))
            return await asyncio.gather(*(device.setpoint_ram.read() for device in bus))

    with serving(units, transport="pty") as server:
        assert asyncio.run(talk(server)) == [100, 101, 102]


def test_opening_and_closing_may_be_repeated_and_a_device_leaves_the_bus_open(units: Units) -> None:
    with serving(units) as server:
        bus = bus_of(Bus, server)
        device = bus.device(Athena16C, unit=1)
        bus.close()
        bus.open()
        bus.open()
        epoch = bus.link.epoch
        with device:
            device.controller_id.read()
        assert device.controller_id.read() == 1
        assert bus.link.epoch == epoch == 1
        bus.close()
        bus.close()


def test_two_devices_with_one_id_are_refused() -> None:
    bus = Bus.tcp("127.0.0.1", port=1)
    bus.device(Athena16C, unit=1)
    with pytest.raises(ValueError, match="unit 1 of this bus is <Athena16C unit 1> already"):
        bus.device(Athena16C, unit=1)


def test_a_device_that_needs_a_longer_silence_is_refused_with_the_remedy() -> None:
    with pytest.raises(ValueError, match="open the bus with gap=4"):
        Bus.rtu("/dev/null", baud=9600, gap=3.5).device(Athena16C, unit=1)


def test_many_threads_read_what_is_theirs(units: Units) -> None:
    for unit in units:
        unit.poke("setpoint_ram", unit.unit * 10)
    wrong: list[Any] = []

    def read(device: Athena16C) -> None:
        for _ in range(25):
            found = device.setpoint_ram.read()
            if found != device.session.unit * 10:
                wrong.append((device, found))

    with serving(units) as server, bus_of(Bus, server) as bus:
        devices = [bus.device(Athena16C, unit=unit) for unit in (1, 2, 3)]
        threads = [threading.Thread(target=read, args=(device,)) for device in devices * 3]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert wrong == []


def long_operation(many: int, log: list[int]) -> Any:
    def task(session: Any) -> Any:
        for _ in range(many):
            yield from session.exchange(Request(3, 28))
            log.append(session.unit)
            yield Pause(0.001)

    return task


def test_a_long_operation_of_one_device_lets_the_others_in_between(units: Units) -> None:
    log: list[int] = []
    with serving(units) as server, bus_of(Bus, server) as bus:
        slow, quick = bus.device(Athena16C, unit=1), bus.device(Athena16C, unit=2)
        thread = threading.Thread(target=lambda: slow.run(long_operation(60, log)))
        thread.start()
        while not log:
            pass
        quick.run(long_operation(5, log))
        between = log.count(1)
        thread.join()
    assert between < 40
    assert log.count(1) == 60


def test_requests_of_two_tasks_take_turns(units: Units) -> None:
    log: list[int] = []

    async def talk(server: Any) -> None:
        async with bus_of(AsyncBus, server) as bus:
            devices = [bus.device(AsyncAthena16C, unit=unit) for unit in (1, 2)]
            await asyncio.gather(*(device.run(long_operation(10, log)) for device in devices))

    with serving(units) as server:
        asyncio.run(talk(server))
    assert max(len(run) for run in "".join(map(str, log)).replace("12", "1 2").replace("21", "2 1").split()) <= 3


def test_operations_of_one_unit_come_one_after_the_other_whatever_driver_they_are_of(units: Units) -> None:
    log: list[str] = []

    def task_of(name: str) -> Any:
        def task(session: Any) -> Any:
            for _ in range(5):
                yield from session.exchange(Request(3, 28))
                log.append(name)
                yield Pause(0.002)

        return task

    with serving(units) as server, bus_of(Bus, server) as bus:
        other = Athena16C(bus.link, unit=1)
        threads = [
            threading.Thread(target=device.run, args=(task_of(name),))
            for name, device in (("a", bus.device(Athena16C, unit=1)), ("b", other))
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert "".join(log) in {"aaaaabbbbb", "bbbbbaaaaa"}


@pytest.mark.parametrize("transport", ["tcp", "pty"])
def test_a_broadcast_reaches_every_unit(units: Units, transport: str) -> None:
    with serving(units, transport=transport) as server, bus_of(Bus, server) as bus:
        devices = [bus.device(Athena16C, unit=unit) for unit in (1, 2, 3)]
        assert {device.output_1_low_limit.read() for device in devices} == {0}
        bus.broadcast(Athena16C.output_1_low_limit, 30, state={"output_1_high_limit": 100})
        assert {device.output_1_low_limit.read() for device in devices} == {30}
        bus.broadcast_raw(Request(6, 30, 1, (7,)))
    assert [unit.peek_words("input_filter", "base") for unit in units] == [(7,)] * 3


def test_an_asyncio_bus_broadcasts_too(units: Units) -> None:
    async def talk(server: Any) -> None:
        async with bus_of(AsyncBus, server) as bus:
            await bus.broadcast(
                AsyncAthena16C.output_1_low_limit, 30, state={"output_1_high_limit": 100}, driver=AsyncAthena16C
            )

    with serving(units) as server:
        asyncio.run(talk(server))
    assert [unit.peek("output_1_low_limit") for unit in units] == [30] * 3


def test_after_a_broadcast_the_line_is_left_alone_until_all_units_are_done(units: Units) -> None:
    sent: list[float] = []
    with (
        serving(units, transport="pty") as server,
        bus_of(Bus, server, trace=lambda _: sent.append(time.monotonic())) as bus,
    ):
        device = bus.device(Athena16C, unit=1)
        began = time.monotonic()  # the stamp of the broadcast itself comes later on a busy machine
        bus.broadcast_raw(Request(6, 30, 1, (7,)))
        device.loopback()
    latency = Athena16C.protocol.latency(6)
    assert latency is not None
    longest = latency.maximum / 1000
    assert sent[1] - began >= longest + 8 * 10 / 9600


@pytest.mark.parametrize("transport", ["tcp", "pty"])
def test_a_bus_and_its_broadcasts_count_addresses_as_the_units_do(platinum: RegisterMap, transport: str) -> None:
    devices = [SimulatedDevice(platinum, "M5000", unit=unit, addressing="jbus") for unit in (1, 2)]
    with serving(devices, transport=transport) as server, bus_of(Bus, server, addressing="jbus") as bus:
        for unit in (1, 2):
            bus.device(AthenaM5000, unit=unit)
        bus.broadcast(AthenaM5000.safety_output, -20)
        assert [device.safety_output.read() for device in bus] == [-20, -20]
    assert [device.peek("safety_output") for device in devices] == [-20, -20]


@pytest.mark.parametrize(
    ("register", "value", "said"),
    [
        (Athena16C.controller_id, 5, "how units talk"),
        (Athena16C.setpoint_ram, 150, "depends on .*pass state="),
        (Athena16C.controller_type, 1, "read-only"),
    ],
)
def test_what_cannot_be_broadcast_is_refused_with_the_reason(register: Any, value: Any, said: str) -> None:
    bus = Bus.tcp("127.0.0.1", port=1)
    bus.device(Athena16C, unit=1)
    with pytest.raises(ValueRefused, match=said):
        bus.broadcast(register, value)


def test_a_broadcast_is_refused_where_a_unit_of_the_line_has_another_register_there() -> None:
    bus = Bus.tcp("127.0.0.1", port=1)
    bus.device(Athena16C, unit=1)
    bus.device(AthenaM5000, unit=2)
    with pytest.raises(ValueRefused, match=r"reaches every unit, but unit 2 .M5000. has no such register there"):
        bus.broadcast(Athena16C.output_1_low_limit, 5, state={"output_1_high_limit": 100})


def test_a_broadcast_is_refused_where_the_manual_does_not_allow_the_function() -> None:
    bus = Bus.tcp("127.0.0.1", port=1)
    bus.device(Athena16C, unit=1)
    with pytest.raises(ValueRefused, match=r"manual allows \[6, 16\]"):
        bus.broadcast_raw(Request(5, 0, 1, (1,)))
    with pytest.raises(ValueRefused, match="manual allows none"):
        Bus.tcp("127.0.0.1", port=1).broadcast_raw(Request(6, 0, 1, (1,)), driver=Fdc)


def test_a_bus_without_devices_must_be_told_what_the_units_are() -> None:
    with pytest.raises(ValueRefused, match="no device of this bus is known"):
        Bus.tcp("127.0.0.1", port=1).broadcast_raw(Request(6, 0, 1, (1,)))
