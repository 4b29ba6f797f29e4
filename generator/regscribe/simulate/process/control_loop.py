"""How an output follows from a process value and a setpoint: PID, on/off, by hand."""

from regscribe.model import Output, Pid
from regscribe.simulate.process.controller_settings import ControllerSettings
from regscribe.simulate.process.thermal_process import STEP

FULL = 1.0


class Loop:
    """One output of a controller: its share of full output from 0 to 1, and what PID remembers."""

    __slots__ = ("_integral", "_last", "_settings", "output", "share")

    def __init__(self, output: Output, settings: ControllerSettings) -> None:
        self.output = output
        self.share = 0.0
        self._settings = settings
        self._integral = 0.0
        self._last: float | None = None

    @property
    def cools(self) -> bool:
        """Whether it takes heat away now."""
        return self._settings.holds(self.output.cools)

    def reset(self) -> None:
        """Give nothing and forget what was, as when power comes."""
        self.share, self._integral, self._last = 0.0, 0.0, None

    def by_hand(self) -> None:
        """Give what the manual register says; PID begins there when it takes over."""
        self.share = self._part(self.output.manual or self.output.percent, self.share)
        self._integral = self.share

    def fail(self) -> None:
        """The sensor is broken: give what is set for that."""
        self.share = self._part(self.output.failsafe, 0.0)
        self._last = None

    def control(self, value: float, setpoint: float) -> None:
        """Give what the distance to the setpoint asks for."""
        sign = -1.0 if self.cools else 1.0
        error = sign * (setpoint - value)
        change = 0.0 if self._last is None else sign * (self._last - value) / STEP
        self._last = value
        pid, on_off = self.output.pid, self.output.on_off
        band = self._band(pid) if pid is not None and self._settings.holds(pid.when) else 0.0
        if pid is not None and band > 0:
            self.share = self._proportional(pid, band, error, change)
        elif on_off is not None and self._settings.holds(on_off.when):
            self.share = self._switched(error, self._settings.number(on_off.hysteresis))
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

    def _switched(self, error: float, hysteresis: float) -> float:
        on = error > 0 if self.share else error >= max(hysteresis, 0.0) and error > 0
        return self._limited(FULL if on else 0.0)

    def _limited(self, share: float) -> float:
        low = self._part(self.output.low, 0.0)
        high = self._part(self.output.high, FULL)
        if high <= low:  # not set yet: limits that leave no room are none
            low, high = 0.0, FULL
        return min(max(share, low, 0.0), high, FULL)

    def _band(self, pid: Pid) -> float:
        band = self._settings.number(pid.band)
        if pid.ends is None:
            return band
        low, high = (self._settings.number(path) for path in pid.ends)
        return band / 100 * (high - low) if high > low else band

    def _part(self, path: str, otherwise: float) -> float:
        return self._settings.number(path) / float(self.output.full) if path else otherwise
