"""What one unit turned out not to have: addresses that it refused to read, remembered for a while.

A unit may lack an option, or be of an older issue than its manual. Nothing is disabled for ever: what was refused is
tried again after `seconds`, and after the link was opened anew, since another unit may answer then.
"""

import time
from collections.abc import Callable
from datetime import UTC, datetime
from typing import NamedTuple

from regscribe_runtime.errors import Absent, RegscribeError
from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.values.wire_types import Space

EXPIRY_SECONDS = 600.0
"""How long a refused address is left out."""


class Refusal(NamedTuple):
    """Addresses that were refused, the answer, and when that was, as seconds since 1970.

    `alone`: refused by a request of their own. Otherwise they were part of a refused request and of no good one since:
    they are not read along, but may be asked for. `passing`: the unit has shown to have them, so the next read of
    several asks again.
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
        """Remember that these addresses were refused now."""
        self._refusals[item] = Refusal(item, answer, self.clock(), alone, passing)

    def heard(self, space: Space, address: int, quantity: int) -> bool:
        """Forget what was refused and is in a good answer now; whether there was such a thing."""
        good = [
            item
            for item in self._refusals
            if item.space == space and address <= item.address and item.end <= address + quantity
        ]
        return self._forget(good)

    def clear(self) -> bool:
        """Forget all; whether there was anything."""
        had = bool(self._refusals)
        self._refusals.clear()
        return had

    def expire(self) -> bool:
        """Forget what was refused too long ago, or in passing; whether there was such a thing."""
        now = self.clock()
        old = [one.item for one in self._refusals.values() if one.passing or not 0 <= now - one.when < self.seconds]
        return self._forget(old)

    def _forget(self, items: list[RegisterSpan]) -> bool:
        for item in items:
            del self._refusals[item]
        return bool(items)

    def items(self, *, alone: bool) -> tuple[RegisterSpan, ...]:
        """The addresses that no plan may touch, or (not refused alone) that none may read along."""
        return tuple(one.item for one in self._refusals.values() if one.alone is alone)

    def error(self, path: str, item: RegisterSpan, unit: int) -> Absent | None:
        """The error in place of the value of the register `path`, which would be read at `item`; None if it can be."""
        touching = (
            one
            for one in self._refusals.values()
            if one.alone
            and one.item.space == item.space
            and one.item.address < item.end
            and item.address < one.item.end
        )
        found = next(touching, None)
        if found is None:
            return None
        when = datetime.fromtimestamp(found.when, UTC)
        return Absent(
            path,
            unit=unit,
            address=item.address,
            answer=found.answer,
            when=when,
            minutes=0 if found.passing else self.seconds / 60,
        )
