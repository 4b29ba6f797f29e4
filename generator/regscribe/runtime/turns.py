"""Whose turn it is on a link: requests one after the other, operations of one unit one after the other.

Two locks, both first come, first served. `line` is held for one request and its answer, so that a long operation of one
unit lets the others in between. `of(unit)` is held for a whole operation of a unit, so that nobody comes between a read
and the write that depends on it; other units do not mind. `line` is always the inner one, so the two cannot deadlock.
"""

import asyncio
import threading
from collections import deque
from types import TracebackType
from typing import Self


class FairLock:
    """A lock for threads that may be taken again by its holder, and is handed on in the order of asking."""

    __slots__ = ("_depth", "_mutex", "_owner", "_queue")

    def __init__(self) -> None:
        self._mutex = threading.Lock()
        self._owner: int | None = None
        self._depth = 0
        self._queue: deque[tuple[threading.Lock, int]] = deque()

    def acquire(self) -> None:
        """Wait for one's turn."""
        me = threading.get_ident()
        if self._owner == me:
            self._depth += 1
            return
        with self._mutex:
            if self._owner is None:
                self._owner, self._depth = me, 1
                return
            turn = threading.Lock()
            turn.acquire()
            self._queue.append((turn, me))
        try:
            turn.acquire()  # released by the one before
        except BaseException:
            self._give_up(turn, me)
            raise

    def release(self) -> None:
        """Let the next one in."""
        if self._owner != threading.get_ident():
            message = "this thread does not hold the lock"
            raise RuntimeError(message)
        self._depth -= 1
        if not self._depth:
            self._hand_on()

    def _hand_on(self) -> None:
        with self._mutex:
            self._owner = None
            if self._queue:
                turn, self._owner = self._queue.popleft()
                self._depth = 1
                turn.release()

    def _give_up(self, turn: threading.Lock, me: int) -> None:
        with self._mutex:
            if (turn, me) in self._queue:
                self._queue.remove((turn, me))
                return
        self._hand_on()  # the turn came at the very moment

    def __enter__(self) -> Self:
        self.acquire()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.release()


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
