"""Latencies of simulated devices by function and word, as the map says: real, scaled, or off."""

import math
from collections.abc import Sequence
from random import Random

from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.wire.framing import Frame
from regscribe_runtime.wire.pdu import MalformedError, decode_request
from regscribe_runtime.wire.requests import READ_HOLDING, READ_INPUT, WRITE_AND_READ, WRITE_REGISTERS

NAMED = {"off": 0.0, "real": 1.0}
WORDS_COUNTED = frozenset({READ_HOLDING, READ_INPUT, WRITE_REGISTERS})
REPEATED = {WRITE_AND_READ: WRITE_REGISTERS}
"""Functions that take as long as another."""


def factor_of(latency: float | str) -> float:
    """Return the factor that `latency` names: `off`, `real`, or a number. SimulatorError for anything else."""
    try:
        factor = NAMED[latency] if latency in NAMED else float(latency)
    except (TypeError, ValueError):
        factor = math.nan
    if not 0 <= factor < math.inf:
        message = f"latency {latency!r} is neither off, real, nor a factor of 0 or more (0.1: a tenth of the real time)"
        raise SimulatorError(message)
    return factor


class Pace:
    """Time from the end of a request to the start of its answer: the latencies of the device.

    They lie between minimum and maximum, as a generator with a seed of its own for each device picks.
    """

    def __init__(self, devices: Sequence[SimulatedDevice], line: SerialLine, *, factor: float) -> None:
        self._character = line.character
        self._factor = factor
        self._devices = [(device, Random(f"{device.seed} {device.unit}")) for device in devices]  # noqa: S311 - repeatable, and no secret

    def seconds(self, request: Frame) -> float:
        """Return the seconds that a request takes; 0 where the map says nothing of its function."""
        device, random = next((each for each in self._devices if each[0].unit == request.unit), (None, None))
        if device is None or random is None:
            return 0.0
        function = request.pdu[0]
        latency = device.register_map.protocol.latency(REPEATED.get(function, function))
        if latency is None:
            return 0.0
        words = _words(request.pdu)
        low = float(latency.minimum + words * latency.minimum_per_word)
        high = float(latency.longest(words))
        milliseconds = random.uniform(low, high)
        return self._factor * (milliseconds / 1000 + float(latency.characters) * self._character)


def _words(pdu: bytes) -> int:
    """How many registers a request is about, for the part of the latency that counts them."""
    try:
        request = decode_request(pdu)
    except MalformedError:
        return 1
    return request.quantity if request.function in WORDS_COUNTED else 1
