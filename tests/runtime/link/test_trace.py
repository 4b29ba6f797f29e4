"""A tracer sees every frame, those that are rejected too."""

import time
from typing import Any

import pytest

from regscribe.simulate import SimulatedDevice
from regscribe_devices.athena.series_c import Athena16C
from regscribe_runtime import Bus, Retry, Trace, WrongAnswer
from regscribe_runtime.link import connect
from regscribe_runtime.wire.requests import Request

from .conftest import FarEnd, frame, serving, words


def test_requests_and_answers_come_in_their_order_with_unit_and_time(units: list[SimulatedDevice]) -> None:
    seen: list[Trace] = []
    before = time.time()
    with serving(units, transport="pty") as server, Bus.rtu(server.path, baud=9600, trace=seen.append) as bus:
        bus.device(Athena16C, unit=2).controller_id.read()
    assert [(one.direction, one.unit) for one in seen] == [("sent", 2), ("received", 2)]
    assert seen[0].frame == frame(2, b"\x03\x0f\xf1\x00\x01")
    assert seen[1].frame == words(2, 2)
    assert before <= seen[0].seconds <= seen[1].seconds <= time.time()


def test_what_is_rejected_is_shown(far: FarEnd) -> None:
    seen: list[Trace] = []
    far.plan = lambda _: [(0.0, words(7, 99)), (0.02, b"\x01\x03")]
    link = connect.serial(far.path, baud=115200, timeout=0.25, echo=False, retry=Retry(0), trace=seen.append)
    link.open()
    with pytest.raises(WrongAnswer):
        link.call(1, Request(3, 28))
    link.close()
    assert [one.direction for one in seen] == ["sent", "received"]
    assert seen[1].frame == words(7, 99) + b"\x01\x03"


def test_a_tracer_may_be_set_and_taken_away_at_any_time(units: list[SimulatedDevice]) -> None:
    seen: list[Trace] = []
    with serving(units) as server, Bus.tcp(server.host, port=server.port) as bus:
        device: Any = bus.device(Athena16C, unit=1)
        device.controller_id.read()
        bus.link.trace = seen.append  # type: ignore[attr-defined] # links made here have it
        device.controller_id.read()
        bus.link.trace = None  # type: ignore[attr-defined] # as above
        device.controller_id.read()
    assert len(seen) == 2
