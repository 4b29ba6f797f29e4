"""The controller of a device in simulated time: process value in, outputs, status bits and alarms out."""

from fractions import Fraction

from regscribe.model import Process, Ramp
from regscribe.simulate.device.device_plan import Stored
from regscribe.simulate.device.state import DeviceState
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.process.controller_parts import AlarmWatch, ControllerSettings, ControlLoop
from regscribe.simulate.process.thermal_process import STEP, Oven, ThermalProcess
from regscribe_runtime.values.views import scale_needs

DIGITS = 6
"""Decimals to which a number of the process is kept before the device rounds it."""


class Controller:
    """Process values, outputs, alarms and status bits as time passes; without an oven the process value stays put.

    A process value that someone else sets is taken over: a number as the oven's temperature, a fault of the sensor as
    one that lasts until a number is set.
    """

    def __init__(self, process: Process, state: DeviceState, oven: Oven | None) -> None:
        self.seconds = 0.0
        self._process = process
        self._state = state
        self._settings = ControllerSettings(state)
        self._oven = oven
        self._loops = [ControlLoop(output, self._settings) for output in process.outputs]
        self._watches = [AlarmWatch(alarm, self._settings) for alarm in process.alarms]
        self._rest = 0.0
        self._working: float | None = None
        self._scale = scale_needs(state.find(process.value)[0])
        self._put_before: dict[str, Fraction] = {}
        self._extremes: dict[str, float] = {}
        self._value: tuple[Stored, float | None] = ("", None)
        self._shown = None if oven is None else self._show_temperature(oven)

    def reset(self) -> None:
        """Forget everything but the oven, as when power comes."""
        self.seconds, self._rest, self._working = 0.0, 0.0, None
        for loop in self._loops:
            loop.reset()
        for watch in self._watches:
            watch.reset()

    def release(self) -> None:
        """Reset latched alarms."""
        for watch in self._watches:
            watch.reset()
        self._show_bits()

    def convert(self, path: str, factor: float, offset: float) -> None:
        """Convert what is remembered of a register to another unit: new = old x `factor` + `offset`."""
        if path == self._process.value and self._oven is not None:
            self._oven.convert(factor, offset)
            self._shown = self._state.stored(path)
        if path == self._process.setpoint and self._working is not None:
            self._working = self._working * factor + offset

    def advance(self, seconds: float) -> None:
        """Let time pass in whole steps; the rest of a step is kept for the next call."""
        self._rest += seconds
        while self._rest >= STEP:
            self._rest -= STEP
            self.seconds += STEP
            self._step()

    def _step(self) -> None:
        touched = self._settings.refresh()
        for path in touched:
            self._put_before.pop(path, None)
            self._extremes.pop(path, None)
        if not touched.isdisjoint(self._scale):
            self._put_before.clear()
            self._value = ("", None)
        value = self._measure()
        setpoint = self._ramped(self._settings.number(self._process.setpoint))
        for loop in self._loops:
            self._run(loop, value, setpoint)
        if value is not None:
            for watch in self._watches:
                watch.look(value, setpoint, self.seconds)
            self._keep_extremes(value)
        self._show_bits()

    def _measure(self) -> float | None:
        """Step the oven; return the process value, None where the sensor is broken."""
        oven, before = self._oven, self._state.stored(self._process.value)
        if oven is not None and before != self._shown and (value := self._decoded(before)) is not None:
            oven.level = value
        if oven is not None:
            oven.step(sum(-loop.share if loop.cools else loop.share for loop in self._loops))
            if self._decoded(before) is not None:
                self._shown = self._show_temperature(oven)
        return self._decoded(self._state.stored(self._process.value))

    def _decoded(self, stored: Stored) -> float | None:
        """The number of a stored process value; None for a fault of the sensor."""
        if stored != self._value[0]:
            register = self._state.register(self._process.value)
            number = None
            if isinstance(stored, Fraction) and not register.is_fault(stored):
                number = float(self._state.to_value(register, stored))
            self._value = (stored, number)
        return self._value[1]

    def _put(self, path: str, value: Fraction) -> None:
        """Set a register or a bit unless it was set to the same before and nobody touched it."""
        if self._put_before.get(path) != value:
            self._put_before[path] = value
            self._state.put(path, value)

    def _show_temperature(self, oven: Oven) -> Stored:
        path = self._process.value
        self._put(path, _exact(oven.temperature))
        return self._state.stored(path)

    def _ramped(self, goal: float) -> float:
        ramp = self._process.ramp
        if ramp is None:
            return goal
        rate = self._rate(ramp, rising=self._working is None or goal > self._working)
        if self._working is None or not rate:
            self._working = goal
        else:
            step = rate * STEP / ramp.seconds
            self._working = min(goal, self._working + step) if goal > self._working else max(goal, self._working - step)
        if ramp.shows:
            self._state.drive(ramp.shows, alone=bool(self._rate(ramp, rising=True) or self._rate(ramp, rising=False)))
            self._put(ramp.shows, _exact(self._working))
        return self._working

    def _rate(self, ramp: Ramp, *, rising: bool) -> float:
        path = ramp.rises if rising else ramp.falls
        return max(0.0, self._settings.number(path)) if self._settings.holds(ramp.when) else 0.0

    def _run(self, loop: ControlLoop, value: float | None, setpoint: float) -> None:
        process, output = self._process, loop.output
        if self._settings.holds(process.manual):
            loop.by_hand()
            if not output.manual:
                return
        elif self._settings.holds(process.off):
            loop.reset()
        elif value is None:
            loop.fail()
        else:
            loop.control(value, setpoint)
        self._put(output.percent, _exact(loop.share * float(output.full)))

    def _keep_extremes(self, value: float) -> None:
        for path, better in ((self._process.highest, max), (self._process.lowest, min)):
            if not path:
                continue
            if path not in self._extremes:
                self._extremes[path] = float(self._state.look_up(path))
            if better(self._extremes[path], value) != self._extremes[path]:
                self._put(path, _exact(value))
                self._extremes[path] = value

    def _show_bits(self) -> None:
        """Set the bits of outputs, alarms and the sensor; one that several share is set if one of them sets it."""
        bits: dict[str, bool] = {}
        for loop in self._loops:
            if loop.output.active:
                bits[loop.output.active] = bits.get(loop.output.active, False) or loop.share > 0
        for watch in self._watches:
            for path in watch.alarm.active:
                bits[path] = bits.get(path, False) or watch.on
        if self._process.fault:
            bits[self._process.fault] = self._decoded(self._state.stored(self._process.value)) is None
        for path, on in bits.items():
            self._put(path, Fraction(int(on)))


def controller_of(state: DeviceState, *, process: ThermalProcess | bool, seed: int) -> Controller | None:
    """The controller of the map; SimulatorError if there is none for the process."""
    roles = state.blueprint.model.process
    if roles is None and process is not False:
        register_map = state.blueprint.register_map
        message = f"map {register_map.id} does not say which registers control the process: leave `process` away"
        raise SimulatorError(message)
    if roles is None:
        return None
    oven = Oven(ThermalProcess() if process is True else process, seed) if process else None
    return Controller(roles, state, oven)


def _exact(number: float) -> Fraction:
    return Fraction(round(number * 10**DIGITS), 10**DIGITS)
