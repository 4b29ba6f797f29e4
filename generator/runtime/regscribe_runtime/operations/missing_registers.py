"""Addresses that one unit refused to read, remembered for a while.

A unit may lack an option, or be older than its manual. Refused addresses are tried again after `seconds`, and after the
link was reopened, since another unit may answer then.
"""

import time
from collections.abc import Callable, Collection
from datetime import UTC, datetime
from typing import NamedTuple

from regscribe_runtime.errors import Absent, RegscribeError
from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.wire.requests import Request

EXPIRY_SECONDS = 600.0
"""Seconds for which a refused address is left out."""


class Refusal(NamedTuple):
    """Addresses that were refused, the answer, and the time in seconds since 1970.

    `alone`: refused by a request of their own. Otherwise they were part of a refused request: they may be read, but not
    read along. `passing`: the unit has them, so the next read of several registers tries them again.
    """

    item: RegisterSpan
    answer: RegscribeError
    when: float
    alone: bool
    passing: bool = False


class MissingRegisters:
    """The refusals of one unit that still count; `clock` gives seconds since 1970."""

    __slots__ = ("_refusals", "clock", "seconds")

    def __init__(self, clock: Callable[[], float] = time.time, seconds: float = EXPIRY_SECONDS) -> None:
        self.clock, self.seconds = clock, seconds
        self._refusals: dict[RegisterSpan, Refusal] = {}

    def __bool__(self) -> bool:
        return bool(self._refusals)

    def add(self, item: RegisterSpan, answer: RegscribeError, *, alone: bool = True, passing: bool = False) -> None:
        """Remember a refusal of these addresses."""
        self._refusals[item] = Refusal(item, answer, self.clock(), alone, passing)

    def heard(self, request: Request) -> bool:
        """Forget refusals of addresses that a request has read; whether there were any."""
        if not self._refusals:
            return False
        space, first, end = request.space, request.address, request.address + request.quantity
        return self._forget(lambda one: one.item.space == space and first <= one.item.address and one.item.end <= end)

    def drop(self, items: Collection[RegisterSpan]) -> bool:
        """Forget refusals of these addresses; whether there were any."""
        return self._forget(lambda one: one.item in items)

    def clear(self) -> bool:
        """Forget all; whether there was anything."""
        return self._forget(lambda _: True)

    def expire(self) -> bool:
        """Forget expired and passing refusals; whether there were any."""
        now = self.clock()
        return self._forget(lambda one: one.passing or not 0 <= now - one.when < self.seconds)

    def _forget(self, over: Callable[[Refusal], bool]) -> bool:
        before = len(self._refusals)
        self._refusals = {item: one for item, one in self._refusals.items() if not over(one)}
        return len(self._refusals) < before

    def items(self, *, alone: bool) -> tuple[RegisterSpan, ...]:
        """The addresses that no plan may read, or (not refused alone) that none may read along."""
        return tuple(one.item for one in self._refusals.values() if one.alone is alone)

    def error(self, path: str, item: RegisterSpan, unit: int) -> Absent | None:
        """The error in place of the value of the register `path` at `item`; None if it can be read."""
        for refused, answer, since, alone, passing in self._refusals.values():
            touches = refused.space == item.space and refused.address < item.end and item.address < refused.end
            if alone and touches:
                when, minutes = datetime.fromtimestamp(since, UTC), 0 if passing else self.seconds / 60
                return Absent(
                    path, unit=unit, address=item.space.inside(item.address), answer=answer, when=when, minutes=minutes
                )
        return None
