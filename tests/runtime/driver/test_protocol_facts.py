"""What a map says of the protocol: a pause between requests, limits of single spaces, and unit 0 over TCP."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest

from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.line.server_context import ServerContext
from regscribe_runtime.driver import executor
from regscribe_runtime.link.pending import PendingRequest
from regscribe_runtime.operations import session

MAP = """
format: 1
map: {id: test/facts, title: Facts, maker: Test, class_prefix: Facts}
manual: {title: Manual, number: "1"}
models: {A: {}}
protocol:
  functions: [1, 3, 4, 6, 15, 16]
  unit_ids: 0..247
  pause: 50
  space_limits: {input: {read: 2}, holding: {write: 1}}
groups:
  - id: all
    name: All
    source: "1"
    each: {access: rw}
    registers:
      - {at: 10, name: One}
      - {at: 11, name: Two}
      - {at: 12, name: Three}
      - {at: 10, name: Four, space: input, access: r}
      - {at: 11, name: Five, space: input, access: r}
      - {at: 12, name: Six, space: input, access: r}
"""


@pytest.fixture
def device(build: Callable[[str], Any], direct: Any) -> Any:
    """A driver on a simulated device with unit 0, and the requests between them."""
    built = build(MAP)
    device = built.driver("A")(direct(SimulatedDevice(built.map, "A", unit=0)), unit=0)
    device.link.line = None
    return device


def _sent(device: Any) -> list[tuple[int, int, int]]:
    return [(one.function, one.address, one.quantity) for one in device.link.log]


def test_requests_keep_to_the_limits_of_their_space(device: Any) -> None:
    device.read()
    assert sorted(_sent(device)) == [(3, 10, 3), (4, 10, 2), (4, 12, 1)]

    device.link.log.clear()
    device.configure({"one": 1, "two": 2}, verify=False)
    assert [one for one in _sent(device) if one[0] != 3] == [(6, 10, 1), (6, 11, 1)]


def test_a_simulated_device_refuses_what_is_longer(device: Any) -> None:
    simulated = device.link.device

    assert simulated.handle(bytes([4, 0, 10, 0, 3])) == bytes([0x84, 3])
    assert simulated.handle(bytes([16, 0, 10, 0, 2, 4, 0, 1, 0, 2])) == bytes([0x90, 3])


def test_a_driver_waits_between_two_requests(device: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    now, slept = [1000.0], []
    monkeypatch.setattr(session, "time", SimpleNamespace(monotonic=lambda: now[0]))
    monkeypatch.setattr(executor, "time", SimpleNamespace(sleep=slept.append))

    device.one.read()
    now[0] += 0.02
    device.one.read()
    now[0] += 0.05
    device.one.read()

    assert [round(seconds, 3) for seconds in slept] == [0.03]


def test_unit_0_answers_over_tcp_where_the_map_has_it(device: Any, direct: Any) -> None:
    device.one.write(5)

    assert device.one.read() == 5
    (write,) = [one for one in device.link.log if not one.reads]
    assert not PendingRequest(0, write, write, b"", 1.0).is_broadcast
    served = ServerContext([device.link.device])
    assert served.answer(0, bytes([3, 0, 10, 0, 1])) == bytes([3, 2, 0, 5])

    serial = type(device)(direct(device.link.device), unit=0)
    with pytest.raises(ValueError, match="unit 0 is a broadcast on a serial line"):
        serial.one.read()
