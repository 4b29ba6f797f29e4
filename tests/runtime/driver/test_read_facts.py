"""What a map says of reading: what reading clears, what falls back by itself, how often a value is worth a request."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.simulate.device.device import SimulatedDevice
from regscribe.tools.live import names
from regscribe.tools.live.watch import watch
from regscribe.tools.settings.take import writable
from regscribe_runtime import NoAnswer
from regscribe_runtime.link.links import Retry
from regscribe_runtime.operations import session

MAP = """
format: 1
map: {id: test/facts, title: Facts, maker: Test, class_prefix: Facts}
manual: {title: Manual, number: "1"}
models: {A: {}}
decimals: {digits: {register: places}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 10, name: Before}
      - {at: 11, name: Events, reading: clears}
      - {at: 12, name: Latch, reading: clears, persistence: eeprom}
      - {at: 13, name: After}
      - {at: 20, name: Places, range: 0..3, good_for: 30}
      - {at: 21, name: Level, decimals: digits}
      - {at: 30, name: Button, stays: momentary, persistence: ram}
      - {at: 40, name: Rating, access: r, static: true}
      - {at: 41, name: Hours, access: r, poll: 60}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


def _sent(device: Any) -> list[tuple[int, int, int]]:
    found = [(one.function, one.address, one.quantity) for one in device.link.log]
    device.link.log.clear()
    return found


def test_what_reading_clears_is_read_alone_and_only_where_it_is_named(device: Any) -> None:
    driver = type(device)
    device.link.device.poke("events", 7)

    assert "events" not in device.read()
    assert "events" not in device.read(device.groups.all)
    assert not {"events", "latch"} & {one.path for one in names.readable(driver)}
    assert all(not first <= 11 < first + count for _, first, count in _sent(device))
    assert device.read(driver.before, driver.events, driver.after)["events"] == 7
    assert _sent(device) == [(3, 10, 1), (3, 11, 1), (3, 13, 1)]
    assert device.events.read() == 0


def test_what_reading_clears_is_not_read_to_check_a_write(device: Any) -> None:
    device.latch.write(5)
    device.configure({"events": 3, "before": 1})

    assert [one for one in _sent(device) if one[0] == 3 and one[1] in (11, 12)] == []
    assert device.latch.read() == 5


def test_what_reading_clears_is_not_read_again_after_a_lost_answer(device: Any) -> None:
    device.link.retry, device.link.fate = Retry(reads=2, pause=0), {1: "lost", 3: "lost"}

    with pytest.raises(NoAnswer):
        device.events.read()
    assert _sent(device) == [(3, 11, 1)]
    device.before.read()
    assert device.before.read() == 0
    assert _sent(device) == [(3, 10, 1), (3, 10, 1), (3, 10, 1)]


def test_what_falls_back_by_itself_is_neither_checked_nor_copied(device: Any) -> None:
    device.button.write(1)
    device.configure({"button": 1})

    assert _sent(device) == [(6, 30, 1), (3, 30, 1), (6, 30, 1)]
    assert device.link.device.peek("button") == 0
    assert "button" not in {one.path for one in writable(type(device))}


def test_a_value_that_others_depend_on_is_read_again_when_it_is_too_old(
    device: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [1000.0]
    monkeypatch.setattr(session.time, "monotonic", lambda: now[0])
    device.link.device.poke("level", 5)

    assert (device.level.read(), device.level.read()) == (5, 5)
    assert _sent(device) == [(3, 20, 1), (3, 21, 1), (3, 21, 1)]
    now[0] += 31
    device.link.device.poke("places", 1)
    assert device.level.read() == 0.5


def test_what_is_followed_is_asked_as_often_as_the_map_says(device: Any) -> None:
    registers = names.chosen(type(device), ["before", "rating", "hours", "places"])

    rounds = list(watch(device, registers, every=20, count=3, sleep=lambda _: None))

    asked = [address for _, address, _ in _sent(device)]
    assert (asked.count(10), asked.count(40), asked.count(20)) == (3, 1, 1)
    assert {len(one.readings) for one in rounds} == {4}
