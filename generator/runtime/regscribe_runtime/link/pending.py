"""A request on its way: what the steps of a conversation share."""

from collections.abc import Generator
from typing import NamedTuple, TypeVar

from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.requests import Request, fits

T = TypeVar("T")
Steps = Generator[float, bool, T]
"""Yields how many seconds to wait for bytes at most, receives whether there are any."""

CHECK = "Check speed, parity, wiring and termination, and that no two units have one id and no second master talks"


class PendingRequest(NamedTuple):
    """A request to `unit`: as the caller made it (`shown`), as it stands on the `wire`, frame and timeout."""

    unit: int
    shown: Request
    wire: Request
    frame: bytes
    seconds: float

    def __str__(self) -> str:
        return f"unit {self.unit}, function {self.shown.function:02d}, address {self.shown.address}"

    @property
    def resembles_its_answer(self) -> bool:
        """Whether the request itself, echoed, would be a good answer to it (writes of one value, the loopback)."""
        return fits(self.wire, pdu.decode_reply(self.wire, pdu.encode_request(self.wire)))
