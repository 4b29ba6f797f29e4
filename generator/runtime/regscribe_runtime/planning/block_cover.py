"""The requests of least total cost that cover what is wanted: an exact dynamic program over sorted addresses.

Some optimal solution serves the items of a stretch in the order of their addresses, each by the open request or by a
new one, because a request that reaches over an item holds it anyway.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.planning.cost import Tariff
from regscribe_runtime.values.wire_types import Space


class Lane(NamedTuple):
    """Where a request may run: a stretch of one space, its price list, and the most addresses of one request."""

    space: Space
    first: int
    tariff: Tariff
    most: int


class _Open(NamedTuple):
    """A request that items are added to: what was paid before it, its first item, its addresses."""

    paid: int
    place: int
    start: int
    end: int


def cover(items: Iterable[RegisterSpan], lanes: Mapping[RegisterSpan, Lane]) -> tuple[RegisterSpan, ...]:
    """Requests of least total cost that hold each item whole; `lanes` tells where each item lies."""
    by_lane: dict[Lane, list[RegisterSpan]] = {}
    for item in sorted(set(items)):
        by_lane.setdefault(lanes[item], []).append(item)
    return tuple(sorted(request for lane, found in by_lane.items() for request in _cheapest(found, lane)))


def _cheapest(items: Sequence[RegisterSpan], lane: Lane) -> Iterator[RegisterSpan]:
    """The cheapest requests for all `items` of one lane, sorted and distinct; the last one first."""
    saved, cost, most = lane.tariff.saved, lane.tariff.of, lane.most
    paid = [0]
    begun: list[int] = []
    candidates: list[_Open] = []
    for place, item in enumerate(items):
        _, start, words = item
        end, before = start + words, paid[-1]
        # an earlier start is of no use if starting here has cost no more than it will go on costing
        candidates = [
            one if one.end >= end else one._replace(end=end)
            for one in candidates
            if before > one.paid + saved(start - one.start) and end - one.start <= most
        ]
        candidates.append(_Open(before, place, start, end))
        total, first = min((one.paid + cost(one.end - one.start), one.place) for one in candidates)
        paid.append(total)
        begun.append(first)
    place = len(items)
    while place:
        first = begun[place - 1]
        space, start, _ = items[first]
        end = max(item.end for item in items[first:place])
        yield RegisterSpan(space, start, end - start)
        place = first
