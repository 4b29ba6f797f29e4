"""Scales whose numbers stand in registers: learnt once, looked at again with every snapshot, never used when stale."""

import asyncio
from collections.abc import Iterator
from typing import Any

import pytest

from regscribe.simulate import simulate
from regscribe.tools.settings import factory
from regscribe_runtime import NotDecodable, SensorFault, ValueRefused
from regscribe_runtime.registers import codec

from .test_reads_steady import meddle

POINTS = 200
METER = """
format: 1
map: {id: test/meter, title: Meter, maker: Nobody, class_prefix: Meter}
manual: {title: None, date: "2026"}
models: {One: {}}
protocol: {limits: {read_words: 50}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw, type: int16, persistence: ram}
    registers:
      - {at: 0, name: Sf, sentinels: {-32768: not implemented}, range: -10..10, default: -1}
      - {at: 1, name: Ratio, type: uint16, default: 40, range: 0..1000}
      - at: 2
        name: Power
        exponent: sf
        sentinels: {-32768: not implemented}
        unit: [{when: {ratio: 1}, is: W}, {is: kW}]
      - {at: 3, name: Current, multiply: {product: [0.1, ratio]}}
      - {at: 4, name: Level, scale: {from: 0, to: ratio, raw: 0..4000}}
      - {at: 5, name: Band, default: [{when: {ratio: 40}, is: 7}, {is: 5}], delivered: [{when: {sf: 3}, is: 1}]}
      - {id: points, name: Point, repeat: "1..200", stride: 1, registers: [{at: 100, name: Value, exponent: sf}]}
"""


@pytest.fixture(scope="module")
def meter(build: Any) -> Any:
    return build(METER)


@pytest.fixture
def running(meter: Any) -> Iterator[Any]:
    with simulate(meter.map, "One", unit=1) as server:
        yield server


@pytest.fixture
def driver(meter: Any, running: Any) -> Iterator[Any]:
    with meter.driver("One").tcp(running.host, port=running.port, unit=1) as found:
        yield found


def test_a_scale_factor_that_changes_between_two_requests_of_a_snapshot_is_read_again(
    driver: Any, running: Any
) -> None:
    kind = type(driver)
    running.device.poke("power", 1500)
    driver.read(kind.power, kind.ratio)

    def before(number: int, _: Any) -> None:
        if number == 1:
            running.device.poke("sf", 1)

    sent = meddle(driver, before)
    values = [driver.points[index].value for index in (1, 200)]

    found = driver.read(kind.power, *(register.register for register in values))

    assert found[kind.power] == 150000.0  # 15000 x 10
    assert len(sent) > 2


def test_a_scale_factor_that_is_shared_by_hundreds_of_points_is_settled_when_they_are_prepared(
    driver: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    driver.read(driver.groups.all)
    settled: list[object] = []
    resolve = codec.resolve
    monkeypatch.setattr(codec, "resolve", lambda *args: settled.append(args) or resolve(*args))

    found = driver.read(driver.groups.all)

    assert len(found) > POINTS
    assert not settled


def test_a_value_whose_scale_factor_is_not_implemented_says_so(driver: Any, running: Any) -> None:
    running.device.poke("sf", "NOT_IMPLEMENTED")

    with pytest.raises(NotDecodable, match="its meaning depends on sf"):
        driver.power.read()
    running.device.poke("power", "NOT_IMPLEMENTED")
    with pytest.raises(SensorFault, match="not implemented"):
        driver.power.read()


def test_a_ratio_of_0_is_named_by_reading_and_writing(driver: Any, running: Any) -> None:
    running.device.poke("ratio", 0)

    with pytest.raises(NotDecodable, match="multiplies by 0 with ratio = 0"):
        driver.current.read()
    with pytest.raises((NotDecodable, ValueRefused), match="multiplies by 0 with ratio = 0"):
        driver.current.write(5)
    with pytest.raises(NotDecodable, match="multiplies by 0 with ratio = 0"):
        driver.level.read()


def test_a_write_is_finer_than_the_scale_factor_allows(driver: Any, running: Any) -> None:
    with pytest.raises(ValueRefused, match=r"nearest are 1500 and 1500\.1"):
        driver.power.write(1500.05)
    driver.power.write(1500.05, rounded=True)
    assert running.device.peek_words("power") == (15001,)


def test_a_simulated_device_keeps_its_words_when_the_scale_factor_changes(driver: Any, running: Any) -> None:
    driver.power.write(1500)
    driver.sf.write(-2)

    assert running.device.peek_words("power") == (15000,)
    assert running.device.peek("power") == 150
    assert driver.power.read() == 150.0


def test_a_unit_by_case_stands_at_the_register(driver: Any) -> None:
    assert driver.power.read_unit() == "kW"
    driver.ratio.write(1)
    assert driver.power.read_unit() == "W"


def test_an_asynchronous_driver_settles_terms_as_well(meter: Any, running: Any) -> None:
    running.device.poke("current", 20)

    async def read() -> Any:
        async with meter.module.AsyncMeterOne.tcp(running.host, port=running.port, unit=1) as found:
            return await found.current.read(), await found.power.read()

    assert asyncio.run(read())[0] == 20.0


def test_a_default_by_case_counts_as_the_other_defaults_have_it(meter: Any, running: Any) -> None:
    driver = meter.driver("One")

    assert running.device.peek("band") == 7
    assert factory(driver)["band"].value == 7
    assert [case.then for case in driver.registers["band"].default_cases] == [7, 5]
    assert driver.registers["band"].default is None


def test_a_register_names_the_registers_of_its_terms(meter: Any) -> None:
    registers = meter.driver("One").registers

    assert registers["power"].needs(registers["power"].view()) == ("sf",)
    assert registers["level"].needs(registers["level"].view()) == ("ratio",)
