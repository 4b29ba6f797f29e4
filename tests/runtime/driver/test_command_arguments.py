"""Commands with arguments, and on coils: checked before anything is sent, and looked at by the device."""

import json
from collections.abc import Callable
from typing import Any

import pytest

from regscribe.cli.commands.command import _values
from regscribe.simulate.device.device import SimulatedDevice
from regscribe_runtime import ValueRefused

MAP = """
format: 1
map: {id: test/drive, title: Drive, maker: Test, class_prefix: Drive}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [1, 3, 5, 6, 15, 16], faults: {value: 7}}
decimals: {digits: {register: places}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 1, name: Places, range: 0..2}
      - {at: 2, name: Level, type: int16, decimals: digits, range: -5..50}
      - {at: 3, name: Pump, space: coil}
commands:
  unlock:
    name: Unlock
    source: "4"
    danger: opens the door
    arguments: {password: {range: 1..9999}, way: {enum: {1: up, 2: down}}, ratio: {type: float32, word_order: little}}
    steps:
      - {at: 100, value: {argument: password}}
      - {at: 101, value: {argument: way}}
      - {at: 102, value: {argument: ratio}}
  set_level:
    name: Set Level
    source: "4"
    arguments: {level: {}}
    steps: [{register: level, value: {argument: level}}, {at: 7, words: [1], space: coil}]
  both: {name: Both, source: "4", steps: [{at: 9, words: [1, 0], space: coil}]}
  set_pump:
    name: Set Pump
    source: "4"
    arguments: {running: {}}
    steps: [{register: pump, value: {argument: running}}]
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


def _sent(device: Any) -> list[tuple[int, int, tuple[int, ...]]]:
    return [(one.function, one.address, one.words) for one in device.link.log if not one.reads]


def test_arguments_are_sent_as_the_command_says(device: Any) -> None:
    device.commands.unlock(password=1234, way=2, ratio=1.5, confirm=True)

    # 1.5 as IEEE 754 binary32 is 3FC0 0000, the less significant word first
    assert _sent(device) == [(6, 100, (1234,)), (6, 101, (2,)), (16, 102, (0x0000, 0x3FC0))]
    assert device.link.device.commands_run == ("unlock",)


def test_an_argument_for_a_register_is_scaled_and_limited_as_the_register_is(device: Any) -> None:
    device.link.device.poke("places", 1)
    device.commands.set_level(level=-2.5)
    device.commands.set_pump(running=True)

    assert _sent(device) == [(6, 2, (0xFFE7,)), (5, 7, (1,)), (5, 3, (1,))]
    assert device.link.device.peek("level") == -2.5
    with pytest.raises(ValueRefused, match=r"set_level\.level"):
        device.commands.set_level(level=50.5)


@pytest.mark.parametrize(
    ("given", "why"),
    [
        ({"password": 0, "way": 1, "ratio": 1.0}, r"unlock\.password"),
        ({"password": 1, "way": 3, "ratio": 1.0}, r"unlock\.way"),
        ({"password": 1, "way": 1}, "`ratio` is needed"),
        ({"password": 1, "way": 1, "ratio": 1.0, "wey": 2}, "`wey` is no argument"),
    ],
)
def test_all_arguments_are_checked_before_the_first_step_is_sent(device: Any, given: dict[str, Any], why: str) -> None:
    with pytest.raises(ValueRefused, match=why):
        device.commands.unlock(**given, confirm=True)
    with pytest.raises(ValueRefused):
        device.commands.unlock(password=1, way=1, ratio=1.0)
    assert _sent(device) == []


def test_a_device_refuses_what_an_argument_cannot_be(device: Any) -> None:
    handle = device.link.device.handle

    assert handle(bytes([6, 0, 100, 0x27, 0x10])) == bytes([0x86, 7])  # 10000
    assert handle(bytes([6, 0, 100, 0, 1])) == bytes([6, 0, 100, 0, 1])


def test_a_command_on_coils_is_sent_by_their_functions(device: Any) -> None:
    device.commands.both()

    assert _sent(device) == [(15, 9, (1, 0))]
    assert device.link.device.commands_run == ("both",)


def test_the_command_line_takes_arguments_by_name(device: Any) -> None:
    command = device.session.commands["unlock"]

    found = _values(command, ("password=12", "way=down", "ratio=0.5", "other=x"))

    assert json.dumps([int(found["password"]), int(found["way"]), float(found["ratio"]), found["other"]]) == (
        '[12, 2, 0.5, "x"]'
    )
