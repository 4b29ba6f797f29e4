"""When an alarm is on: its trip, its hysteresis and delay, and what latches it."""

from collections.abc import Callable

from regscribe.model import Alarm, TripKind
from regscribe.simulate.process.controller_settings import ControllerSettings

Distance = Callable[[float, float, float], float]
"""How far a process value is beyond the trip (above 0: it trips), from value, setpoint and limit."""

DISTANCES: dict[TripKind, Distance] = {
    TripKind.HIGH: lambda value, _, limit: value - limit,
    TripKind.LOW: lambda value, _, limit: limit - value,
    TripKind.DEVIATION_HIGH: lambda value, setpoint, limit: value - (setpoint + limit),
    TripKind.DEVIATION_LOW: lambda value, setpoint, limit: (setpoint - limit) - value,
    TripKind.INSIDE: lambda value, setpoint, limit: limit - abs(value - setpoint),
    TripKind.OUTSIDE: lambda value, setpoint, limit: abs(value - setpoint) - limit,
}


class Watch:
    """One alarm of one device: `on` is what its bits show."""

    __slots__ = ("_pending", "_settings", "alarm", "on")

    def __init__(self, alarm: Alarm, settings: ControllerSettings) -> None:
        self.alarm = alarm
        self.on = False
        self._settings = settings
        self._pending: float | None = None

    def reset(self) -> None:
        """Let go of what is latched, as when power comes; what still trips begins anew."""
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
