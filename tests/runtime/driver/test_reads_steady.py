"""A snapshot is decoded with the state that its values were made under, or it is refused."""

import asyncio
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from regscribe.simulate import simulate
from regscribe_runtime import NotDecodable
from regscribe_runtime.errors import Unsteady

COOLED = {"cooled_codes": {1}}
ROW = """
format: 1
map: {id: test/row, title: Row, maker: Nobody, class_prefix: Row}
manual: {title: None, date: "2026"}
models: {One: {}}
decimals:
  digits: {register: places, at_most: 2}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw, type: int16, range: -30000..30000, default: 250, persistence: ram}
    registers:
      - {at: 0, name: First, decimals: digits}
      - {at: 1, name: Places, range: 0..2, default: 0}
      - {at: 2, name: Second, decimals: digits}
"""


@pytest.fixture
def running(oven: Any) -> Iterator[Any]:
    with simulate(oven.map, "Big", unit=1, givens=COOLED) as server:
        for path, value in (("kind", 2), ("places", 1), ("setpoint", 15.0), ("steps[2].level", 4.5)):
            server.device.poke(path, value)
        yield server


@pytest.fixture
def controller(oven: Any, running: Any) -> Iterator[Any]:
    with oven.driver("Big").tcp(running.host, port=running.port, unit=1, cooled_codes={1}) as driver:
        yield driver


def meddle(driver: Any, act: Callable[[int, Any], None]) -> list[Any]:
    """Let `act` do something before each request is sent, by its number; the requests so far."""
    sent: list[Any] = []
    call = driver.link.call

    def meddled(unit: int, request: Any) -> Any:
        act(len(sent), request)
        sent.append(request)
        return call(unit, request)

    driver.link.call = meddled
    return sent


def test_a_scale_that_someone_else_changed_is_never_used_for_a_snapshot(controller: Any, running: Any) -> None:
    setpoint, places = type(controller).setpoint, type(controller).places
    assert controller.read(setpoint)[setpoint] == 15.0
    assert controller.setpoint.read() == 15.0

    running.device.poke("places", 2)  # at the front panel: no driver knows

    assert controller.read(setpoint, places)[setpoint] == 1.5
    assert controller.setpoint.read() == 1.5  # what the snapshot learnt counts for single reads as well


def test_what_changes_between_two_requests_of_a_snapshot_is_read_again(controller: Any, running: Any) -> None:
    kind = type(controller)
    controller.read(kind.setpoint)

    def before(number: int, request: Any) -> None:
        if number == 1:
            assert request.address >= 4000, "the values come first, what they depend on behind them"
            running.device.poke("places", 2)

    sent = meddle(controller, before)

    assert controller.read(kind.setpoint)[kind.setpoint] == 1.5
    assert len(sent) == 2 * (len(sent) // 2) > 2  # the whole snapshot, twice


def test_words_of_a_float_are_never_put_together_in_a_former_order(controller: Any, running: Any) -> None:
    kind = type(controller)
    controller.read(kind.setpoint, kind.low_limit)

    running.device.poke("order", 0)

    assert controller.read(kind.setpoint)[kind.setpoint] == 15.0


def test_a_device_that_never_holds_still_is_refused_with_the_registers_that_change(
    controller: Any, running: Any
) -> None:
    kind = type(controller)
    controller.read(kind.setpoint)

    def before(_: int, request: Any) -> None:
        if request.address >= 8000:
            running.device.poke("places", 1 + running.device.peek("places") % 3)

    meddle(controller, before)

    with pytest.raises(Unsteady, match="unit 1: places changed while the values that depend on it were read, 4 times"):
        controller.read(kind.setpoint)


def test_a_snapshot_that_trusts_what_is_remembered_asks_for_no_more(controller: Any, running: Any) -> None:
    kind = type(controller)
    controller.read(kind.setpoint)
    sent = meddle(controller, lambda *_: None)

    running.device.poke("places", 2)

    assert controller.read(kind.setpoint, fresh=False)[kind.setpoint] == 15.0
    assert len(sent) == 1


def test_values_and_state_in_one_request_need_no_second_one(build: Any) -> None:
    row = build(ROW)
    driver_class = row.driver("One")
    with (
        simulate(row.map, "One", unit=1) as running,
        driver_class.tcp(running.host, port=running.port, unit=1) as driver,
    ):
        driver.read()
        sent = meddle(driver, lambda *_: running.device.poke("places", 1))
        values = driver.read()

    assert dict(values) == {"first": 25.0, "places": 1, "second": 25.0}
    assert [(one.address, one.quantity) for one in sent] == [(0, 3)]


def test_a_value_whose_scale_cannot_be_known_is_an_error_and_the_rest_is_there(controller: Any, running: Any) -> None:
    kind = type(controller)
    running.device.poke("places", 15)

    values = controller.read(kind.setpoint, kind.cycle)

    assert values[kind.cycle] == 5
    with pytest.raises(NotDecodable, match="places is 15, which is no number of decimals"):
        values[kind.setpoint]


def test_an_absent_dependency_leaves_only_its_dependents_without_a_value(controller: Any) -> None:
    kind = type(controller)
    call = controller.link.call

    def without(unit: int, request: Any) -> Any:
        reply = call(unit, request)
        gone = request.address <= 4001 < request.address + request.quantity
        return reply._replace(exception=2) if gone else reply

    controller.link.call = without

    values = controller.read(kind.setpoint, kind.degrees, kind.cycle)

    assert (values[kind.degrees].name, values[kind.cycle]) == ("FAHRENHEIT", 5)
    with pytest.raises(NotDecodable, match=r"setpoint: its meaning depends on places: .*unit 1"):
        values[kind.setpoint]


def test_the_asyncio_driver_reads_steadily_too(oven: Any, running: Any) -> None:
    kind = getattr(oven.module, f"Async{oven.driver('Big').__name__}")

    async def talk() -> tuple[float, float]:
        async with kind.tcp(running.host, port=running.port, unit=1, cooled_codes={1}) as driver:
            first = (await driver.read(kind.setpoint))["setpoint"]
            running.device.poke("places", 2)
            return first, (await driver.read(kind.setpoint))["setpoint"]

    assert asyncio.run(talk()) == (15.0, 1.5)
