"""The cheapest split of sorted addresses into requests: an exact dynamic program.

Some optimal solution serves the items of a stretch in the order of their addresses, each by the open request or by a
new one, because a request that reaches over an item holds it anyway.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.planning.cost import Tariff


class _Open(NamedTuple):
    """A request that items are added to: the cost before it, the number of its first item, its addresses."""

    paid: int
    place: int
    start: int
    end: int


def cheapest_cover(items: Sequence[RegisterSpan], tariff: Tariff, most: int) -> Iterator[Sequence[RegisterSpan]]:
    """The items of each request of the cheapest set that holds all of them, the last request first.

    `items` are of one stretch, sorted and distinct; `most` is the most addresses of one request.
    """
    saved, cost = tariff.saved, tariff.of
    paid = [0]
    begun: list[int] = []
    candidates: list[_Open] = []
    for place, item in enumerate(items):
        start, end, before = item.address, item.end, paid[-1]
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
        yield items[first:place]
        place = first
