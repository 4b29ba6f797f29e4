"""Requests and answers in the names of the map."""

import struct

import pytest

from regscribe.model import RegisterMap
from regscribe.simulate import Exchange, Frame, SimulatedDevice, Told, find_map, tell


def told(pdu: bytes, *devices: SimulatedDevice, unit: int = 1) -> Told:
    """What becomes of a request to the first device that has this unit."""
    device = next((each for each in devices if each.unit == unit), None)
    answer = device.handle(pdu) if device is not None else None
    return tell(devices, Exchange(Frame(unit, pdu), answer, b""))


@pytest.fixture
def device(furnace: RegisterMap) -> SimulatedDevice:
    return SimulatedDevice(furnace, "F1")


def test_a_read_is_told_by_names_values_and_units(device: SimulatedDevice) -> None:
    device.poke("process_value", "98.5")
    device.poke("mode", "standby")
    assert told(struct.pack(">BHH", 3, 0, 2), device).what == "process_value = 98.5 °F, setpoint = 100 °F"
    assert told(struct.pack(">BHH", 3, 5, 1), device) == Told(1, "read", "mode = STANDBY", "ok", good=True)


def test_a_write_is_told_with_what_is_written(device: SimulatedDevice) -> None:
    assert told(struct.pack(">BHH", 6, 1, 1505), device).what == "setpoint = 150.5 °F"
    several = told(struct.pack(">BHHBHH", 16, 1, 2, 4, 1200, 1300), device)
    assert (several.verb, several.what) == ("write", "setpoint = 120 °F, setpoint_ram = 130 °F")


def test_a_refusal_is_told_with_the_devices_own_meaning() -> None:
    device = SimulatedDevice(find_map("athena/series-c"), "16C")
    refused = told(struct.pack(">BHH", 6, 4004, 77), device)
    assert (refused.what, refused.outcome, refused.good) == ("operating_mode = 77", "exception 3: invalid data", False)
    silent = told(struct.pack(">BHH", 3, 0, 25), device)
    assert (silent.outcome, silent.good) == ("no answer", False)


def test_views_and_long_requests_are_told_briefly() -> None:
    device = SimulatedDevice(find_map("athena/series-c"), "16C")
    device.poke("process_value", "151.3")
    found = told(struct.pack(">BHH", 3, 8000, 4), device).what
    assert found == "process_value (ieee) = 151.3 °F, setpoint_eeprom_and_ram (ieee) = 77 °F"
    assert told(struct.pack(">BHH", 3, 4070, 24), device).what.endswith(" and 18 more")


def test_flags_bits_and_functions_that_do_the_same_are_told() -> None:
    device = SimulatedDevice(find_map("athena/platinum-m300"), "M300")
    device.poke("main_output_condition", 1)
    assert told(struct.pack(">BHH", 2, 3, 1), device).what == "main_output_condition = ON"
    assert told(struct.pack(">BHH", 5, 10, 0xFF00), device).what == "keypad_lock = UNLOCKED"
    assert told(b"\x07", device).verb == "read status"


def test_other_units_broadcasts_and_unknown_functions_are_told(device: SimulatedDevice) -> None:
    assert told(struct.pack(">BHH", 3, 0, 1), device, unit=9).what == "a unit that is not here"
    assert told(struct.pack(">BHH", 6, 1, 900), device, unit=0) == Told(
        0, "write", "setpoint = 90 °F", "broadcast", good=True
    )
    assert told(b"\x0b", device).verb == "function 11"
    assert told(struct.pack(">BHH", 3, 500, 3), device).what == "holding 500..502"


@pytest.mark.parametrize("pdu", ["03", "0300", "10 0001 0002 04 00", "0f 0000 ffff 01 00", "05 0000 1234"])
def test_a_broken_request_is_told_all_the_same(device: SimulatedDevice, pdu: str) -> None:
    assert told(bytes.fromhex(pdu), device).unit == 1
