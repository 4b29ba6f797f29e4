"""Writing what governs the line: the driver follows the device, or says where it was left."""

import asyncio
import os
import struct
import termios
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from regscribe.simulate import SimulatedDevice, simulate
from regscribe_runtime import LeftAt, NoAnswer, NotWritten, ReadBackDiffers, ValueRefused, WriteFailed

from .conftest import KILN, AsyncDirectLink

BAUDS = {0: termios.B4800, 1: termios.B9600}


@pytest.fixture(autouse=True)
def no_waiting(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("regscribe_runtime.operations.read_back.LOOKS", (0.0, 0.0))


@pytest.fixture
def device(kiln: Any) -> SimulatedDevice:
    return SimulatedDevice(kiln.map, "One", unit=1)


@pytest.fixture
def controller(kiln: Any, direct: Any, device: SimulatedDevice) -> Any:
    return kiln.driver("One")(direct(device), unit=1)


def test_the_driver_follows_a_new_unit_id(controller: Any, device: SimulatedDevice) -> None:
    controller.own_address.write(7, confirm=True)

    assert (device.unit, controller.session.unit) == (7, 7)
    controller.band.write(20)
    assert controller.band.read() == 20


def test_a_simulated_device_shows_its_unit_id_and_keeps_to_it(kiln: Any) -> None:
    assert SimulatedDevice(kiln.map, "One", unit=9).peek("own_address") == 9


@pytest.mark.parametrize("fate", ["lost", "garbled"])
def test_a_lost_answer_does_not_keep_the_driver_from_following(
    kiln: Any, direct: Any, device: SimulatedDevice, fate: str
) -> None:
    controller = kiln.driver("One")(direct(device, fate={1: fate}, writes_only=True), unit=1)
    controller.own_address.write(7, confirm=True)
    assert controller.own_address.read() == 7


def test_a_write_that_never_arrived_leaves_all_as_it_was(kiln: Any, direct: Any, device: SimulatedDevice) -> None:
    controller = kiln.driver("One")(direct(device, fate={1: "missed"}, writes_only=True), unit=1)
    with pytest.raises(
        NotWritten, match=r"own_address: the device still talks as before \(unit 1, 9600 baud"
    ) as caught:
        controller.own_address.write(7, confirm=True)

    assert isinstance(caught.value, NoAnswer)
    assert controller.own_address.read() == 1


def test_a_device_that_is_found_nowhere_is_told_with_both_settings(
    kiln: Any, direct: Any, device: SimulatedDevice
) -> None:
    fates = dict.fromkeys(range(3, 60), "missed")  # after the look at the new id and the write
    controller = kiln.driver("One")(direct(device, fate=fates), unit=1)
    with pytest.raises(LeftAt) as caught:
        controller.own_address.write(7, confirm=True)

    assert "not found" in str(caught.value)
    assert caught.value.before == "unit 1, 9600 baud, format 8N1, modbus addresses"
    assert caught.value.asked == "unit 7"
    assert controller.session.unit == 1


def test_a_unit_id_at_which_another_device_answers_is_refused(kiln: Any, direct: Any, device: SimulatedDevice) -> None:
    other = SimulatedDevice(kiln.map, "One", unit=7)

    class Two(direct):  # type: ignore[misc] # a class from a fixture
        def call(self, unit: int, request: Any) -> Any:
            self.device = other if unit == 7 else device
            return super().call(unit, request)

    controller = kiln.driver("One")(Two(device), unit=1)
    with pytest.raises(ValueRefused, match="unit 7 answers already"):
        controller.own_address.write(7, confirm=True)
    assert controller.own_address.read() == 1


BARE = KILN.replace("range: 1..50, default: 1, stays: address", "default: 2, stays: address")
BARE = BARE.replace("unit_ids: 1..50", "unit_ids: 2..31")


@pytest.mark.parametrize("unit", [0, 1, 32, 300])
def test_a_unit_id_that_the_device_cannot_have_is_refused_before_anything_is_sent(
    build: Any, direct: Any, unit: int
) -> None:
    bare = build(BARE)
    device = SimulatedDevice(bare.map, "One", unit=2)
    link, other = direct(device), AsyncDirectLink(device)
    controller, twin = bare.driver("One")(link, unit=2), bare.module.AsyncKilnOne(other, unit=2)

    with pytest.raises(ValueRefused, match="is no unit id of this device: they are 2 to 31"):
        controller.own_address.write(unit, confirm=True)
    with pytest.raises(ValueRefused, match="is no unit id of this device"):
        asyncio.run(twin.own_address.write(unit, confirm=True))
    assert (link.log, other.log) == ([], [])
    with pytest.raises(ValueRefused, match="is no unit id of this device"):
        controller.configure({"own_address": unit, "band": 20}, confirm=True)
    assert (device.unit, device.peek("band"), controller.session.unit, twin.session.unit) == (2, 10, 2, 2)
    controller.own_address.write(31, confirm=True)
    assert (device.unit, controller.session.unit) == (31, 31)


def test_the_driver_talks_as_before_whatever_breaks_a_change_of_the_line_off(
    kiln: Any, direct: Any, device: SimulatedDevice
) -> None:
    def broken(kind: Any) -> Any:
        class Broken(kind):  # type: ignore[misc] # a class from a parameter
            def call(self, unit: int, request: Any) -> Any:
                if unit == 7:
                    raise struct.error
                return super().call(unit, request)

        return Broken(device)

    controller = kiln.driver("One")(broken(direct), unit=1)
    with pytest.raises(struct.error):
        controller.own_address.write(7, confirm=True)
    assert (controller.session.unit, controller.band.read()) == (1, 10)

    twin = kiln.module.AsyncKilnOne(broken(AsyncDirectLink), unit=1)
    with pytest.raises(struct.error):
        asyncio.run(twin.own_address.write(7, confirm=True))
    assert (twin.session.unit, asyncio.run(twin.band.read())) == (1, 10)


def test_the_driver_follows_addresses_that_are_counted_from_one(controller: Any, device: SimulatedDevice) -> None:
    controller.counting.write(1, confirm=True)

    assert controller.link.addressing == "jbus"
    assert controller.serial_number.read() == "KL01"
    controller.counting.write(0, confirm=True)
    assert controller.link.addressing == "modbus"
    assert device.peek("counting") == 0


def test_neighbours_are_not_taken_for_a_device_that_counts_otherwise(
    kiln: Any, direct: Any, device: SimulatedDevice
) -> None:
    """The register behind holds the value that was sent, and the write never arrived."""
    device.poke("parity_code", 1)
    controller = kiln.driver("One")(direct(device, fate={1: "missed"}, writes_only=True), unit=1)

    with pytest.raises(NotWritten, match="still talks as before"):
        controller.counting.write(1, confirm=True)
    assert controller.link.addressing == "modbus"


def test_a_setting_whose_codes_are_not_printed_is_looked_for_in_all_that_the_line_can_be(
    controller: Any, device: SimulatedDevice
) -> None:
    controller.parity_code.write(2, confirm=True)  # the simulated line has no parity: it is found as before
    assert (device.peek("parity_code"), controller.link.line.parity) == (2, "N")


def test_a_device_that_ignores_a_new_setting_is_told(
    controller: Any, device: SimulatedDevice, monkeypatch: pytest.MonkeyPatch
) -> None:
    take = device.handle

    def ignore(pdu: bytes) -> bytes | None:
        return pdu if pdu[0] == 6 else take(pdu)

    monkeypatch.setattr(device, "handle", ignore)
    with pytest.raises(ReadBackDiffers, match="own_address: 7 was sent"):
        controller.own_address.write(7, confirm=True)


@contextmanager
def hearing_at_its_speed(kiln: Any) -> Iterator[Any]:
    """A simulated device on a pty that answers only a port that is set to the speed of its register."""
    found: list[Any] = []

    async def deaf(exchange: Any) -> bytes:
        port = os.open(found[0].path, os.O_RDWR | os.O_NOCTTY)
        try:
            speed = termios.tcgetattr(port)[4]
        finally:
            os.close(port)
        frame: bytes = exchange.frame
        return frame if speed == BAUDS[int(found[0].device.peek("speed"))] else b""

    with simulate(kiln.map, "One", unit=1, transport="pty", delivery=deaf) as running:
        found.append(running)
        yield running


def test_the_driver_follows_a_new_speed_of_the_serial_line(kiln: Any) -> None:
    with (
        hearing_at_its_speed(kiln) as running,
        kiln.driver("One").rtu(running.path, unit=1, baud=9600, timeout=0.15, echo=False) as controller,
    ):
        controller.speed.write(0, confirm=True)
        assert controller.link.line.baud == 4800
        assert controller.band.read() == 10
        controller.configure({"speed": 1, "band": 33}, confirm=True)
        assert (controller.link.line.baud, controller.band.read()) == (9600, 33)


def test_a_gateway_whose_speed_nobody_can_set_keeps_the_device_in_reach(kiln: Any) -> None:
    with (
        simulate(kiln.map, "One", unit=1) as running,
        kiln.driver("One").tcp(running.host, port=running.port, unit=1, timeout=0.2) as controller,
    ):
        controller.speed.write(0, confirm=True)
        controller.own_address.write(8, confirm=True)
        assert (controller.own_address.read(), running.device.peek("speed")) == (8, 0)


def test_what_governs_the_line_is_written_last_in_a_configuration(controller: Any) -> None:
    report = controller.configure({"own_address": 5, "band": 77, "setpoint": 80}, confirm=True)

    assert report.written == ("band", "setpoint", "own_address")
    assert controller.band.read() == 77


def test_a_configuration_whose_line_gets_lost_is_reported(kiln: Any, direct: Any, device: SimulatedDevice) -> None:
    controller = kiln.driver("One")(direct(device, fate={2: "missed"}, writes_only=True), unit=1)
    with pytest.raises(WriteFailed, match="still talks as before") as caught:
        controller.configure({"own_address": 5, "band": 77}, confirm=True)

    assert caught.value.report.not_written == ("band", "own_address")  # type: ignore[attr-defined] # NotConfigured
    assert (device.unit, device.peek("band")) == (1, 10)
