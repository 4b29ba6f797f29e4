"""Parts of a controller: its settings, its outputs (PID, on/off, by hand), and its alarms."""

from collections.abc import Callable

from regscribe.model import Alarm, Condition, Output, Pid, TripKind
from regscribe.reference import holds
from regscribe.simulate.device.state import DeviceState
from regscribe.simulate.process.thermal_process import STEP
from regscribe_runtime.values.views import scale_needs

FULL = 1.0


class ControllerSettings:
    """Cache of numbers and conditions, also of registers that the controller itself moves."""

    def __init__(self, state: DeviceState) -> None:
        self._state = state
        self._numbers: dict[str, float] = {}
        self._conditions: dict[int, bool] = {}
        self._paths: set[str] = set()

    def refresh(self) -> frozenset[str]:
        """Forget what may have changed since the last call; return the registers that were touched."""
        touched = frozenset(self._state.touched)
        if not touched.isdisjoint(self._paths):
            self._numbers.clear()
            self._conditions.clear()
        self._state.touched.clear()
        return touched

    def number(self, path: str) -> float:
        """Return the value of use of a register; 0 for none."""
        if not path:
            return 0.0
        if path not in self._numbers:
            register, _ = self._state.find(path)
            self._paths.update((register.path, *scale_needs(register)))
            self._numbers[path] = float(self._state.look_up(path))
        return self._numbers[path]

    def holds(self, condition: Condition | None) -> bool:
        """Whether a condition holds; none never does."""
        if condition is None:
            return False
        key = id(condition)  # conditions live as long as their map
        if key not in self._conditions:
            for path in condition.registers:
                self._paths.update((path, *scale_needs(self._state.register(path))))
            self._conditions[key] = holds(condition, self._state)
        return self._conditions[key]


class ControlLoop:
    """One output of a controller: its share of full output from 0 to 1, and what PID remembers."""

    def __init__(self, output: Output, settings: ControllerSettings) -> None:
        self.output = output
        self.share = 0.0
        self._settings = settings
        self._integral = 0.0
        self._last: float | None = None

    @property
    def cools(self) -> bool:
        """Whether the output cools now."""
        return self._settings.holds(self.output.cools)

    def reset(self) -> None:
        """Switch off and forget the past, as when power comes."""
        self.share, self._integral, self._last = 0.0, 0.0, None

    def by_hand(self) -> None:
        """Take the share of the manual register; PID begins there when it takes over."""
        self.share = self._part(self.output.manual or self.output.percent, self.share)
        self._integral = self.share

    def fail(self) -> None:
        """Take the failsafe share: the sensor is broken."""
        self.share = self._part(self.output.failsafe, 0.0)
        self._last = None

    def control(self, value: float, setpoint: float) -> None:
        """Take the share that PID or on/off control computes."""
        sign = -1.0 if self.cools else 1.0
        error = sign * (setpoint - value)
        change = 0.0 if self._last is None else sign * (self._last - value) / STEP
        self._last = value
        pid, on_off = self.output.pid, self.output.on_off
        band = self._band(pid)
        if pid is not None and band > 0:
            self.share = self._proportional(pid, band, error, change)
        elif on_off is not None and self._settings.holds(on_off.when):
            hysteresis = self._settings.number(on_off.hysteresis)
            on = error > 0 if self.share else error >= max(hysteresis, 0.0) and error > 0
            self.share = self._limited(FULL if on else 0.0)
        else:
            self.share = 0.0

    def _proportional(self, pid: Pid, band: float, error: float, change: float) -> float:
        """PID; the integral waits while the output is at a limit and it would drive it further."""
        proportion = error / band
        rate = self._settings.number(pid.derivative) * change / band
        bias = self._part(pid.bias, 0.0)
        seconds = self._settings.number(pid.integral)
        step = proportion * STEP / seconds if seconds > 0 else 0.0
        self._integral = self._integral if seconds > 0 else 0.0
        wanted = proportion + self._integral + rate + bias
        possible = self._limited(wanted)
        if wanted == possible or (wanted > possible) != (step > 0):
            self._integral += step
        return possible

    def _limited(self, share: float) -> float:
        low = self._part(self.output.low, 0.0)
        high = self._part(self.output.high, FULL)
        if high <= low:  # not set yet: limits that leave no room are none
            low, high = 0.0, FULL
        return min(max(share, low, 0.0), high, FULL)

    def _band(self, pid: Pid | None) -> float:
        if pid is None or not self._settings.holds(pid.when):
            return 0.0
        band = self._settings.number(pid.band)
        if pid.ends is None:
            return band
        low, high = (self._settings.number(path) for path in pid.ends)
        return band / 100 * (high - low) if high > low else band

    def _part(self, path: str, otherwise: float) -> float:
        return self._settings.number(path) / float(self.output.full) if path else otherwise


DISTANCES: dict[TripKind, Callable[[float, float, float], float]] = {
    TripKind.HIGH: lambda value, _, limit: value - limit,
    TripKind.LOW: lambda value, _, limit: limit - value,
    TripKind.DEVIATION_HIGH: lambda value, setpoint, limit: value - (setpoint + limit),
    TripKind.DEVIATION_LOW: lambda value, setpoint, limit: (setpoint - limit) - value,
    TripKind.INSIDE: lambda value, setpoint, limit: limit - abs(value - setpoint),
    TripKind.OUTSIDE: lambda value, setpoint, limit: abs(value - setpoint) - limit,
}
"""How far a process value is beyond the trip (above 0: it trips), from value, setpoint and limit."""


class AlarmWatch:
    """One alarm of one device; `on` is what its bits show."""

    def __init__(self, alarm: Alarm, settings: ControllerSettings) -> None:
        self.alarm = alarm
        self.on = False
        self._settings = settings
        self._pending: float | None = None

    def reset(self) -> None:
        """Switch off, latched or not, as when power comes; the delay of what still trips begins anew."""
        self.on, self._pending = False, None

    def look(self, value: float, setpoint: float, now: float) -> None:
        """Judge the process value, `now` seconds after power came."""
        trip = next((each for each in self.alarm.trips if self._settings.holds(each.when)), None)
        if trip is None or not self._settings.holds(self.alarm.when):
            self.reset()
            return
        beyond = DISTANCES[trip.kind](value, setpoint, self._settings.number(trip.limit))
        if self.on:
            self.on = self._settings.holds(self.alarm.latched) or beyond > -self._settings.number(self.alarm.hysteresis)
        elif beyond <= 0 or now < self._settings.number(self.alarm.inhibit):
            self._pending = None
        else:
            self._pending = now if self._pending is None else self._pending
            self.on = now - self._pending >= self._settings.number(self.alarm.delay)
