"""Answers that are still owed on a serial line, where nothing in an answer says which request it belongs to.

A request that got no answer in time may still get it. Until it came, or can no longer come, no request may be sent for
whose answer it could be taken: the same unit and function, another address or another value. The very same read may be
sent again: the late answer is an answer to it too.
"""

from typing import NamedTuple

from regscribe_runtime.wire.requests import Request

LATE_SECONDS = 1.0
"""How long after its timeout an answer is still expected, or once more the timeout if that is longer."""


class _Owed(NamedTuple):
    request: Request
    until: float


class StaleReplies:
    """Who still owes an answer, and until when the line may be busy with one; times as of `time.monotonic`."""

    def __init__(self) -> None:
        self._owed: dict[tuple[int, int], _Owed] = {}
        self.busy = 0.0

    def owe(self, unit: int, request: Request, *, deadline: float, seconds: float) -> None:
        """`request` went out and has no answer yet; one that was broken off keeps the line busy until `deadline`."""
        until = deadline + max(LATE_SECONDS, seconds)
        self._owed[unit, request.function] = _Owed(request._replace(seconds=0.0), until)
        self.busy = max(self.busy, deadline)

    def until(self, unit: int, request: Request, now: float) -> float:
        """Until when `request` must wait because a late answer could be taken for its own; 0: not at all."""
        owed = self._owed.get((unit, request.function))
        if owed is None:
            return 0.0
        if owed.until <= now:
            del self._owed[unit, request.function]
            return 0.0
        again = request.reads and request._replace(seconds=0.0) == owed.request
        return 0.0 if again else owed.until

    def came(self, unit: int, request: Request) -> None:
        """The owed answer came, or nobody waits for it any more."""
        self._owed.pop((unit, request.function), None)

    def answered(self, unit: int, request: Request, *, now: float, seconds: float) -> None:
        """`request` was answered; if it was a repetition, the other answer may still come."""
        if (unit, request.function) in self._owed:
            self.owe(unit, request, deadline=now, seconds=seconds)
