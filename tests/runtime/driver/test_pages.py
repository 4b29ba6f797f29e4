"""Registers that a device shows at the same addresses, page by page: the page is selected before anything on it."""

from collections.abc import Callable
from typing import Any

import pytest

from regscribe.simulate.device.describe import tell
from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.line.service import Exchange
from regscribe.tools.live.decode import Decoder
from regscribe.tools.live.dry_run import dry
from regscribe_runtime import ValueRefused
from regscribe_runtime.driver.broadcast import request_for
from regscribe_runtime.wire.capture import CapturedFrame
from regscribe_runtime.wire.framing import Frame

MAP = """
format: 1
map: {id: test/pager, title: Pager, maker: Test, class_prefix: Pager}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol: {functions: [3, 4, 6, 16], broadcast: [6]}
groups:
  - id: control
    name: Control
    source: "1"
    each: {access: rw}
    registers:
      - {at: 2, name: Bank, stays: operation, enum: {0: none, 5: inputs, 6: outputs}}
      - {at: 3, name: Plain}
  - id: inputs
    name: Inputs
    source: "1"
    page: {bank: inputs}
    each: {access: rw}
    registers:
      - {at: 10, name: Alpha, type: int16, decimals: 1}
      - {at: 11, name: Beta, type: uint32}
      - {at: 10, name: Seen, space: input, access: r}
      - id: rows
        name: Row
        repeat: 1..2
        stride: 1
        registers: [{at: 20, name: Level, write_at: 30}]
  - {id: outputs, name: Outputs, source: "1", page: {bank: outputs}, registers: [{at: 10, name: Gamma, access: rw}]}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device, and the requests between them."""
    built = build(MAP)
    return built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=1)), unit=1)


def _sent(device: Any) -> list[tuple[int, int, tuple[int, ...] | int]]:
    found = [(one.function, one.address, one.words or one.quantity) for one in device.link.log]
    device.link.log.clear()
    return found


def test_a_page_is_selected_before_what_stands_on_it_is_read_or_written(device: Any) -> None:
    device.alpha.write(2.5, verify=True)
    device.gamma.write(7)

    assert _sent(device) == [(6, 2, (5,)), (6, 10, (25,)), (3, 10, 1), (6, 2, (6,)), (6, 10, (7,)), (3, 10, 1)]
    assert (device.alpha.read(), device.gamma.read()) == (2.5, 7)
    simulated = device.link.device
    assert [simulated.peek(path) for path in ("alpha", "gamma", "bank")] == [2.5, 7, 6]


def test_all_of_a_page_is_read_in_one_go(device: Any) -> None:
    device.link.device.poke("beta", 70000)

    found = device.read()

    assert (found["beta"], found["gamma"], found["rows[2].level"]) == (70000, 0, 0)
    assert _sent(device) == [
        (3, 2, 2),
        (6, 2, (5,)),
        (3, 10, 3),
        (3, 20, 2),
        (4, 10, 1),
        (6, 2, (6,)),
        (3, 10, 1),
    ]


def test_several_values_are_written_page_by_page(device: Any) -> None:
    device.configure({"gamma": 1, "rows[2].level": 4, "alpha": 1.5, "plain": 9})

    simulated = device.link.device
    assert [simulated.peek(path) for path in ("gamma", "rows[2].level", "alpha", "plain")] == [1, 4, 1.5, 9]
    assert (6, 31, (4,)) in _sent(device)


def test_a_page_is_selected_anew_after_its_selector_was_written(device: Any) -> None:
    device.gamma.read()
    _sent(device)

    device.configure({"bank": 0}, verify=False)
    assert device.gamma.read() == 0

    assert _sent(device)[-2:] == [(6, 2, (6,)), (3, 10, 1)]


def test_a_device_answers_for_the_page_that_is_selected(device: Any) -> None:
    handle = device.link.device.handle
    device.link.device.poke("alpha", 1)

    assert handle(bytes([3, 0, 10, 0, 1])) == bytes([0x83, 2])
    handle(bytes([6, 0, 2, 0, 5]))
    assert handle(bytes([3, 0, 10, 0, 1])) == bytes([3, 2, 0, 10])
    handle(bytes([6, 0, 2, 0, 6]))
    assert handle(bytes([3, 0, 10, 0, 1])) == bytes([3, 2, 0, 0])
    assert handle(bytes([3, 0, 11, 0, 1])) == bytes([0x83, 2])


def test_a_simulated_device_tells_what_stands_on_the_page(device: Any) -> None:
    simulated, asked = device.link.device, bytes([3, 0, 10, 0, 1])
    simulated.poke("bank", "INPUTS")
    simulated.poke("alpha", 2)

    told = tell([simulated], Exchange(Frame(1, asked), simulated.handle(asked), b""))

    assert told.what == "alpha = 2"


def test_a_dry_run_selects_pages_and_writes_nothing_else(device: Any) -> None:
    link = dry(device)

    device.alpha.write(2.5)
    assert device.gamma.read() == 0

    assert [(one.function, one.address) for one in link.written] == [(6, 10)]
    assert (device.alpha.read(), link._link.device.peek("alpha")) == (2.5, 0)


def test_a_capture_is_read_under_the_page_that_it_selects(device: Any) -> None:
    decoder = Decoder(type(device))
    select, asked, answer = bytes([6, 0, 2, 0, 6]), bytes([3, 0, 10, 0, 1]), bytes([3, 2, 0, 7])
    frames = [(select, "sent"), (select, "received"), (asked, "sent"), (answer, "received")]

    *_, last = [decoder.feed(CapturedFrame("rtu", 1, frame, frame), way) for frame, way in frames]

    assert [(item.name, item.text) for item in last.items] == [("gamma", "7")]


def test_what_stands_on_a_page_is_not_broadcast(device: Any) -> None:
    with pytest.raises(ValueRefused, match="each unit has to be on its page first"):
        request_for(type(device).registers["gamma"], 1, {"all": type(device)}, givens={})
