"""The process in simulated time: an oven with dead time, PID and on/off, ramps, alarms; the same at every run."""

import math
import struct
import time
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from regscribe.model import RegisterMap
from regscribe.reference import choose
from regscribe.simulate import LOW_FAULT, SimulatedDevice, SimulatorError, ThermalProcess, find_map, simulate

OVEN = ThermalProcess(ambient=70, gain=400, time_constant=60, dead_time=4)
MAPS = Path(__file__).parents[3] / "maps"
Make = Callable[..., SimulatedDevice]


@pytest.fixture
def make(furnace: RegisterMap) -> Make:
    def build(process: ThermalProcess | None = OVEN, *, seed: int = 0, **values: Any) -> SimulatedDevice:
        device = SimulatedDevice(furnace, "F1", process=process or False, seed=seed)
        for path, value in values.items():
            device.poke(path, value)
        return device

    return build


def temperature(device: SimulatedDevice) -> float:
    return float(device.peek("process_value"))


@pytest.mark.parametrize("seconds", [2, 4, 10, 60, 300])
def test_by_hand_the_oven_is_a_first_order_lag_after_a_dead_time(make: Make, seconds: int) -> None:
    device = make(mode="manual", manual_output=50)
    device.advance(0.5)
    device.advance(seconds)
    heated = max(0.0, seconds - 4)
    assert temperature(device) == pytest.approx(70 + 200 * (1 - math.exp(-heated / 60)), abs=0.06)


def test_pid_brings_the_process_value_to_the_setpoint(make: Make) -> None:
    device = make(setpoint_ram=250, integral=60, derivative=5)
    device.advance(1800)
    assert temperature(device) == pytest.approx(250, abs=0.3)
    assert device.peek("output") == pytest.approx(45, abs=1)


def test_without_integral_action_an_offset_remains(make: Make) -> None:
    device = make(setpoint_ram=250, band=40)
    device.advance(1800)
    assert temperature(device) == pytest.approx((70 + 400 * 250 / 40) / (1 + 400 / 40), abs=0.5)


def test_on_off_control_swings_between_off_at_the_setpoint_and_on_at_the_hysteresis(make: Make) -> None:
    device = make(
        ThermalProcess(ambient=70, gain=400, time_constant=60, dead_time=0), control_type="on_off", setpoint_ram=250
    )
    device.poke("hysteresis", 20)
    device.advance(300)
    seen, outputs = [], set()
    for _ in range(400):
        device.advance(0.5)
        seen.append(temperature(device))
        outputs.add(device.peek("output"))
    assert outputs == {0, 100}
    assert (min(seen), max(seen)) == (pytest.approx(230, abs=2), pytest.approx(250, abs=3))


def test_in_standby_the_oven_cools_down(make: Make) -> None:
    device = make(mode="standby", setpoint_ram=250, process_value=200)
    device.advance(600)
    assert (temperature(device), device.peek("output")) == (pytest.approx(70, abs=0.2), 0)


def test_a_broken_sensor_gives_the_failsafe_output_until_it_is_mended(make: Make) -> None:
    device = make(setpoint_ram=250)
    device.poke("process_value", LOW_FAULT)
    device.advance(10)
    assert (device.peek("process_value"), device.peek("output"), device.peek("status.sensor_broken")) == ("LOW", 20, 1)
    device.poke("process_value", 240)
    device.advance(1)
    assert device.peek("status.sensor_broken") == 0
    assert temperature(device) == pytest.approx(240, abs=3)


def test_the_setpoint_in_use_follows_its_ramp(make: Make) -> None:
    device = make(ramp_up=30)
    device.advance(1)
    device.poke("setpoint_ram", 160)
    device.advance(60)
    assert float(device.peek("working_setpoint")) == pytest.approx(130, abs=0.3)
    device.advance(120)
    assert (device.peek("working_setpoint"), device.peek("setpoint_in_use")) == (160, 160)
    device.poke("setpoint_ram", 130)
    device.advance(30)
    assert float(device.peek("working_setpoint")) == pytest.approx(145, abs=0.3)


def test_the_highest_value_is_kept_and_may_be_reset(make: Make) -> None:
    device = make(setpoint_ram=200)
    device.advance(600)
    highest = device.peek("highest")
    device.poke("setpoint_ram", 80)
    device.advance(600)
    assert (device.peek("highest"), temperature(device) < highest) == (highest, True)
    device.poke("highest", 0)
    device.advance(1)
    assert float(device.peek("highest")) == pytest.approx(temperature(device), abs=1)


ALARMS = [
    *[("high", 201, 199), ("low", 199, 201), ("deviation_high", 401, 399), ("deviation_low", 199, 201)],
    *[("inside", 399, 401), ("outside", 401, 399)],
]


@pytest.mark.parametrize(("kind", "on", "off"), ALARMS)
def test_an_alarm_trips_on_its_side_of_the_limit(make: Make, kind: str, on: int, off: int) -> None:
    low = kind.startswith("deviation_low")
    device = make(None, alarm_action="normal", alarm_kind=kind, hysteresis=0, setpoint_ram=400 if low else 200)
    for value, expected in ((off, 0), (on, 1), (off, 0)):
        device.poke("process_value", value)
        device.advance(0.5)
        assert device.peek("status.alarm_on") == expected, value


def alarming(make: Make, **values: Any) -> SimulatedDevice:
    return make(None, alarm_action="normal", alarm_limit=200, **values)


def test_an_alarm_ends_by_its_hysteresis(make: Make) -> None:
    device = alarming(make, hysteresis=10)
    for value, expected in ((205, 1), (195, 1), (189, 0), (195, 0)):
        device.poke("process_value", value)
        device.advance(0.5)
        assert device.peek("status.alarm_on") == expected, value


def test_an_alarm_waits_for_its_delay_without_a_break(make: Make) -> None:
    device = alarming(make, alarm_delay=10, hysteresis=0)
    for value, seconds, expected in ((210, 8, 0), (190, 1, 0), (210, 8, 0), (210, 3, 1)):
        device.poke("process_value", value)
        device.advance(seconds)
        assert device.peek("status.alarm_on") == expected


def test_no_alarm_comes_in_the_first_seconds_after_power(make: Make) -> None:
    device = alarming(make, alarm_inhibit=30, process_value=300)
    device.advance(20)
    assert device.peek("status.alarm_on") == 0
    device.advance(20)
    assert device.peek("status.alarm_on") == 1
    device.power_cycle()
    device.advance(20)
    assert device.peek("status.alarm_on") == 0


def test_a_latched_alarm_stays_until_the_command_releases_it(make: Make) -> None:
    device = alarming(make, process_value=300)
    device.poke("alarm_action", "latched")
    device.advance(1)
    device.poke("process_value", 20)
    device.advance(1)
    assert device.peek("status.alarm_on") == 1
    assert device.handle(struct.pack(">BHH", 6, 102, 1)) is not None
    assert device.peek("status.alarm_on") == 0
    device.poke("process_value", 300)
    device.advance(1)
    assert device.peek("status.alarm_on") == 1


def test_an_alarm_that_is_switched_off_is_off(make: Make) -> None:
    device = alarming(make, process_value=300)
    device.advance(1)
    device.poke("alarm_action", "off")
    device.advance(1)
    assert device.peek("status.alarm_on") == 0


def series(device: SimulatedDevice, *steps: float) -> list[float]:
    found = []
    for seconds in steps:
        device.advance(seconds)
        found.append(temperature(device))
    return found


def test_the_same_seed_gives_the_same_noise_and_another_seed_another(make: Make) -> None:
    noisy = ThermalProcess(ambient=70, gain=400, noise=2)
    one, same, other = (series(make(noisy, seed=seed, setpoint_ram=200), *[5] * 20) for seed in (1, 1, 2))
    assert one == same != other


def test_time_in_small_pieces_is_the_same_time(make: Make) -> None:
    whole = series(make(setpoint_ram=200, integral=60), 120)
    pieces = series(make(setpoint_ram=200, integral=60), *[0.3] * 400)
    assert whole[-1] == pytest.approx(pieces[-1], abs=0.11)


def test_another_unit_leaves_the_oven_as_hot_as_it_is(make: Make) -> None:
    device = make(setpoint_ram=212, integral=60)
    device.advance(1800)
    assert device.handle(struct.pack(">BHH", 6, 11, 1)) is not None
    assert temperature(device) == pytest.approx(100, abs=0.3)
    device.advance(300)
    assert temperature(device) == pytest.approx(100, abs=0.4)
    device.poke("mode", "standby")
    device.advance(900)
    assert temperature(device) == pytest.approx((70 - 32) * 5 / 9, abs=0.3)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"time_constant": 0}, "time_constant 0 must be more than 0"),
        ({"gain": -5}, "gain -5 must be more than 0"),
        ({"dead_time": -1}, "dead_time -1 must not be negative"),
        ({"dead_time": 1e9}, "all that is remembered"),
        ({"noise": -0.1}, "noise -0.1 must not be negative"),
        ({"resolution": 0}, "resolution 0 must be more than 0"),
        ({"ambient": math.nan}, "ambient nan is no number"),
        ({"time_constant": math.inf}, "time_constant inf is no number"),
        ({"cooling": -1}, "cooling -1 must not be negative"),
        ({"start": math.inf}, "start inf is no number"),
    ],
)
def test_an_impossible_process_is_one_clear_message(parameters: dict[str, float], message: str) -> None:
    with pytest.raises(SimulatorError, match=message):
        ThermalProcess(**parameters)


@pytest.mark.parametrize("seconds", [-1, math.nan, math.inf])
def test_time_cannot_go_back(make: Make, seconds: float) -> None:
    with pytest.raises(SimulatorError, match="time cannot advance"):
        make().advance(seconds)


def test_a_map_that_says_nothing_of_a_process_has_none(controller: RegisterMap) -> None:
    SimulatedDevice(controller, "16C").advance(10)
    with pytest.raises(SimulatorError, match="does not say which registers control"):
        SimulatedDevice(controller, "16C", process=True)


def test_a_served_device_moves_with_real_time(furnace: RegisterMap) -> None:
    with simulate(furnace, "F1", process=OVEN, speed=100) as running:
        running.poke("mode", "manual")
        running.poke("manual_output", 100)
        until = time.monotonic() + 20
        while float(running.peek("process_value")) < 150 and time.monotonic() < until:
            time.sleep(0.05)
        assert float(running.peek("process_value")) >= 150


FAMILIES = sorted(
    path.relative_to(MAPS).with_suffix("").as_posix()
    for path in MAPS.glob("*/*.yaml")
    if not path.name.endswith(".library.yaml")
)


@pytest.mark.parametrize("name", FAMILIES)
def test_every_model_controls_its_process(name: str) -> None:
    register_map = find_map(name)
    givens = {given.id: {16} for given in register_map.givens}
    for model in register_map.models:
        assert model.process is not None, model.name
        device = SimulatedDevice(register_map, model.name, givens=givens, process=ThermalProcess(ambient=20, gain=500))
        target = next(path for path in _setpoints(device) if device.state.register(path).access.writable)
        for path, value in _prepared(device).items():
            device.poke(path, value)
        device.poke(target, 120)
        device.advance(1800)
        assert float(device.peek(model.process.value)) == pytest.approx(120, abs=15), model.name
        assert device.peek(model.process.outputs[0].percent) != 0, model.name


def _setpoints(device: SimulatedDevice) -> list[str]:
    """The setpoint, and what it follows, one after the other."""
    assert device.model.process is not None
    path, found = device.model.process.setpoint, []
    while path:
        found.append(path)
        path = choose(device.state.register(path).follows, device.state) or ""
    return [each for each in found if each != device.model.process.setpoint or len(found) == 1] or found


def _prepared(device: SimulatedDevice) -> dict[str, Fraction | int | str]:
    """What makes a first output heat by itself, where the map leaves it open."""
    assert device.model.process is not None
    known = {register.path for register in device.model.registers}
    wanted = {"high_range": 500, "proportional_band": 5, "output_2_type": 1, "control_type": 3, "auto_reset": 120}
    return {path: value for path, value in wanted.items() if path in known}
