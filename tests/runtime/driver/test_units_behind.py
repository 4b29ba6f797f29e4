"""Groups whose registers are asked at another unit id over the same link, as behind a gateway."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.emit.markdown import render
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.line.server_context import ServerContext
from regscribe.tools.live.decode import Decoder
from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.capture import CapturedFrame

MAP = """
format: 1
map: {id: test/gateway, title: Gateway, maker: Test, class_prefix: Gateway}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 6, 16]}
groups:
  - {id: own, name: Own, source: "1", each: {access: rw}, registers: [{at: 10, name: Alpha}, {at: 11, name: Beta}]}
  - id: meter
    name: Meter
    source: "1"
    unit_id: 3
    registers: [{at: 10, name: Power, type: int32, access: rw}]
  - {id: more, name: More, source: "1", unit_id: 3, each: {access: rw}, registers: [{at: 12, name: Energy}]}
  - {id: other, name: Other, source: "1", unit_id: 4, each: {access: rw}, registers: [{at: 10, name: Flow}]}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


def test_each_group_is_asked_at_its_unit(device: Any) -> None:
    for path, value in {"alpha": 1, "power": -2, "energy": 3, "flow": 4}.items():
        device.link.device.poke(path, value)

    assert device.read().valid == {"alpha": 1, "beta": 0, "power": -2, "energy": 3, "flow": 4}
    asked = [(one.unit, one.address, one.quantity) for one in device.link.log]
    assert asked == [(0, 10, 2), (3, 10, 3), (4, 10, 1)]


def test_values_are_written_at_their_units_and_read_back_there(device: Any) -> None:
    device.power.write(70000)
    device.configure({"flow": 5, "alpha": 6, "energy": 7})

    peek = device.link.device.peek
    assert [peek(path) for path in ("alpha", "power", "energy", "flow")] == [6, 70000, 7, 5]


def test_a_simulated_device_answers_at_all_its_units(device: Any) -> None:
    context = ServerContext([device.link.device])
    device.link.device.poke("flow", 9)

    assert [context.has(unit) for unit in (1, 2, 3, 4)] == [True, False, True, True]
    assert context.answer(4, bytes([3, 0, 10, 0, 1])) == bytes([3, 2, 0, 9])
    assert context.answer(4, bytes([3, 0, 11, 0, 1])) == bytes([0x83, 2])
    assert context.answer(1, bytes([3, 0, 10, 0, 1])) == bytes([3, 2, 0, 0])


def test_a_capture_tells_units_apart(device: Any) -> None:
    decoder = Decoder(type(device))
    asked, answer = bytes([3, 0, 10, 0, 1]), bytes([3, 2, 0, 7])

    found = []
    for unit in (1, 4):
        decoder.feed(CapturedFrame("rtu", unit, asked, asked), "sent")
        found += decoder.feed(CapturedFrame("rtu", unit, answer, answer), "received").items

    assert [(item.name, item.text) for item in found] == [("alpha", "7"), ("flow", "7")]


def test_people_read_unit_ids_and_no_numbers_of_pages(build: Callable[[str], Any]) -> None:
    built = build(MAP)
    (page,) = render(built.map).values()
    assert "10 at unit id 3" in page
    assert "on page " not in page
    model = built.map.model("A")
    assert model.spelled(Space.HOLDING, model.register("flow").address) == "10 at unit id 4"
