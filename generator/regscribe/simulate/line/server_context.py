"""The devices that share one line: which of them answers what, and how long it takes."""

import math
from collections.abc import Iterable
from enum import StrEnum
from random import Random

from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe_runtime.values.serial_line import SerialLine
from regscribe_runtime.values.wire_types import WRITE_AND_READ
from regscribe_runtime.wire.framing import Frame
from regscribe_runtime.wire.packing import MalformedError
from regscribe_runtime.wire.pdu import encode_reply
from regscribe_runtime.wire.requests import READ_HOLDING, READ_INPUT, WRITE_REGISTER, WRITE_REGISTERS, Reply

BROADCAST = 0
NO_RESPONSE_FROM_TARGET = 0x0B
NAMED = {"off": 0.0, "real": 1.0}
WORDS_COUNTED = frozenset({READ_HOLDING, READ_INPUT, WRITE_REGISTER, WRITE_REGISTERS})
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


class Foreign(StrEnum):
    """Answer to a request for an absent unit: none, or the exception of a gateway (TCP)."""

    SILENCE = "silence"
    GATEWAY = "gateway"


class ServerContext:
    """Devices by the unit id that they have now; raises SimulatorError if two have the same at first.

    Their latencies count `factor` times, with the characters of `line`; with 0 they answer at once.
    """

    def __init__(
        self,
        devices: Iterable[SimulatedDevice],
        *,
        foreign: Foreign = Foreign.SILENCE,
        line: SerialLine | None = None,
        factor: float = 0.0,
    ) -> None:
        self.factor = factor
        self._line = line or SerialLine()
        self._units: dict[int, SimulatedDevice] = {}
        self._foreign = foreign
        for device in devices:
            for unit in device.units:
                if unit in self._units:
                    message = f"two simulated devices have unit {unit}: give each a unit id of its own"
                    raise SimulatorError(message)
                self._units[unit] = device
        self._devices = tuple(dict.fromkeys(self._units.values()))
        self._random = {each: Random(f"{each.seed} {each.unit}") for each in self._devices}  # noqa: S311 - repeatable, and no secret

    def _at(self, unit: int) -> SimulatedDevice | None:
        """The device of a unit id; if two were set to it, the first."""
        device = self._units.get(unit)
        if device is None or unit not in device.units:
            self._units = {own: each for each in reversed(self._devices) for own in each.units}
        return self._units.get(unit)

    def has(self, unit: int) -> bool:
        """Whether a request to `unit` concerns any device here (the broadcast concerns all)."""
        return unit == BROADCAST or self._at(unit) is not None

    def answer(self, unit: int, pdu: bytes) -> bytes | None:
        """Let the devices act on a request; return the answer, None for silence."""
        if unit == BROADCAST and self._at(unit) is None:
            for device in self._devices:
                device.handle(pdu, broadcast=True)
            return None
        found = self._at(unit)
        if found is not None:
            return found.handle(pdu, unit=unit)
        if self._foreign is Foreign.GATEWAY:
            return encode_reply(Reply(pdu[0], exception=NO_RESPONSE_FROM_TARGET))
        return None

    def delay(self, request: Frame) -> float:
        """Return the seconds until the answer begins, by a latency between the limits that the map states, else 0."""
        function, device = request.pdu[0], self._at(request.unit)
        if device is None:
            return 0.0
        latency = device.register_map.protocol.latency(REPEATED.get(function, function))
        if latency is None:
            return 0.0
        words = _words(device, request.pdu)
        low = float(latency.minimum + words * latency.minimum_per_word)
        high = float(latency.longest(words))
        milliseconds = self._random[device].uniform(low, high)
        return self.factor * (milliseconds / 1000 + float(latency.characters) * self._line.character)


def _words(device: SimulatedDevice, pdu: bytes) -> int:
    """Number of words in a request, for the part of the latency that counts them."""
    try:
        request = device.understood(pdu)
    except MalformedError:
        return 1
    return request.quantity if request.function in WORDS_COUNTED else 1
