"""The requests of least total cost that cover what is wanted: an exact dynamic program over sorted addresses.

A want is a choice of items of which one must be read; mostly there is one. Where no want has a choice, some optimal
solution serves the items of a stretch in the order of their addresses, each by the open request or by a new one,
because a request that reaches over an item holds it anyway. `sweep` does the rest.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from regscribe_runtime.planning.address_ranges import RegisterSpan
from regscribe_runtime.planning.cost import Tariff
from regscribe_runtime.planning.sweep import Reach, Stop, sweep

Want = tuple[RegisterSpan, ...]
"""Items of which one must be read."""


class Lane(NamedTuple):
    """Where a request may run: a stretch of one space, its price list, and the most addresses of one request."""

    space: str
    first: int
    tariff: Tariff
    most: int


class Cover(NamedTuple):
    """The requests, as items; `exact` unless there were too many ways to look at all (see `sweep`)."""

    requests: tuple[RegisterSpan, ...]
    exact: bool = True


class _Open(NamedTuple):
    """A request that items are added to: what was paid before it, its first item, its addresses."""

    paid: int
    place: int
    start: int
    end: int


def cover(wants: Iterable[Want], lanes: Mapping[RegisterSpan, Lane]) -> Cover:
    """Requests of least total cost such that each want has an item inside one; `lanes` tells where each item lies."""
    distinct = list(dict.fromkeys(wants))
    clusters = [found for lane, items in _by_lane(distinct, lanes).items() for found in _clusters(items, lane)]
    home = {item: number for number, (_, items) in enumerate(clusters) for item in items}
    joined, mixed = _joined(distinct, home, len(clusters))
    requests: list[RegisterSpan] = []
    exact = True
    for root, members in joined.items():
        if root not in mixed:
            lane, items = clusters[members[0]]
            requests += line(items, lane)
            continue
        found, complete = _swept([clusters[one] for one in members], distinct, home, members)
        requests += found
        exact = exact and complete
    return Cover(tuple(sorted(requests)), exact)


def line(items: Sequence[RegisterSpan], lane: Lane) -> Iterator[RegisterSpan]:
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


def _by_lane(wants: Iterable[Want], lanes: Mapping[RegisterSpan, Lane]) -> dict[Lane, list[RegisterSpan]]:
    found: dict[Lane, list[RegisterSpan]] = {}
    for item in sorted({item for want in wants for item in want}):
        found.setdefault(lanes[item], []).append(item)
    return found


def _clusters(items: list[RegisterSpan], lane: Lane) -> Iterator[tuple[Lane, list[RegisterSpan]]]:
    """Part the sorted items of a lane where no request is worth its reach: over a gap dearer than a request."""
    cluster: list[RegisterSpan] = []
    end, apart = 0, lane.tariff.fixed + lane.tariff.slack
    for item in items:
        gap = item.address - end
        if cluster and gap > 0 and (lane.tariff.saved(gap) >= apart or gap >= lane.most):
            yield lane, cluster
            cluster = []
        cluster.append(item)
        end = max(end, item.end)
    yield lane, cluster


def _joined(
    wants: Sequence[Want], home: Mapping[RegisterSpan, int], count: int
) -> tuple[dict[int, list[int]], set[int]]:
    """Clusters that some want has a choice between, by the first of them; and those where there is a choice at all."""
    root = list(range(count))

    def find(one: int) -> int:
        while root[one] != one:
            root[one] = one = root[root[one]]
        return one

    choices = [want for want in wants if len(want) > 1]
    for want in choices:
        for item in want:
            low, high = sorted((find(home[want[0]]), find(home[item])))
            root[high] = low
    groups: dict[int, list[int]] = {}
    for one in range(count):
        groups.setdefault(find(one), []).append(one)
    return groups, {find(home[want[0]]) for want in choices}


def _swept(
    clusters: Sequence[tuple[Lane, list[RegisterSpan]]],
    wants: Sequence[Want],
    home: Mapping[RegisterSpan, int],
    members: Sequence[int],
) -> tuple[list[RegisterSpan], bool]:
    mine = set(members)
    served: dict[RegisterSpan, list[int]] = {}
    rank: dict[int, int] = {}
    for number, want in enumerate(wants):
        if home[want[0]] in mine:
            rank[number] = want[0].address
            for item in want:
                served.setdefault(item, []).append(number)
    heads = [
        [Stop(place, item.address, item.end, tuple(served[item])) for item in items]
        for place, (_, items) in enumerate(clusters)
    ]
    found, complete = sweep(heads, [Reach(lane.tariff, lane.most) for lane, _ in clusters], rank)
    return [RegisterSpan(clusters[lane][0].space, start, end - start) for lane, start, end in found], complete
