"""A small thermal process: first order with dead time, exact between steps, and repeatable."""

import math
from collections import deque
from dataclasses import asdict, dataclass
from random import Random

from regscribe.simulate.errors import SimulatorError

STEP = 0.5
"""Simulated seconds between two steps of a controller."""

MOST_STEPS = 100_000
"""Steps of dead time that are remembered at most."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ThermalProcess:
    """The process of a simulated controller: an oven that loses heat to its surroundings.

    With its outputs at `u` (all heating on: 1, all cooling on: -1) it goes to `ambient` + `gain` x u (times `cooling`
    where u is negative), as fast as `time_constant` says and `dead_time` later. `noise` is the standard deviation of
    what the sensor adds; `resolution` the sensor's smallest step. `start` is where it begins (None: at `ambient`).
    Temperatures are in the unit that the process value has at the start, times in seconds. Raises SimulatorError for
    what no process can be.
    """

    ambient: float = 20.0
    gain: float = 500.0
    cooling: float = 1.0
    time_constant: float = 120.0
    dead_time: float = 5.0
    noise: float = 0.0
    resolution: float = 0.1
    start: float | None = None

    def __post_init__(self) -> None:
        for name, value in asdict(self).items():
            if value is None and name == "start":
                continue
            if not isinstance(value, (int, float)) or not math.isfinite(value):
                message = f"process: {name} {value!r} is no number"
                raise SimulatorError(message)
        _positive("gain", self.gain, "with no gain, no output changes the process value")
        _positive("time_constant", self.time_constant, "a process needs time, in seconds")
        _positive("resolution", self.resolution, "it is the sensor's smallest step")
        _not_negative("cooling", self.cooling, "it is how much of the gain an output that cools has")
        _not_negative("dead_time", self.dead_time, "an effect cannot come before its cause")
        _not_negative("noise", self.noise, "it is a standard deviation")
        if self.dead_time > STEP * MOST_STEPS:
            message = (
                f"process: dead_time {self.dead_time:g} is more than {STEP * MOST_STEPS:g} s, all that is remembered"
            )
            raise SimulatorError(message)


def _positive(name: str, value: float, why: str) -> None:
    if not value > 0:
        message = f"process: {name} {value:g} must be more than 0: {why}"
        raise SimulatorError(message)


def _not_negative(name: str, value: float, why: str) -> None:
    if value < 0:
        message = f"process: {name} {value:g} must not be negative: {why}"
        raise SimulatorError(message)


class Oven:
    """A thermal process in motion: `step` with what the outputs give, `temperature` as the sensor sees it."""

    def __init__(self, parameters: ThermalProcess, seed: int) -> None:
        self._parameters = parameters
        self._ambient = parameters.ambient
        self._gain = parameters.gain
        self._decay = math.exp(-STEP / parameters.time_constant)
        self._random = Random(seed)  # noqa: S311 - repeatable, and no secret
        self._given = deque([0.0] * round(parameters.dead_time / STEP))
        self.level = parameters.ambient if parameters.start is None else parameters.start

    @property
    def temperature(self) -> float:
        """The value of the sensor, in whole steps of its resolution."""
        noise = self._random.gauss(0, self._parameters.noise) if self._parameters.noise else 0.0
        resolution = self._parameters.resolution
        return round((self.level + noise) / resolution) * resolution

    def step(self, heat: float) -> None:
        """Go on for `STEP` seconds with the outputs at `heat` (-1 to 1)."""
        self._given.append(heat)
        effective = self._given.popleft()
        goal = self._ambient + self._gain * effective * (1.0 if effective > 0 else self._parameters.cooling)
        self.level = goal + (self.level - goal) * self._decay

    def convert(self, factor: float, offset: float) -> None:
        """Count in another unit: new = old x `factor` + `offset`."""
        self.level = self.level * factor + offset
        self._ambient = self._ambient * factor + offset
        self._gain *= factor
