"""Commands: what the driver sends step by step, what the device makes of it, what the vectors and the page say."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.emit import markdown, vectors
from regscribe.simulate.device.device import SimulatedDevice
from regscribe_runtime.wire import pdu

HEAD = """
format: 1
map: {id: test/commands, title: Commands, maker: Test, class_prefix: Commands}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [1, 3, 5, 6, 15, 16]}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 5, name: Low, range: 0..10}
      - {at: 6, name: High, range: 0..10}
      - {at: 7, name: Start, space: coil}
commands:
"""


@pytest.fixture
def told(build: Callable[[str], Any], direct: Any) -> Callable[..., tuple[Any, Any, Any]]:
    """A map with a command `go` of these steps; its driver on a simulated device, and the requests that it sends."""

    def make(*steps: str) -> tuple[Any, Any, Any]:
        built = build(f"{HEAD}  go: {{name: Go, source: '1', steps: [{', '.join(steps)}]}}\n")
        link = direct(SimulatedDevice(built.map, "A", unit=1))
        return built.map, built.driver("A")(link, unit=1), link

    return make


def _facts(register_map: Any) -> Any:
    return vectors.document(register_map)["commands"][0]["steps"]


def _page(register_map: Any) -> str:
    return "\n".join(markdown.render(register_map).values())


def test_a_wait_of_0_is_a_wait(told: Callable[..., Any]) -> None:
    register_map, driver, link = told("{at: 70, words: [1]}", "{wait: 0}", "{at: 71, words: [2]}")
    driver.commands.go()
    assert [(one.function, one.address, one.words) for one in link.log] == [(6, 70, (1,)), (6, 71, (2,))]
    assert link.device.commands_run == ("go",)
    assert _facts(register_map)[1] == {"wait": 0}
    assert "wait 0 ms" in _page(register_map)


@pytest.mark.parametrize(
    ("step", "frame", "fact"),
    [
        ("{register: start, value: 1}", "05 0007 FF00", {"function": 5, "address": 7, "words": [1]}),
        ("{register: start, words: [0]}", "05 0007 0000", {"function": 5, "address": 7, "words": [0]}),
        (
            "{register: start, value: 1, function: 15}",
            "0F 0007 0001 01 01",
            {"function": 15, "address": 7, "words": [1]},
        ),
        ("{at: 20, words: [1], function: 5}", "05 0014 FF00", {"function": 5, "address": 20, "words": [1]}),
        (
            "{at: 20, words: [1, 0, 1], function: 15}",
            "0F 0014 0003 01 05",
            {"function": 15, "address": 20, "words": [1, 0, 1]},
        ),
    ],
)
def test_a_command_writes_coils(step: str, frame: str, fact: Any, told: Callable[..., Any]) -> None:
    register_map, driver, link = told(step)
    driver.commands.go()
    assert [pdu.encode_request(one) for one in link.log] == [bytes.fromhex(frame)]
    assert link.device.commands_run == ("go",)
    assert _facts(register_map) == [fact]
    (row,) = (line for line in _page(register_map).splitlines() if line.startswith("| 1 | write |"))
    number = f"(0x{fact['address']:X}, Modicon {fact['address'] + 1:05d})"
    assert f"| {fact['function']:02d} | {fact['address']} {number} |" in row
    assert f" {' '.join(map(str, fact['words']))} " in row
    assert "000" not in row.replace(number, "")


def test_a_word_and_a_coil_at_one_address_are_two_steps(told: Callable[..., Any]) -> None:
    _, driver, link = told("{at: 20, words: [1], function: 6}", "{at: 20, words: [1], function: 5}")
    for _ in range(2):
        assert link.device.handle(bytes.fromhex("06 0014 0001")) is not None
    assert link.device.commands_run == ()
    driver.commands.go()
    assert link.device.commands_run == ("go",)


def test_a_step_may_write_several_registers_at_once_and_beyond_their_limits(told: Callable[..., Any]) -> None:
    _, driver, link = told("{at: 5, words: [85, 92]}")
    driver.commands.go()
    assert (driver.low.read_raw(), driver.high.read_raw()) == ((85,), (92,))
    assert link.device.commands_run == ("go",)
