"""Requests without an answer: the one that is on its way, and those whose answer may still come late."""

from collections.abc import Generator
from typing import NamedTuple, TypeVar

from regscribe_runtime.values.wire_types import spelled_address
from regscribe_runtime.wire import pdu
from regscribe_runtime.wire.requests import Request, fits

T = TypeVar("T")
Steps = Generator[float, bool, T]
"""Yields the seconds to wait for bytes at most, receives whether there are any."""

BROADCAST = 0
"""A write to this unit is for all, and nobody answers."""
LATE_SECONDS = 1.0
"""How long after its timeout an answer is still expected, or once more the timeout if that is longer."""


class PendingRequest(NamedTuple):
    """A request to `unit`: as the caller made it (`shown`), with its address on the `wire`, as bytes; its timeout."""

    unit: int
    shown: Request
    wire: Request
    frame: bytes
    seconds: float

    def __str__(self) -> str:
        where = spelled_address(self.shown.function, self.shown.address)
        return f"unit {self.unit}, function {self.shown.function:02d}, address {where}"

    @property
    def is_broadcast(self) -> bool:
        """Whether nobody answers it."""
        return self.unit == BROADCAST and not self.wire.reads and not self.wire.answered

    @property
    def resembles_its_answer(self) -> bool:
        """Whether the request itself, echoed, would be a good answer to it (writes of one value, the loopback)."""
        return fits(self.wire, pdu.decode_reply(self.wire, pdu.encode_request(self.wire)))


class StaleReplies:
    """Answers that are still owed where nothing in an answer says which request it belongs to (RTU, ASCII).

    A request that got no answer in time may still get it. Until it came, or can no longer come, no request may be sent
    for whose answer it could be taken: the same unit and function, another address or another value. The very same
    read may be sent again: the late answer is an answer to it too. `busy` is the time until which the line may be busy
    with such an answer; all times are those of `time.monotonic`.
    """

    def __init__(self) -> None:
        self._owed: dict[tuple[int, int], tuple[Request, float]] = {}
        self.busy = 0.0

    def owe(self, pending: PendingRequest, deadline: float) -> None:
        """Note that an answer is missing; a request that was broken off keeps the line busy until `deadline`."""
        until = deadline + max(LATE_SECONDS, pending.seconds)
        self._owed[pending.unit, pending.wire.function] = pending.wire._replace(seconds=0.0), until
        self.busy = max(self.busy, deadline)

    def until(self, pending: PendingRequest, now: float) -> float:
        """Until when a request must wait because a late answer could be taken for its own; 0: not at all."""
        key = pending.unit, pending.wire.function
        if key not in self._owed:
            return 0.0
        request, until = self._owed[key]
        if until <= now:
            del self._owed[key]
            return 0.0
        again = pending.wire.reads and pending.wire._replace(seconds=0.0) == request
        return 0.0 if again else until

    def came(self, pending: PendingRequest) -> None:
        """Forget the answer that this request waited for: it came, or is given up."""
        self._owed.pop((pending.unit, pending.wire.function), None)

    def answered(self, pending: PendingRequest, now: float) -> None:
        """Note a good answer; if the request was a repetition, the other answer may still come."""
        if (pending.unit, pending.wire.function) in self._owed:
            self.owe(pending, now)
