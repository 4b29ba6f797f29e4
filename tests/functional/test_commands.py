"""Commands: what the driver sends step by step, what the device makes of it, what the vectors and the page say."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.emit import markdown, vectors
from regscribe.simulate.device import SimulatedDevice

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
