"""The devices that share one line, and who of them answers what."""

from collections.abc import Iterable
from enum import StrEnum

from regscribe.simulate.answers import exception_answer
from regscribe.simulate.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError

BROADCAST = 0
NO_RESPONSE_FROM_TARGET = 0x0B


class Foreign(StrEnum):
    """What a request to a unit that is not there gets: nothing, or the exception of a gateway (TCP)."""

    SILENCE = "silence"
    GATEWAY = "gateway"


class Station:
    """Devices by unit id; raises SimulatorError if two have the same."""

    __slots__ = ("_foreign", "_units")

    def __init__(self, devices: Iterable[SimulatedDevice], *, foreign: Foreign = Foreign.SILENCE) -> None:
        self._units: dict[int, SimulatedDevice] = {}
        self._foreign = foreign
        for device in devices:
            if device.unit in self._units:
                message = f"two simulated devices have unit {device.unit}: give each a unit id of its own"
                raise SimulatorError(message)
            self._units[device.unit] = device

    def has(self, unit: int) -> bool:
        """Whether a request to `unit` concerns any device here (the broadcast concerns all)."""
        return unit == BROADCAST or unit in self._units

    def answer(self, unit: int, pdu: bytes) -> bytes | None:
        """Let the devices act on a request; return the answer, None for silence."""
        if unit == BROADCAST:
            for device in self._units.values():
                device.handle(pdu, broadcast=True)
            return None
        if unit in self._units:
            return self._units[unit].handle(pdu)
        return exception_answer(pdu[0], NO_RESPONSE_FROM_TARGET) if self._foreign is Foreign.GATEWAY else None
