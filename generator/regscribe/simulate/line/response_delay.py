"""How long a device thinks: the map's latencies by function and word, real, scaled, or off."""

import math
from collections.abc import Sequence
from random import Random

from regscribe.model import Protocol
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


def words_of(pdu: bytes) -> int:
    """Return how many registers a request is about, for the part of the latency that counts them."""
    try:
        request = decode_request(pdu)
    except MalformedError:
        return 1
    return request.quantity if request.function in WORDS_COUNTED else 1


class Thought:
    """The latencies of one device: between minimum and maximum, as a generator with a seed of its own picks."""

    __slots__ = ("_character", "_factor", "_protocol", "_random")

    def __init__(self, protocol: Protocol, line: SerialLine, factor: float, seed: str) -> None:
        self._protocol = protocol
        self._character = line.character
        self._factor = factor
        self._random = Random(seed)  # noqa: S311 - repeatable, and no secret

    def seconds(self, pdu: bytes) -> float:
        """Return how long this request takes; 0 where the map says nothing of its function."""
        latency = self._protocol.latency(REPEATED.get(pdu[0], pdu[0]))
        if latency is None:
            return 0.0
        words = words_of(pdu)
        low = float(latency.minimum + words * latency.minimum_per_word)
        high = float(latency.longest(words))
        milliseconds = self._random.uniform(low, high)
        return self._factor * (milliseconds / 1000 + float(latency.characters) * self._character)


class Pace:
    """How long each request takes until its answer begins: the device's latency."""

    __slots__ = ("_devices",)

    def __init__(self, devices: Sequence[SimulatedDevice], line: SerialLine, *, factor: float) -> None:
        self._devices = [
            (device, Thought(device.register_map.protocol, line, factor, f"{device.seed} {device.unit}"))
            for device in devices
        ]

    def seconds(self, request: Frame) -> float:
        """Return the seconds from the end of the request to the start of the answer."""
        thought = next((thought for device, thought in self._devices if device.unit == request.unit), None)
        return thought.seconds(request.pdu) if thought is not None else 0.0
