"""The devices that share one line: which of them answers what, and how long it takes."""

from collections.abc import Iterable
from enum import StrEnum

from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError
from regscribe.simulate.line.response_delay import Pace
from regscribe_runtime.wire.pdu import encode_reply
from regscribe_runtime.wire.requests import Reply

BROADCAST = 0
NO_RESPONSE_FROM_TARGET = 0x0B


class Foreign(StrEnum):
    """What a request to a unit that is not there gets: nothing, or the exception of a gateway (TCP)."""

    SILENCE = "silence"
    GATEWAY = "gateway"


class ServerContext:
    """Devices by the unit id that they have now; raises SimulatorError if two have the same at first.

    Without a `pace` they answer at once.
    """

    def __init__(
        self, devices: Iterable[SimulatedDevice], *, foreign: Foreign = Foreign.SILENCE, pace: Pace | None = None
    ) -> None:
        self.pace = pace
        self._units: dict[int, SimulatedDevice] = {}
        self._foreign = foreign
        for device in devices:
            if device.unit in self._units:
                message = f"two simulated devices have unit {device.unit}: give each a unit id of its own"
                raise SimulatorError(message)
            self._units[device.unit] = device
        self._devices = tuple(self._units.values())

    def _at(self, unit: int) -> SimulatedDevice | None:
        """The device of a unit id: of two that were set to one id, the first."""
        device = self._units.get(unit)
        if device is None or device.unit != unit:
            self._units = {each.unit: each for each in reversed(self._devices)}
        return self._units.get(unit)

    def has(self, unit: int) -> bool:
        """Whether a request to `unit` concerns any device here (the broadcast concerns all)."""
        return unit == BROADCAST or self._at(unit) is not None

    def answer(self, unit: int, pdu: bytes) -> bytes | None:
        """Let the devices act on a request; return the answer, None for silence."""
        if unit == BROADCAST:
            for device in self._devices:
                device.handle(pdu, broadcast=True)
            return None
        found = self._at(unit)
        if found is not None:
            return found.handle(pdu)
        if self._foreign is Foreign.GATEWAY:
            return encode_reply(Reply(pdu[0], exception=NO_RESPONSE_FROM_TARGET))
        return None
