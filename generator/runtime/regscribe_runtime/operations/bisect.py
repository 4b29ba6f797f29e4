"""Bisection of a refused read request until the registers that the unit lacks are found; the others are delivered.

A register is absent if the unit answers a read of it alone with the exception that the map gives for bad addresses.
Other exceptions, and silence, are raised. Where the map says that the device does not answer for bad addresses, silence
means absence if it is repeated and the unit answers other requests.

If one half is good, the other is halved without being requested as a whole: one absent register among n takes between
log2(n) and 2 log2(n) requests.
"""

from collections.abc import Generator, Sequence
from itertools import chain
from typing import Any

from regscribe_runtime.errors import ExceptionAnswer, NoAnswer, RegscribeError
from regscribe_runtime.operations.session import Session
from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.planning.plan import Block
from regscribe_runtime.planning.read_places import read_places
from regscribe_runtime.wire.requests import Request

MOST_SILENT = 3
"""Requests in a row without an answer after which no more are sent."""

REFUSALS = (ExceptionAnswer, NoAnswer)
"""Errors that may mean an absent register; see `is_absence`."""

Words = tuple[int | None, ...]
"""The words of a block; None at addresses that could not be read."""


def is_absence(error: RegscribeError, absent: int) -> bool:
    """Whether an error means a bad address; `absent` is the device's exception code for these (0: silence)."""
    if isinstance(error, ExceptionAnswer):
        return bool(absent) and error.code == absent
    return isinstance(error, NoAnswer) and not absent


class Bisection:
    """Reads what can be read of a refused block, and remembers in the session what cannot."""

    def __init__(self, session: Session, block: Block, error: RegscribeError, *, heard: bool) -> None:
        self.session, self.block, self.error = session, block, error
        self.words: list[int | None] = [None] * block.quantity
        self.refused: dict[RegisterSpan, RegscribeError] = {}
        self.silent = int(isinstance(error, NoAnswer))
        self.heard = heard or not self.silent

    def run(self) -> Generator[Any, Any, Words]:
        """The words of the block that can be read; raises errors of the whole unit."""
        items = self.block.items
        if len(items) == 1 and isinstance(self.error, ExceptionAnswer):
            self.refused[items[0]] = self.error
        else:
            yield from self._sift(items, bad=True)
        if not self.heard:
            raise self.error
        places = map(read_places, map(self.session.registers.__getitem__, self.session.proven))
        proven = {place.span for place in chain.from_iterable(places)}
        for item, error in self.refused.items():
            self.session.absences.add(item, error, passing=item in proven)
        wanted = set(chain.from_iterable(range(item.address, item.end) for item in items))
        for address, word in enumerate(self.words, self.block.address):
            if word is None and address not in wanted:  # read along and in no good request: it may have been refused
                self.session.absences.add(RegisterSpan(self.block.space, address, 1), self.error, alone=False)
        self.session.prepared.clear()
        return tuple(self.words)

    def _sift(self, items: Sequence[RegisterSpan], *, bad: bool) -> Generator[Any, Any, bool]:
        """Whether all of `items` could be read; `bad`: known to be refused as a whole."""
        if len(items) == 1:
            return (yield from self._alone(items[0]))
        if not bad and (yield from self._read(items)) is None:
            return True
        half = len(items) // 2
        first = yield from self._sift(items[:half], bad=False)
        second = yield from self._sift(items[half:], bad=first)
        return first and second

    def _alone(self, item: RegisterSpan) -> Generator[Any, Any, bool]:
        error = yield from self._read([item])
        if isinstance(error, NoAnswer):
            error = yield from self._read([item])  # a frame may have been lost: silence must be repeated to count
        if error:
            self.refused[item] = error
        return error is None

    def _read(self, items: Sequence[RegisterSpan]) -> Generator[Any, Any, RegscribeError | None]:
        """Read items by one request; the error that says that the device lacks one of them, or None."""
        wide = [self.session.terms().ground.widened(item) for item in items]
        start, end = min(item.address for item in wide), max(item.end for item in wide)
        try:
            words = yield from self.session.exchange(Request(self.block.function, start, end - start))
        except REFUSALS as error:
            if not is_absence(error, self.session.protocol.absent):
                raise
            self.silent = self.silent + 1 if isinstance(error, NoAnswer) else 0
            self.heard = self.heard or not self.silent
            if self.silent >= MOST_SILENT and not self.heard:
                raise
            return error
        self.heard, self.silent = True, 0
        self.words[start - self.block.address : end - self.block.address] = words
        return None
