"""What the manuals say that the controllers do by themselves, on the simulated devices of the real maps."""

import struct
from fractions import Fraction

import pytest

from regscribe.simulate import SimulatedDevice, find_map


def ask(device: SimulatedDevice, function: int, address: int, word: int) -> bytes:
    answer = device.handle(struct.pack(">BHH", function, address, word & 0xFFFF))
    assert answer is not None
    return answer


def put(device: SimulatedDevice, address: int, *words: int) -> bytes:
    """Function 16; the answer."""
    answer = device.handle(struct.pack(f">BHHB{len(words)}H", 16, address, len(words), 2 * len(words), *words))
    assert answer is not None
    return answer


@pytest.fixture
def athena() -> SimulatedDevice:
    return SimulatedDevice(find_map("athena/series-c"), "16C")


def test_a_setpoint_of_100_fahrenheit_becomes_37_8_celsius(athena: SimulatedDevice) -> None:  # 1.3.2 footnote 16
    athena.poke("setpoint_eeprom_and_ram", 100)
    ask(athena, 6, 4070, 2)
    assert athena.peek("setpoint_eeprom_and_ram") == Fraction("37.8")
    assert athena.peek("output_1_proportional_band") == Fraction("55.6")


def test_linear_values_are_not_converted(athena: SimulatedDevice) -> None:
    athena.poke("input_type", 14)
    ask(athena, 6, 4070, 2)
    assert athena.peek("setpoint_ram") == 77


def test_the_eeprom_setpoint_is_written_to_ram_with_power(athena: SimulatedDevice) -> None:  # 4.14.1.2
    ask(athena, 6, 1, 200)
    ask(athena, 6, 2, 300)
    assert [athena.peek(path) for path in ("setpoint_eeprom_and_ram", "setpoint_ram", "active_setpoint")] == [
        200,
        300,
        300,
    ]
    athena.power_cycle()
    assert [athena.peek(path) for path in ("setpoint_eeprom_and_ram", "setpoint_ram", "active_setpoint")] == [
        200,
        200,
        200,
    ]
    assert athena.wear == {"setpoint_eeprom_and_ram": 1}


def test_a_recipe_decides_the_active_setpoint(athena: SimulatedDevice) -> None:  # 4.14.1.6
    athena.poke("recipe_setpoint", 123)
    for mode, active in ((5, 123), (3, 77), (6, 123), (1, 77)):
        athena.poke("operating_mode", mode)
        assert athena.peek("active_setpoint") == active


def test_the_second_setpoint_counts_while_the_contact_is_closed(athena: SimulatedDevice) -> None:
    athena.poke("second_setpoint_ram", 150)
    athena.poke("contact_digital_input_state", "switch_active")
    assert athena.peek("active_setpoint") == 77
    athena.poke("contact_digital_input_function", 2)
    assert athena.peek("active_setpoint") == 150


def test_manual_control_begins_where_the_output_was(athena: SimulatedDevice) -> None:  # 4.15.2 note 2
    athena.poke("output_1_output_percent", 42)
    ask(athena, 6, 4004, 1)
    assert athena.peek("manual_control_output_1_percent") == 42


@pytest.mark.parametrize(("model", "unit"), [("16C", 1), ("1ZC", 9)])
def test_loading_the_defaults_spares_the_address_of_a_1zc_only(model: str, unit: int) -> None:  # 7.2.1
    device = SimulatedDevice(find_map("athena/series-c"), model)
    device.poke("controller_id", 9)
    device.poke("auto_reset", 120)
    put(device, 7000, 85, 92)
    assert (device.peek("controller_id"), device.peek("auto_reset")) == (unit, 0)


def test_a_calibration_without_its_signal_leaves_zero_and_one(athena: SimulatedDevice) -> None:  # 7.3.2 and 7.3.4
    athena.poke("thermocouple_span_adjustment", "1.5")
    put(athena, 7002, 85, 92)
    put(athena, 7004, 85, 92)
    assert (athena.peek("thermocouple_zero_offset"), athena.peek("thermocouple_span_adjustment")) == (0, 1)
    assert athena.peek("rtd_zero_offset") == 9000


def test_a_latched_alarm_and_its_led_are_cleared_by_the_command(athena: SimulatedDevice) -> None:  # 7.4
    for path, value in {"alarm_1_action": "latched", "alarm_1_process_setpoint": 200, "process_value": 250}.items():
        athena.poke(path, value)
    athena.advance(1)
    athena.poke("process_value", 100)
    athena.advance(1)
    bits = ("status_byte.alarm_1_active", "led_status_indicator_byte.a1_on")
    assert [athena.peek(path) for path in bits] == [1, 1]
    put(athena, 7006, 85, 92)
    assert [athena.peek(path) for path in bits] == [0, 0]


@pytest.mark.parametrize(("name", "model"), [("c10-m10", "C10"), ("c10-m10", "M10"), ("m300", "M300")])
def test_the_computer_setpoint_is_lost_without_power(name: str, model: str) -> None:  # 5.6
    device = SimulatedDevice(find_map(f"athena/platinum-{name}"), model)
    ask(device, 6, 4, 500)
    ask(device, 6, 1, 700)
    assert [device.peek(path) for path in ("setpoint", "target_setpoint", "local_setpoint")] == [700, 700, 500]
    ask(device, 6, 4, 510)
    assert device.peek("setpoint") == 700
    device.power_cycle()
    assert [device.peek(path) for path in ("setpoint", "target_setpoint", "local_setpoint")] == [510, 510, 510]
    assert device.wear == {"local_setpoint": 2}


def test_an_equal_value_is_not_written_to_the_eeprom_again() -> None:  # 5.6
    platinum = SimulatedDevice(find_map("athena/platinum-m300"), "M300")
    for word in (500, 500, 510, 510):
        ask(platinum, 6, 4, word)
    assert platinum.wear == {"local_setpoint": 2}


def test_a_write_at_the_second_address_is_one_to_the_computer_setpoint() -> None:  # 8.3 note 1
    device = SimulatedDevice(find_map("athena/platinum-m300"), "M300")
    ask(device, 6, 3, 700)
    ask(device, 6, 4, 500)
    assert [device.peek(path) for path in ("setpoint", "target_setpoint", "local_setpoint")] == [700, 700, 500]


@pytest.mark.parametrize(
    ("name", "model"), [("c10-m10", "C10"), ("m300", "M300"), ("m400", "M400"), ("x100-x400", "X400")]
)
def test_configuration_takes_effect_with_55aah_only(name: str, model: str) -> None:  # 7.4 note 4
    device = SimulatedDevice(find_map(f"athena/platinum-{name}"), model)
    ask(device, 6, 106, 900)
    assert ask(device, 3, 106, 1)[2:] == ask(device, 4, 106, 1)[2:] == struct.pack(">H", 900)
    assert ask(device, 3, 11, 1)[2:] == struct.pack(">H", 0)
    assert ask(device, 6, 120, 0x55AB)[0] == 0x86
    assert ask(device, 6, 120, 0x55AA) == struct.pack(">BHH", 6, 120, 0x55AA)
    assert ask(device, 3, 11, 1)[2:] == struct.pack(">H", 900)


def test_function_07_shows_the_first_bits() -> None:  # 10.2
    device = SimulatedDevice(find_map("athena/platinum-m5000"), "M5000")
    ask(device, 5, 0, 0xFF00)
    ask(device, 5, 1, 0xFF00)
    device.poke("al1_alarm_status", 1)
    assert device.handle(b"\x07") == bytes((7, 0b0001_0011))


def test_the_output_is_written_in_manual_mode_only() -> None:  # 10.6 note 1
    device = SimulatedDevice(find_map("athena/platinum-m5000"), "M5000")
    assert ask(device, 6, 2, 50) == b"\x86\x07"
    ask(device, 5, 1, 0xFF00)
    assert ask(device, 6, 2, 50)[0] == 6


def test_the_local_setpoint_stands_at_two_addresses() -> None:  # 12.6 note 3
    device = SimulatedDevice(find_map("athena/platinum-x5000"), "X5000")
    ask(device, 6, 3, 300)
    assert ask(device, 3, 4, 1)[2:] == struct.pack(">H", 300)
    ask(device, 6, 4, 310)
    assert ask(device, 3, 3, 1)[2:] == struct.pack(">H", 310)
    assert [device.peek(path) for path in ("target_setpoint", "setpoint")] == [310, 310]


@pytest.fixture
def fdc() -> SimulatedDevice:
    return SimulatedDevice(find_map("fdc/series-100"), "BTC-9100", givens={"linear_inputs": {16}})


def test_codes_written_to_cmnd_change_the_mode(fdc: SimulatedDevice) -> None:  # 7-5
    assert ask(fdc, 6, 66, 1000) == b"\x86\x03"
    for code, mode in ((26663, 0x0300), (26664, 0x0200), (26661, 0)):
        ask(fdc, 6, 72, code)
        assert ask(fdc, 3, 70, 1)[2:] == struct.pack(">H", mode)
    ask(fdc, 6, 72, 26663)
    assert ask(fdc, 6, 66, 1000)[0] == 6


def test_calibration_is_locked_until_its_code_comes(fdc: SimulatedDevice) -> None:  # 7-5 example 7
    assert ask(fdc, 6, 52, 20000) == b"\x86\x03"
    ask(fdc, 6, 72, 26669)
    assert ask(fdc, 6, 52, 20000)[0] == 6


def test_the_current_set_point_is_that_of_sp1(fdc: SimulatedDevice) -> None:  # 7-3
    ask(fdc, 6, 0, 0x4F19 + 100)
    assert ask(fdc, 3, 65, 1) == ask(fdc, 3, 129, 1) == bytes((3, 2)) + struct.pack(">H", 0x4F19 + 100)
