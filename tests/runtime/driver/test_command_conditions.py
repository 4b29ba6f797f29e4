"""Commands that exist, and steps that are done, only while a condition holds."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from regscribe.emit.vectors import document, dumps
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.testing import DriverUnderTest, load
from regscribe_runtime import NotPresent
from regscribe_runtime.values.conditions import ALWAYS

MAP = """
format: 1
map: {id: test/steps, title: Steps, maker: Test, class_prefix: Steps}
manual: {title: Manual, number: "1"}
models: {A: {}}
conditions: {by_hand: {mode: manual}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 1, name: Mode, enum: {0: automatic, 1: manual}}
      - {at: 2, name: Lock, range: 0..1}
commands:
  move: {name: Move, source: "4", when: by_hand, steps: [{at: 100, words: [1]}]}
  start:
    name: Start
    source: "4"
    steps:
      - {at: 100, words: [7], when: {lock: 1}}
      - {at: 101, words: [1]}
      - {at: 102, words: [2], when: by_hand}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


def _written(device: Any) -> list[tuple[int, tuple[int, ...]]]:
    return [(one.address, one.words) for one in device.link.log if not one.reads]


def test_a_command_that_does_not_exist_now_is_not_sent(device: Any) -> None:
    with pytest.raises(NotPresent, match=r"move: .*mode is AUTOMATIC"):
        device.commands.move()
    assert _written(device) == []

    device.link.device.poke("mode", "MANUAL")
    device.commands.move()
    assert _written(device) == [(100, (1,))]
    assert device.link.device.commands_run == ("move",)


def test_a_step_is_done_only_if_its_condition_holds(device: Any) -> None:
    device.commands.start()
    assert _written(device) == [(101, (1,))]

    device.link.device.poke("mode", "MANUAL")
    device.link.device.poke("lock", 1)
    device.commands.start()
    assert _written(device)[1:] == [(100, (7,)), (101, (1,)), (102, (2,))]
    assert device.link.device.commands_run == ("start", "start")


def test_a_device_refuses_steps_that_are_none_now(device: Any) -> None:
    handle = device.link.device.handle

    assert handle(bytes([6, 0, 100, 0, 7])) == bytes([0x86, 3])
    device.link.device.poke("lock", 1)
    assert handle(bytes([6, 0, 100, 0, 7])) == bytes([6, 0, 100, 0, 7])


def test_vectors_have_both_sides_of_each_condition(build: Callable[[str], Any], tmp_path: Path) -> None:
    built = build(MAP)
    path = tmp_path / "vectors.json"
    path.write_text(dumps(document(built.map)), encoding="utf-8")
    checked = DriverUnderTest(built.driver("A"), load(path))

    checked.check_device()
    move, start = checked.vectors.commands
    assert {(one["state"]["mode"], one["exists"]) for one in move["existence"]} == {("0", False), ("1", True)}
    assert {(one["state"]["lock"], one["exists"]) for one in start["steps"][0]["existence"]} == {
        ("0", False),
        ("1", True),
    }
    assert "existence" not in start
    assert "existence" not in start["steps"][1]
    section: Any = checked.driver.commands
    section.commands()["move"].when = ALWAYS
    with pytest.raises(AssertionError, match="command move: has a condition False, expected True"):
        checked.check_device()
