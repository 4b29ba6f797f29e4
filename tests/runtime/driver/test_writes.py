"""Single writes with a contract: checked, read back, spared, and known even when the answer is lost."""

import asyncio
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from regscribe.simulate import SimulatedDevice, simulate
from regscribe_runtime import (
    ConditionNotMet,
    LinkLost,
    NoAnswer,
    NotApplied,
    NotWritten,
    ReadBackDiffers,
    RegscribeError,
    ValueRefused,
    WriteUnknown,
    WrongAnswer,
)

Driver = Callable[..., Any]
WRITES = frozenset({6, 16})


@pytest.fixture(autouse=True)
def no_waiting(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("regscribe_runtime.operations.read_back.LOOKS", (0.0, 0.0))


@pytest.fixture
def device(kiln: Any) -> SimulatedDevice:
    return SimulatedDevice(kiln.map, "One", unit=1)


@pytest.fixture
def driver(kiln: Any, direct: Any, device: SimulatedDevice) -> Driver:
    """A driver whose nth request (or nth write) has a fate."""

    def make(**settings: Any) -> Any:
        return kiln.driver("One")(direct(device, **settings), unit=1)

    return make


def written(controller: Any) -> list[tuple[int, tuple[int, ...]]]:
    return [(asked.address, asked.words) for asked in controller.link.log if asked.function in WRITES]


def test_what_the_device_keeps_is_read_back_and_passing_operation_is_not(driver: Driver) -> None:
    controller = driver()

    controller.span_low.write(-7)
    assert controller.link.log[-1][:2] == (3, 30)
    controller.mode.write(1)
    assert controller.link.log[-1][:2] == (6, 51)


def test_reading_back_can_be_asked_for_and_left_out(driver: Driver) -> None:
    controller = driver()

    controller.mode.write(1, verify=True)
    assert controller.link.log[-1][:2] == (3, 51)
    controller.trim_low.write(3, confirm=True, verify=False)
    assert controller.link.log[-1][:2] == (6, 40)


def test_a_value_that_the_device_changes_is_an_error_with_both_values(
    driver: Driver, device: SimulatedDevice, monkeypatch: pytest.MonkeyPatch
) -> None:
    take = device.handle

    def clip(pdu: bytes) -> bytes | None:
        answer = take(pdu)
        if pdu[0] in WRITES:
            device.poke("band", 20)
        return answer

    monkeypatch.setattr(device, "handle", clip)
    with pytest.raises(ReadBackDiffers, match=r"band: 30 was sent .*the device holds 20") as caught:
        driver().band.write(30)
    assert (caught.value.register, caught.value.sent, caught.value.read) == ("band", (30,), (20,))


def test_an_equal_value_is_spared_and_counted(driver: Driver) -> None:
    controller = driver()
    controller.band.write(30)
    controller.band.write(30)
    controller.band.write(31)
    controller.cycle.write(5)

    assert controller.wear["band"] == (2, 1)
    assert (controller.wear.written, controller.wear.spared) == (2, 2)
    assert "setpoint" not in controller.wear


@pytest.mark.parametrize("fate", ["lost", "garbled"])
def test_a_lost_answer_to_a_write_that_was_carried_out_is_a_good_write(
    driver: Driver, device: SimulatedDevice, fate: str
) -> None:
    controller = driver(fate={1: fate}, writes_only=True)
    controller.setpoint.write(150)

    assert device.peek("setpoint") == 150
    assert written(controller) == [(50, (150,))]


@pytest.mark.parametrize(("fate", "kind"), [("missed", NoAnswer), ("gone", LinkLost)])
def test_a_write_that_never_arrived_is_not_written_and_never_sent_again(
    driver: Driver, device: SimulatedDevice, fate: str, kind: type[Exception]
) -> None:
    controller = driver(fate={1: fate}, writes_only=True)
    with pytest.raises(NotWritten, match=r"setpoint: the answer was lost .*it holds 70, not 150") as caught:
        controller.setpoint.write(150)

    assert isinstance(caught.value, kind)
    assert isinstance(caught.value.__cause__, kind)
    assert device.peek("setpoint") == 70
    assert len(written(controller)) == 1


@pytest.mark.parametrize("fate", ["lost", "missed", "garbled"])
def test_a_lost_write_of_a_register_that_cannot_be_read_is_unknown(driver: Driver, fate: str) -> None:
    controller = driver(fate={1: fate}, writes_only=True)
    with pytest.raises(WriteUnknown, match=r"horn: .*cannot be read back") as caught:
        controller.horn.write(3)

    assert isinstance(caught.value, WrongAnswer if fate == "garbled" else NoAnswer)
    assert len(written(controller)) == 1


def test_a_lost_write_is_unknown_when_nobody_answers_any_more(driver: Driver) -> None:
    controller = driver(fate={1: "lost", -1: "missed"}, writes_only=True)
    controller.link.fate.pop(-1)
    controller.setpoint.read()
    controller.link.fate[-1] = "missed"
    controller.session.memory.update(low_limit=0, high_limit=2000)

    with pytest.raises(WriteUnknown, match=r"setpoint: .*reading back fails too"):
        controller.run(_raw_setpoint(controller))


def _raw_setpoint(controller: Any) -> Any:
    from regscribe_runtime.operations import tasks  # noqa: PLC0415 (this one test skips the checks of a value)

    return tasks.write_raw(type(controller).setpoint, (150,), None)


def test_what_the_device_changes_by_itself_is_unknown_rather_than_not_written(driver: Driver) -> None:
    controller = driver(fate={1: "missed"}, writes_only=True)
    with pytest.raises(WriteUnknown, match=r"mode: .*the device changes it by itself"):
        controller.mode.write(1)


def test_a_read_back_that_fails_leaves_a_write_that_was_answered_unknown(driver: Driver) -> None:
    controller = driver()
    controller.span_low.read()
    controller.link.fate[controller.link.count + 4] = "missed"  # after what it holds, the write and its commit

    with pytest.raises(WriteUnknown, match="span_low: the device took it, but reading back fails"):
        controller.span_low.write(5)


def test_a_lost_command_is_unknown_and_not_sent_again(driver: Driver) -> None:
    controller = driver(fate={1: "lost"})
    with pytest.raises(WriteUnknown, match=r"commit: the answer was lost .*unknown"):
        controller.commands.commit()
    assert len(controller.link.log) == 1


def test_a_write_that_could_not_be_unlocked_is_not_written(driver: Driver, device: SimulatedDevice) -> None:
    controller = driver(fate={1: "missed"}, writes_only=True)
    with pytest.raises(NotWritten, match="trim_low: nothing was sent, because unlock_trim"):
        controller.trim_low.write(5, confirm=True)
    assert device.peek("trim_low") == 0


def test_a_write_that_could_not_be_applied_says_so(driver: Driver, device: SimulatedDevice) -> None:
    controller = driver(fate={2: "missed"}, writes_only=True)
    with pytest.raises(NotApplied, match="span_low: written, but not in effect: commit failed") as caught:
        controller.span_low.write(5)
    assert device.pending == ("span_low",)
    assert isinstance(caught.value, NoAnswer)


def test_a_condition_that_does_not_hold_is_told_before_anything_is_sent(driver: Driver) -> None:
    controller = driver()
    with pytest.raises(
        ConditionNotMet, match=r"^output_1: output 1 is writable in manual mode only; mode is NORMAL \(0\)$"
    ) as caught:
        controller.output_1.write(5)
    assert caught.value.present == {"mode": "NORMAL (0)"}
    assert written(controller) == []


def test_limits_are_read_from_the_device_at_every_write(driver: Driver, device: SimulatedDevice) -> None:
    controller = driver()
    controller.setpoint.write(1500)
    device.poke("high_limit", 1000)

    with pytest.raises(ValueRefused, match="0 to 1000"):
        controller.setpoint.write(1500)


@pytest.mark.parametrize("path", ["trim_low", "degrees", "own_address"])
def test_a_dangerous_write_says_what_will_happen_and_wants_confirmation(driver: Driver, path: str) -> None:
    controller = driver()
    danger = type(controller).registers[path].danger
    with pytest.raises(ValueRefused, match=f"{danger}.*confirm=True"):
        getattr(controller, path).write(1)
    assert controller.link.log == []


def test_changing_reads_modifies_and_writes(driver: Driver) -> None:
    controller = driver()
    assert controller.trim_low.change(lambda value: value + 4, confirm=True) == 4
    assert [asked.function for asked in controller.link.log] == [3, 6, 6, 3]  # read, unlock, write, read back
    assert "not one step of the device" in type(controller.trim_low).change.__doc__


@pytest.fixture
def over_tcp(kiln: Any) -> Iterator[Any]:
    with simulate(kiln.map, "One", unit=1) as running:
        yield running


def test_an_answer_dropped_on_the_line_is_found_out_over_tcp_too(kiln: Any) -> None:
    dropped = []

    async def drop(exchange: Any) -> bytes:
        if exchange.request.pdu[0] in WRITES and not dropped:
            dropped.append(exchange.request)
            return b""
        frame: bytes = exchange.frame
        return frame

    with simulate(kiln.map, "One", unit=1, delivery=drop) as running:
        with kiln.driver("One").tcp(running.host, port=running.port, unit=1, timeout=0.2) as controller:
            controller.band.write(44)
        assert running.device.peek("band") == 44
        assert sum(request[0] in WRITES for request in running.requests) == 1
    assert dropped


def test_the_asyncio_driver_has_the_same_contract(kiln: Any, over_tcp: Any) -> None:
    async def talk() -> Any:
        async with kiln.module.AsyncKilnOne.tcp(over_tcp.host, port=over_tcp.port, unit=1) as controller:
            await controller.band.write(12)
            await controller.band.write(12)
            with pytest.raises(ConditionNotMet):
                await controller.output_1.write(5)
            report = await controller.configure({"setpoint": 500, "high_limit": 600})
            return controller.wear.spared, report.written

    assert asyncio.run(talk()) == (1, ("high_limit", "setpoint"))


def test_all_errors_of_writes_are_errors_of_the_one_tree() -> None:
    for kind in (NotWritten, WriteUnknown, ReadBackDiffers, NotApplied, ConditionNotMet):
        assert issubclass(kind, RegscribeError)
