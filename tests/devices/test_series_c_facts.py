"""Facts of the manuals of Series C and CN8200 (the same controllers), as bytes on the wire of simulated ones.

Sections are those of Athena's manual; in Omega's each chapter counts one more.
"""

import re
import struct
from collections.abc import Iterator
from typing import Any

import pytest

from regscribe.simulate import SimulatedDevice, ThermalProcess, find_map, simulate
from regscribe_devices.athena.series_c import Athena16C
from regscribe_devices.omega.cn8200 import OmegaCN8200
from regscribe_runtime import ValueRefused

COMPACT = [("athena/series-c", "16C", Athena16C), ("omega/cn8200", "CN8200", OmegaCN8200)]
IDS = [model for _, model, _ in COMPACT]

TEMPERATURE_DECIMALS, LINEAR = 4068, 14


class Bench:
    """A simulated controller and a driver of it."""

    def __init__(self, device: Any, driver: Any) -> None:
        self.device, self.driver = device, driver

    def holds(self, **values: float) -> None:
        for path, value in values.items():
            self.device.poke(path, value)

    def sent(self) -> list[bytes]:
        """What was written since the start, as function and data."""
        return [request for request in map(bytes, self.device.requests) if request[0] in (6, 16)]


@pytest.fixture(params=COMPACT, ids=IDS)
def bench(request: pytest.FixtureRequest) -> Iterator[Bench]:
    path, model, driver = request.param
    with simulate(path, model) as device, driver.tcp(device.host, port=device.port, unit=1) as controller:
        yield Bench(device, controller)


@pytest.fixture(params=COMPACT, ids=IDS)
def device(request: pytest.FixtureRequest) -> SimulatedDevice:
    path, model, _ = request.param
    return SimulatedDevice(find_map(path), model)


def put(device: SimulatedDevice, address: int, *words: int) -> None:
    answer = device.handle(struct.pack(f">BHHB{len(words)}H", 16, address, len(words), 2 * len(words), *words))
    assert answer == struct.pack(">BHH", 16, address, len(words))


def read(device: SimulatedDevice, address: int, count: int = 1) -> tuple[int, ...]:
    answer = device.handle(struct.pack(">BHH", 3, address, count))
    assert answer is not None
    assert answer[:2] == bytes((3, 2 * count))
    return struct.unpack(f">{count}H", answer[2:])


@pytest.mark.parametrize("value", [150.5, 150.55, 150.123])
def test_no_decimal_is_written_while_the_position_for_temperatures_is_0(bench: Bench, value: float) -> None:
    with pytest.raises(ValueRefused, match="resolution 1"):  # 3.2.1, 3.9.2.1, note 2 of 4.4.2
        bench.driver.setpoint_ram.write(value)
    assert bench.sent() == []


def test_one_decimal_is_written_while_the_position_for_temperatures_is_1(bench: Bench) -> None:
    bench.holds(temperature_decimal_position=1)
    for refused in (150.55, 150.123):
        with pytest.raises(ValueRefused, match=r"resolution 0\.1"):
            bench.driver.setpoint_ram.write(refused)
    bench.driver.setpoint_ram.write(150.5)  # 43168000, the low word first
    assert bench.sent() == [bytes.fromhex("10 1F44 0002 04 8000 4316")]


@pytest.mark.parametrize(("position", "stored"), [(0, (0x0000, 0x4317)), (1, (0x999A, 0x4316))])
def test_the_controller_keeps_as_many_decimals_as_the_position_says(
    device: SimulatedDevice, position: int, stored: tuple[int, int]
) -> None:
    put(device, TEMPERATURE_DECIMALS, position)
    put(device, 8004, 0x8CCD, 0x4316)  # 150.55 is 43168CCD: 151 is 43170000, 150.6 is 4316999A
    assert read(device, 8004, 2) == stored


@pytest.mark.parametrize(("position", "stored"), [(0, (0x0000, 0x428C)), (1, (0x999A, 0x428C))])
def test_the_process_value_has_as_many_decimals_as_the_position_says(position: int, stored: tuple[int, int]) -> None:
    oven = ThermalProcess(ambient=70.3, dead_time=1000)  # 70 is 428C0000, 70.3 428C999A (note 2 of 4.4.2)
    device = SimulatedDevice(find_map("athena/series-c"), "16C", process=oven)
    put(device, TEMPERATURE_DECIMALS, position)
    device.advance(10)
    assert read(device, 8000, 2) == stored


def test_what_is_stored_stays_when_the_position_changes(device: SimulatedDevice) -> None:
    put(device, TEMPERATURE_DECIMALS, 1)
    put(device, 8004, 0x8000, 0x4316)
    put(device, TEMPERATURE_DECIMALS, 0)
    assert read(device, 8004, 2) == (0x8000, 0x4316)
    refused = device.handle(struct.pack(">BHHB2H", 16, 8004, 2, 4, 0x4000, 0x461C))  # 10000 is above every limit
    assert refused == bytes.fromhex("90 03")
    assert read(device, 8004, 2) == (0x8000, 0x4316)


def test_a_rate_and_a_reset_have_one_decimal_at_most_with_a_linear_input(bench: Bench) -> None:
    bench.holds(input_type=LINEAR, linear_decimal_position=2)  # note 1 of 4.6.2
    for register, value in (("rate", 0.05), ("rate", 0.95), ("auto_reset", 0.05), ("auto_reset", 0.95)):
        with pytest.raises(ValueRefused, match=r"resolution 0\.1"):
            getattr(bench.driver, register).write(value)
    assert bench.sent() == []
    bench.driver.rate.write(0.5)
    assert bench.sent() == [bytes.fromhex("10 1F56 0002 04 0000 3F00")]


@pytest.mark.parametrize(
    ("register", "value"),
    [("manual_reset", 0.5), ("rate", 0.5), ("input_filter", 1.5), ("auxiliary_output_scale_low", 0.5)],
)
def test_position_0_is_imposed_on_every_value_with_a_linear_input(bench: Bench, register: str, value: float) -> None:
    bench.holds(input_type=LINEAR, linear_decimal_position=0)  # note 4 of 4.4.2
    with pytest.raises(ValueRefused, match="resolution 1"):
        getattr(bench.driver, register).write(value)
    assert bench.sent() == []


def test_a_manual_reset_of_a_half_needs_a_position(bench: Bench) -> None:
    bench.holds(input_type=LINEAR, linear_decimal_position=1)
    bench.driver.manual_reset.write(0.5)  # FV keeps its point: 3F000000
    assert bench.sent() == [bytes.fromhex("10 1F5A 0002 04 0000 3F00")]


def test_calibration_values_have_as_many_decimals_as_they_need(bench: Bench) -> None:
    bench.driver.thermocouple_span_adjustment.write(1.25, confirm=True)  # 4.12.2 starts at 0.001; 3FA00000
    assert bench.sent() == [bytes.fromhex("10 1F96 0002 04 0000 3FA0")]


def test_a_cycle_time_of_zero_seconds_does_not_exist(bench: Bench) -> None:
    for cycle_time in (bench.driver.output_1_cycle_time, bench.driver.output_2_cycle_time):
        with pytest.raises(ValueRefused, match=r"0 is the device's code for 0\.2"):
            cycle_time.write(0)
    assert bench.sent() == []
    bench.driver.output_1_cycle_time.write(0.2)
    assert bench.sent() == [bytes.fromhex("06 0FD8 0000")]


def test_a_controller_that_answers_has_the_modbus_protocol(device: SimulatedDevice) -> None:
    assert read(device, 4080) == (4,)


def test_the_access_level_is_delivered_as_5_and_6_after_loading_the_defaults(device: SimulatedDevice) -> None:
    assert read(device, 4005) == (5,)  # 4.13.2
    put(device, 7000, 85, 92)
    assert read(device, 4005) == (6,)
    assert read(device, 4080) == (4,)


@pytest.mark.parametrize(("path", "model"), [(path, model) for path, model, _ in COMPACT], ids=IDS)
def test_texts_that_both_maps_share_cite_no_section_of_one_manual(path: str, model: str) -> None:
    one = find_map(path).model(model)
    inferred = [part for owner in (*one.registers, *one.program_notes) for part in owner.inferred]
    texts = [
        *(owner.description for owner in (*one.registers, *one.commands, *one.program_notes, *one.groups)),
        *(text for part in inferred for text in (part.what, part.why)),
    ]
    assert inferred
    assert [text for text in texts if re.search(r"\b[1-8](\.\d+){1,4}\b(?! ?s\b)", text)] == []
