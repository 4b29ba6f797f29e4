"""Locks of a link: requests one after the other, operations of one unit one after the other.

Two locks, both first come, first served. `line` is held for one request and its answer, so that a long operation of one
unit lets the others in between. `of(unit)` is held for a whole operation of a unit, so that nobody comes between a read
and the write that depends on it; other units do not mind. `line` is always the inner one, so the two cannot deadlock.
"""

import asyncio
import contextlib
import threading
from collections import deque
from types import TracebackType
from typing import Self


class FairLock:
    """A lock for threads that may be taken again by its holder, and is handed on in the order of asking.

    The head of the queue holds it. Each waits for a lock of its own, which the one before releases; a deque's methods
    are atomic, so no further lock is needed.
    """

    __slots__ = ("_depth", "_owner", "_queue")

    def __init__(self) -> None:
        self._owner: int | None = None
        self._depth = 0
        self._queue: deque[threading.Lock] = deque()

    def __enter__(self) -> Self:
        me = threading.get_ident()
        if self._owner == me:
            self._depth += 1
            return self
        turn = threading.Lock()
        turn.acquire()
        self._queue.append(turn)
        if self._queue[0] is not turn:
            try:
                turn.acquire()
            except BaseException:  # Ctrl-C: leave the queue, and wake the head in case that this was it
                self._queue.remove(turn)
                self._wake()
                raise
        self._owner, self._depth = me, 1
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._depth -= 1
        if not self._depth:
            self._owner = None
            self._queue.popleft()
            if self._queue:
                self._wake()

    def _wake(self) -> None:
        # the head may be gone already, or awake since it found itself at the head
        with contextlib.suppress(IndexError, RuntimeError):
            self._queue[0].release()


class Turns:
    """The locks of a link for threads."""

    def __init__(self) -> None:
        self.line = FairLock()
        self._units: dict[int, FairLock] = {}

    def of(self, unit: int) -> FairLock:
        """The lock of a unit's operations; its holder may take it again."""
        return self._units.get(unit) or self._units.setdefault(unit, FairLock())


class AsyncTurns:
    """The locks of a link for tasks of one event loop; an asyncio.Lock is fair."""

    def __init__(self) -> None:
        self.line = asyncio.Lock()
        self._units: dict[int, asyncio.Lock] = {}

    def of(self, unit: int) -> asyncio.Lock:
        """The lock of a unit's operations."""
        return self._units.get(unit) or self._units.setdefault(unit, asyncio.Lock())
