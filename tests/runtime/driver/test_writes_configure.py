"""Several writes as one operation: checked as a whole, in order, in few requests, undone or reported exactly."""

import asyncio
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regscribe.simulate import SimulatedDevice
from regscribe_runtime import (
    Fate,
    NotConfigured,
    PartialWrite,
    Progress,
    ReadWrite,
    ValueRefused,
    ValuesRefused,
    WriteReport,
)

WRITES = frozenset({6, 16})
MANY = {
    "band": 33,
    "cycle": 5,  # as it is
    "delay": 7,
    "filter": 8,
    "high_limit": 1800,
    "rest_point": 1500,
    "span_low": -5,
    "trim_low": 5,
    "setpoint": 1700,
    "horn": 2,
}
"""Values for most of the kiln, whose writes need unlocking, applying and each other."""

Driver = Callable[..., Any]


@pytest.fixture(autouse=True, scope="module")
def no_waiting() -> Any:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("regscribe_runtime.operations.read_back.LOOKS", (0.0, 0.0))
        yield


@pytest.fixture
def device(kiln: Any) -> SimulatedDevice:
    return SimulatedDevice(kiln.map, "One", unit=1)


@pytest.fixture
def controller(kiln: Any, direct: Any, device: SimulatedDevice) -> Any:
    return kiln.driver("One")(direct(device), unit=1)


def written(controller: Any) -> list[tuple[int, tuple[int, ...]]]:
    return [(asked.address, asked.words) for asked in controller.link.log if asked.function in WRITES]


# --- what is sent


def test_neighbours_share_a_request_up_to_what_the_device_takes(controller: Any, device: SimulatedDevice) -> None:
    controller.configure({"slope": 9, "filter": 8, "delay": 7, "cycle": 6, "band": 4})

    assert written(controller) == [(20, (4, 6, 7, 8)), (24, (9,))]
    assert [device.peek(path) for path in ("band", "cycle", "delay", "filter", "slope")] == [4, 6, 7, 8, 9]


def test_what_the_device_holds_already_is_neither_written_nor_worn(controller: Any) -> None:
    report = controller.configure({"band": 10, "cycle": 6, "mode": 0})

    assert written(controller) == [(21, (6,))]
    assert (report.equal, report.written) == (("band", "mode"), ("cycle",))
    assert (controller.wear.written, controller.wear.spared) == (1, 1)


def test_groups_are_written_in_the_order_of_the_map(controller: Any) -> None:
    controller.configure({"span_high": 1, "band": 1, "degrees": 1, "mode": 1}, confirm=True)

    assert [address for address, _ in written(controller)] == [10, 20, 31, 51, 91]


def test_what_others_depend_on_is_written_before_them_and_in_a_request_of_its_own(controller: Any) -> None:
    controller.configure({"rest_point": 2500, "high_limit": 2600, "low_limit": 100, "output_1": 5, "mode": 1})

    assert written(controller) == [(26, (100, 2600)), (28, (2500,)), (51, (1,)), (52, (5,))]


def test_unlocking_and_applying_are_done_once(controller: Any, device: SimulatedDevice) -> None:
    report = controller.configure({"trim_high": 2, "trim_low": 1, "span_low": 3, "span_high": 4}, confirm=True)

    assert device.commands_run == ("unlock_trim", "commit")
    assert device.pending == ()
    assert report.commands == {"unlock_trim": Fate.WRITTEN, "commit": Fate.WRITTEN}


def test_values_may_be_named_by_path_by_declaration_and_by_attribute(controller: Any, device: SimulatedDevice) -> None:
    controller.configure({"band": 1, type(controller).cycle: 2, controller.delay: 3})
    assert [device.peek(path) for path in ("band", "cycle", "delay")] == [1, 2, 3]


def test_a_changed_unit_of_measure_is_taken_into_account(controller: Any, device: SimulatedDevice) -> None:
    report = controller.configure({"high_limit": 900, "setpoint": 800, "degrees": 1}, confirm=True)

    assert written(controller)[0] == (10, (1,))
    assert report.written == ("degrees", "high_limit", "setpoint")
    assert [device.peek(path) for path in ("degrees", "high_limit", "setpoint")] == [1, 900, 800]


def test_a_limit_that_the_unit_of_measure_converted_is_checked_after_it(
    controller: Any, device: SimulatedDevice
) -> None:
    with pytest.raises(NotConfigured, match="setpoint: 1900 lies outside -18 to 1093") as caught:  # 2000 °F are 1093 °C
        controller.configure({"setpoint": 1900, "degrees": 1}, confirm=True)

    assert device.peek("degrees") == 0
    assert caught.value.report.not_written == ("degrees", "setpoint")


def test_a_limit_that_the_unit_of_measure_will_raise_does_not_stop_a_value(
    controller: Any, device: SimulatedDevice
) -> None:
    device.poke("degrees", 1)
    controller.configure({"setpoint": 3000, "degrees": 0}, confirm=True)  # 2000 °C are 3632 °F
    assert device.peek("setpoint") == 3000


def test_a_dry_run_shows_the_plan_and_writes_nothing(controller: Any) -> None:
    report = controller.configure({"trim_low": 3, "band": 10, "cycle": 6, "span_low": 9}, confirm=True, dry_run=True)

    assert written(controller) == []
    assert report.dry_run
    changes = {change.register: (change.was, change.value, change.fate) for change in report.changes}
    assert changes == {
        "band": (10, 10, Fate.EQUAL),
        "cycle": (5, 6, Fate.PLANNED),
        "span_low": (0, 9, Fate.PLANNED),
        "trim_low": (0, 3, Fate.PLANNED),
    }
    assert [(one.address, one.words, one.command) for one in report.requests] == [
        (21, (6,), ""),
        (30, (9,), ""),
        (0, (), "unlock_trim"),
        (40, (3,), ""),
        (0, (), "commit"),
    ]


def test_a_dry_run_asks_for_just_what_is_sent_then(controller: Any) -> None:
    values = {"band": 11, "cycle": 6, "low_limit": 5, "rest_point": 50, "span_low": 2}
    plan = controller.configure(values, dry_run=True)
    controller.configure(values)

    assert [(one.address, one.words) for one in plan.requests if not one.command] == [
        one for one in written(controller) if one[0] != 91
    ]


def test_progress_is_told_before_each_request(controller: Any) -> None:
    told: list[Progress] = []
    controller.configure({"band": 1, "cycle": 1, "mode": 1}, tell=told.append)

    assert told == [(0, 3, "band"), (2, 3, "mode")]


# --- what is refused


def test_all_that_is_wrong_is_told_at_once_and_nothing_is_sent(controller: Any) -> None:
    with pytest.raises(ValuesRefused) as caught:
        controller.configure({"band": 101, "cycle": 0, "delay": 5})

    assert [one.register for one in caught.value.refusals] == ["band", "cycle"]
    assert written(controller) == []


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"bend": 1}, "no such register: did you mean band"),
        ({"serial_number": "KL02"}, "read-only"),
        ({"trim_low": 1}, "a wrong trim falsifies every measurement"),
        ({"output_1": 1}, "manual mode only; mode is NORMAL"),
        ({"setpoint": 2500, "high_limit": 2400}, "0 to 2400"),
        ({"mode": 0, "output_1": 1}, "manual mode only; mode is NORMAL"),
        ({"band": 1.5}, "no whole number"),
    ],
)
def test_a_bad_value_is_refused_before_anything_is_sent(controller: Any, values: dict[str, Any], said: str) -> None:
    with pytest.raises(ValueRefused, match=said):
        controller.configure(values)
    assert written(controller) == []


def test_a_value_counts_against_the_state_that_the_others_will_leave(controller: Any, device: SimulatedDevice) -> None:
    controller.configure({"setpoint": 2500, "high_limit": 2600, "output_1": 9, "mode": 1})
    assert [device.peek(path) for path in ("setpoint", "output_1")] == [2500, 9]


def test_registers_that_a_unit_lacks_are_named_before_anything_is_sent(
    controller: Any, device: SimulatedDevice, monkeypatch: pytest.MonkeyPatch
) -> None:
    take = device.handle

    def lack(pdu: bytes) -> bytes | None:
        address, count = int.from_bytes(pdu[1:3], "big"), int.from_bytes(pdu[3:5], "big")
        return b"\x83\x02" if pdu[0] == 3 and address <= 24 < address + count else take(pdu)

    monkeypatch.setattr(device, "handle", lack)
    with pytest.raises(ValueRefused, match=r"slope: this unit cannot read it.*no such address"):
        controller.configure({"band": 1, "slope": 2, "delay": 3})
    assert written(controller) == []


# --- what breaks


def truth(report: WriteReport, device: SimulatedDevice) -> None:
    """Hold a report to what the simulated device holds."""
    for change in report.changes:
        held = device.peek_words(change.register, change.view)
        if change.fate in {Fate.WRITTEN, Fate.EQUAL}:
            assert held == change.sent, change
        elif change.fate in {Fate.NOT_WRITTEN, Fate.RESTORED} and change.before is not None:
            assert held == change.before, change
        elif change.fate is Fate.DIFFERS:
            assert held not in {change.sent, change.before}, change
    for command, fate in report.commands.items():
        if fate is not Fate.UNKNOWN:
            assert (command in device.commands_run) is (fate is Fate.WRITTEN), command


def held(device: SimulatedDevice) -> dict[str, Any]:
    return {path: device.peek_words(path) for path in MANY if path != "horn"}


@pytest.fixture(scope="module")
def length(kiln: Any, direct: Any) -> int:
    """How many requests it takes to configure the kiln."""
    controller = kiln.driver("One")(direct(SimulatedDevice(kiln.map, "One", unit=1)), unit=1)
    controller.configure(MANY, confirm=True)
    return int(controller.link.count)


def broken(kiln: Any, direct: Any, *, undo: bool = True, values: Any = None, **fates: Any) -> Any:
    device = SimulatedDevice(kiln.map, "One", unit=1)
    before = held(device)
    controller = kiln.driver("One")(direct(device, **fates), unit=1)
    error: NotConfigured | None = None
    try:
        report = controller.configure(values or MANY, confirm=True, undo=undo)
    except NotConfigured as caught:
        report, error = caught.report, caught
    truth(report, device)
    return device, report, error, before


@pytest.mark.parametrize("fate", ["lost", "missed", "gone", "garbled"])
@pytest.mark.parametrize("undo", [True, False])
def test_a_break_at_any_write_is_reported_as_it_is(kiln: Any, direct: Any, fate: str, undo: bool) -> None:  # noqa: FBT001 (a parameter of the test)
    writes = 0
    for place in range(1, 12):
        device, report, error, before = broken(kiln, direct, undo=undo, fate={place: fate}, writes_only=True)
        writes += error is not None
        if error is None:
            assert not report.not_written
            assert not report.unknown
        elif undo:
            assert held(device) == before
            assert set(report.unknown) <= {"horn"}
        else:
            assert report.written or report.not_written
            assert set(report.unknown) <= {"horn"}
    assert writes  # some of the places do break it


@pytest.mark.parametrize("fate", ["lost", "missed", "garbled"])
def test_a_line_that_dies_at_any_request_leaves_a_true_report(kiln: Any, direct: Any, length: int, fate: str) -> None:
    for place in range(1, length + 1):
        dead = dict.fromkeys(range(place + 1, place + 200), "missed")
        try:
            _, report, error, _ = broken(kiln, direct, fate={place: fate, **dead})
        except Exception as problem:  # noqa: BLE001 (before anything is written, the line's own error shows)
            assert not isinstance(problem, NotConfigured)  # noqa: PT017 (the loop goes on)
            continue
        assert error is not None
        assert report.unknown or report.not_written


@settings(max_examples=60, deadline=None)
@given(
    fates=st.dictionaries(st.integers(1, 40), st.sampled_from(["lost", "missed", "gone", "garbled"]), max_size=6),
    undo=st.booleans(),
    values=st.fixed_dictionaries(
        {},
        optional={
            "band": st.integers(0, 100),
            "cycle": st.integers(1, 120),
            "delay": st.integers(0, 999),
            "low_limit": st.integers(0, 50),
            "high_limit": st.integers(100, 3000),
            "setpoint": st.integers(50, 100),
            "span_low": st.integers(-999, 999),
            "span_high": st.integers(-999, 999),
            "trim_low": st.integers(-99, 99),
            "trim_high": st.integers(-99, 99),
            "mode": st.integers(0, 1),
            "horn": st.integers(0, 5),
        },
    ),
)
def test_whatever_breaks_the_report_is_true(
    kiln: Any,
    direct: Any,
    fates: dict[int, str],
    undo: bool,  # noqa: FBT001 (a parameter of the test)
    values: dict[str, int],
) -> None:
    try:
        broken(kiln, direct, undo=undo, values=values, fate=fates)
    except (ConnectionError, TimeoutError, AssertionError) as error:
        if isinstance(error, AssertionError):
            raise  # reading before the first write may well fail, a wrong report must not
    except Exception as error:  # noqa: BLE001 (the line's own errors before the first write)
        assert type(error).__name__ == "WrongAnswer"  # noqa: PT017 (the only one left)


def test_a_device_that_stops_in_the_middle_of_a_request_names_the_register(
    kiln: Any, direct: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    device = SimulatedDevice(kiln.map, "One", unit=1)
    controller = kiln.driver("One")(direct(device), unit=1)
    monkeypatch.setattr(type(controller).delay, "range", ())  # the map knows of no limit, the device does

    with pytest.raises(NotConfigured, match="2 of 4 words from address 20: it stopped at address 22") as caught:
        controller.configure({"band": 1, "cycle": 2, "delay": 5000, "filter": 3}, undo=False)

    assert isinstance(caught.value.__cause__, PartialWrite)
    assert (caught.value.report.written, caught.value.report.not_written) == (("band", "cycle"), ("delay", "filter"))
    assert "delay" in str(caught.value)


def test_a_value_that_is_half_written_is_unknown(
    controller: Any, device: SimulatedDevice, monkeypatch: pytest.MonkeyPatch
) -> None:
    take = device.handle

    def stop(pdu: bytes) -> bytes | None:
        return take(pdu) and (pdu[:3] + b"\0\3") if pdu[0] == 16 else take(pdu)

    monkeypatch.setattr(device, "handle", stop)
    with pytest.raises(NotConfigured, match="3 of 4 words") as caught:
        controller.configure({"total": 1, "goal": 2}, undo=False)
    assert (caught.value.report.written, caught.value.report.unknown) == (("total",), ("goal",))


def test_a_value_that_the_device_changes_undoes_all(
    controller: Any, device: SimulatedDevice, monkeypatch: pytest.MonkeyPatch
) -> None:
    take = device.handle

    def clip(pdu: bytes) -> bytes | None:
        answer = take(pdu)
        if device.peek("delay") == 700:
            device.poke("delay", 600)
        return answer

    monkeypatch.setattr(device, "handle", clip)
    with pytest.raises(NotConfigured, match=r"delay holds 600 \(words \[600\]\), sent was 700") as caught:
        controller.configure({"band": 50, "delay": 700, "span_low": 5})
    assert [device.peek(path) for path in ("band", "delay", "span_low")] == [10, 0, 0]
    assert caught.value.report.paths(Fate.RESTORED) == ("band", "delay", "span_low")
    assert (device.commands_run, device.pending) == (("commit", "commit"), ())


def test_what_an_undoing_writes_to_a_memory_that_wears_is_counted(controller: Any) -> None:
    def stop(progress: Progress) -> None:
        if progress.what == "mode":
            raise KeyboardInterrupt

    with pytest.raises(NotConfigured):
        controller.configure({"band": 50, "mode": 1}, tell=stop)
    assert written(controller) == [(20, (50,)), (20, (10,))]
    assert controller.wear["band"] == (2, 0)


def test_breaking_off_is_undone(controller: Any, device: SimulatedDevice) -> None:
    def stop(progress: Progress) -> None:
        if progress.what == "mode":
            raise KeyboardInterrupt

    with pytest.raises(NotConfigured, match="KeyboardInterrupt") as caught:
        controller.configure({"band": 50, "mode": 1}, tell=stop)
    assert isinstance(caught.value.__cause__, KeyboardInterrupt)
    assert (device.peek("band"), device.peek("mode")) == (10, 0)


def test_undoing_a_unit_of_measure_gives_back_what_it_converted(kiln: Any, direct: Any) -> None:
    fates = {4: "missed"}  # degrees, high_limit, setpoint, horn
    device, report, error, _ = broken(
        kiln,
        direct,
        values={"degrees": 1, "high_limit": 900, "setpoint": 800, "horn": 1},
        fate=fates,
        writes_only=True,
    )
    assert error is not None
    assert [device.peek(path) for path in ("degrees", "high_limit", "setpoint")] == [0, 2000, 70]
    assert report.unknown == ("horn",)


def test_asyncio_drivers_configure_as_well(kiln: Any, device: SimulatedDevice, direct: Any) -> None:
    class Awaited(direct):  # type: ignore[misc] # a class from a fixture
        async def call(self, unit: int, request: Any) -> Any:
            return super().call(unit, request)

    async def talk() -> WriteReport:
        from regscribe_runtime.link.locks import AsyncTurns  # noqa: PLC0415 (beside its only use)

        link = Awaited(device)
        link.lock = AsyncTurns()
        report: WriteReport = await kiln.module.AsyncKilnOne(link, unit=1).configure(MANY, confirm=True)
        return report

    assert len(asyncio.run(talk()).written) == len(MANY) - 1


@pytest.mark.parametrize("arrives", [True, False])
def test_a_cancelled_task_tells_what_it_left_and_the_next_one_completes_it(
    kiln: Any,
    device: SimulatedDevice,
    direct: Any,
    arrives: bool,  # noqa: FBT001 (a parameter of the test)
) -> None:
    values = {"setpoint": 100, "horn": 1}

    class Hanging(direct):  # type: ignore[misc] # a class from a fixture
        writes, hung = 0, asyncio.Event()

        async def call(self, unit: int, request: Any) -> Any:
            self.writes += request.function in WRITES
            if self.writes != 2 or self.hung.is_set():
                return super().call(unit, request)
            if arrives:
                super().call(unit, request)
            self.hung.set()
            return await asyncio.Event().wait()

    async def talk() -> None:
        from regscribe_runtime.link.locks import AsyncTurns  # noqa: PLC0415 (beside its only use)

        link = Hanging(device)
        link.lock = AsyncTurns()
        controller = kiln.module.AsyncKilnOne(link, unit=1)
        task = asyncio.create_task(controller.configure(values, confirm=True))
        await link.hung.wait()
        task.cancel()
        with pytest.raises(asyncio.CancelledError) as caught:
            await task
        left = controller.session.broken_off
        assert (len(left.written), len(left.unknown), {*left.written, *left.unknown}) == (1, 1, {*values})
        assert f"written: {left.written[0]}; unknown: {left.unknown[0]}" in caught.value.__notes__[0]
        await controller.configure(values, confirm=True)
        assert {path: device.peek(path) for path in values} == values

    asyncio.run(talk())


def test_registers_know_what_stays_and_in_which_order_groups_are_written(kiln: Any) -> None:
    cls = kiln.driver("One")
    assert cls.own_address.stays == "address"
    assert cls.trim_low.stays == "calibration"
    assert not cls.trim_low.moved(1, "x.trim_low").is_configuration or isinstance(cls.trim_low, ReadWrite)
    assert {name: group.order for name, group in vars(cls.groups).items() if hasattr(group, "order")} == {
        "line": 1,
        "units": 2,
        "setup": 3,
        "input": 4,
        "trim": None,
        "run": None,
        "identity": None,
        "goals": None,
    }
