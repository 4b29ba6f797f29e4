"""Covering where wants have a choice of places: all lanes are swept at once, and states keep what still matters.

A state knows the open request of each lane and the wants that were put off to a later place. It is dropped when a
cheaper one could go on like it at no greater cost, whatever comes: paying anew for requests that only the dropped one
has open, and for wants that only the cheaper one has put off. So the result is exact, and the states are few.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from regscribe_runtime.planning.cost import Tariff

MOST_STATES = 500
"""States kept at a stop, far above what real maps need; beyond, the dearest are dropped: the result is not exact."""

COMPARED = 12
"""Cheapest states that each other one is held against: those that drop most of them."""


class Stop(NamedTuple):
    """A place where wants can be served: its lane, its addresses, and the wants."""

    lane: int
    start: int
    end: int
    wants: tuple[int, ...]


class Reach(NamedTuple):
    """What requests in a lane cost, and the most addresses of one."""

    tariff: Tariff
    most: int


Request = tuple[int, int, int]
"""Lane, first address, first address behind."""
Open = tuple[int, int]
"""First address and first address behind of a request that may still grow."""
Trail = tuple[Request, "Trail | None"] | None
"""The requests that no longer grow, newest first."""
Key = tuple[tuple[Open | None, ...], frozenset[int]]


class _Ahead(NamedTuple):
    """What comes after a stop: the next start in each lane (None: nothing), the next place of each want."""

    starts: tuple[int | None, ...]
    later: Mapping[int, Stop]


class _Visit(NamedTuple):
    """A stop, the wants that it is the first or the last place of, and what comes after it."""

    stop: Stop
    first: frozenset[int]
    last: frozenset[int]
    ahead: _Ahead


States = dict[Key, tuple[int, Trail]]
"""The cost of the cheapest way into each state, and its closed requests."""


def sweep(
    lanes: Sequence[Sequence[Stop]], reaches: Sequence[Reach], rank: Mapping[int, int]
) -> tuple[list[Request], bool]:
    """The cheapest requests that serve every want at one of its stops; False beside them if states were left out.

    The stops of each lane are sorted; wants of near `rank` are looked at together.
    """
    states: States = {((None,) * len(lanes), frozenset()): (0, None)}
    complete = True
    for visit in _visits(list(_in_turn(lanes, rank)), lanes=len(lanes)):
        states = _pruned(_after(states, visit, reaches), reaches, visit.ahead)
        if len(states) > MOST_STATES:
            states, complete = dict(list(states.items())[:MOST_STATES]), False
    ((_, trail),) = states.values()
    return list(_requests(trail)), complete


def _in_turn(lanes: Sequence[Sequence[Stop]], rank: Mapping[int, int]) -> Iterator[Stop]:
    """All stops, in order within each lane, such that the places of a want follow soon upon each other."""
    places = [0] * len(lanes)
    met: set[int] = set()
    while heads := [stops[place] for stops, place in zip(lanes, places, strict=True) if place < len(stops)]:
        urgent = [stop for stop in heads if not met.isdisjoint(stop.wants)]
        best = min(urgent or heads, key=lambda stop: min(rank[want] for want in stop.wants))
        places[best.lane] += 1
        met.update(best.wants)
        yield best


def _visits(stops: Sequence[Stop], *, lanes: int) -> Iterator[_Visit]:
    first: dict[int, int] = {}
    for place, stop in enumerate(stops):
        for want in stop.wants:
            first.setdefault(want, place)
    later: dict[int, Stop] = {}
    for place, (stop, (starts, following)) in enumerate(zip(stops, _aheads(stops, lanes=lanes), strict=True)):
        later.update(following)
        begun = frozenset(want for want in stop.wants if first[want] == place)
        ended = frozenset(want for want in stop.wants if want not in following)
        yield _Visit(stop, begun, ended, _Ahead(starts, later))


def _aheads(stops: Sequence[Stop], *, lanes: int) -> list[tuple[tuple[int | None, ...], dict[int, Stop]]]:
    """For each stop, what starts next in each lane, and the next place of its wants that have one."""
    starts: list[int | None] = [None] * lanes
    later: dict[int, Stop] = {}
    found = []
    for stop in reversed(stops):
        found.append((tuple(starts), {want: later[want] for want in stop.wants if want in later}))
        starts[stop.lane] = stop.start
        later.update(dict.fromkeys(stop.wants, stop))
    return found[::-1]


def _after(states: States, visit: _Visit, reaches: Sequence[Reach]) -> States:
    found: States = {}
    for (requests, pending), (cost, trail) in states.items():
        unserved = {want for want in visit.stop.wants if want in visit.first or want in pending}
        if not unserved & visit.last:
            _keep(found, requests, pending | unserved, cost, trail, visit, reaches)
        if unserved:
            left = pending - unserved
            for more, now, behind in _served(requests, visit.stop, reaches[visit.stop.lane], trail):
                _keep(found, now, left, cost + more, behind, visit, reaches)
    return found


def _served(
    requests: tuple[Open | None, ...], stop: Stop, reach: Reach, trail: Trail
) -> Iterator[tuple[int, tuple[Open | None, ...], Trail]]:
    """The open request reaches over the stop, or a new one begins there."""
    lane, start, end, _ = stop
    price, known = reach.tariff.of, requests[lane]
    if known is not None:
        until = max(end, known[1])
        if until - known[0] <= reach.most:
            grown = price(until - known[0]) - price(known[1] - known[0])
            yield grown, (*requests[:lane], (known[0], until), *requests[lane + 1 :]), trail
        trail = (lane, *known), trail
    yield price(end - start), (*requests[:lane], (start, end), *requests[lane + 1 :]), trail


def _keep(
    states: States,
    requests: tuple[Open | None, ...],
    pending: frozenset[int],
    cost: int,
    trail: Trail,
    visit: _Visit,
    reaches: Sequence[Reach],
) -> None:
    for lane, request in enumerate(requests):
        following = visit.ahead.starts[lane]
        if request and (following is None or following - request[0] >= reaches[lane].most):
            requests = (*requests[:lane], None, *requests[lane + 1 :])
            trail = (lane, *request), trail
    key = requests, pending
    if key not in states or cost < states[key][0]:
        states[key] = cost, trail


def _pruned(states: States, reaches: Sequence[Reach], ahead: _Ahead) -> States:
    found: States = {}
    cheapest: list[tuple[int, Key]] = []
    for key, (cost, trail) in sorted(states.items(), key=lambda one: one[1][0]):
        if not any(_beaten(better, key, cost - known, reaches, ahead) for known, better in cheapest):
            found[key] = cost, trail
            if len(cheapest) < COMPARED:
                cheapest.append((cost, key))
    return found


def _beaten(better: Key, other: Key, dearer: int, reaches: Sequence[Reach], ahead: _Ahead) -> bool:
    """Whether `better`, `dearer` cheaper than `other`, can go on as it does and stay the cheaper one."""
    left = dearer
    for mine, its, reach, following in zip(better[0], other[0], reaches, ahead.starts, strict=True):
        if its is None or mine == its or following is None:
            continue
        tariff = reach.tariff
        after = mine is not None and mine[0] >= its[0]
        missing = its[1] - (mine[1] if mine is not None and after else following)
        more = (0 if after else tariff.fixed) + tariff.slack
        left -= more + tariff.of(missing) - tariff.fixed if missing > 0 else more
        if left < 0:
            return False
    put_off = better[1] - other[1]
    if put_off:
        left -= _served_anew([ahead.later[want] for want in put_off], reaches)
    # with something to pay, the better state must win: at a tie each could be dropped for the other
    return left > 0 or left == dearer == 0 or (left == dearer and not put_off)


def _served_anew(stops: list[Stop], reaches: Sequence[Reach]) -> int:
    """What it costs at most to serve all these stops by requests of their own."""
    total = 0
    lane, start, end = -1, 0, 0
    for stop in sorted(stops):
        reach = reaches[stop.lane]
        price, until = reach.tariff.of, max(end, stop.end)
        joined = price(until - start) - price(end - start) if stop.lane == lane else 0
        if stop.lane == lane and until - start <= reach.most and joined < price(stop.end - stop.start):
            total, end = total + joined, until
        else:
            total += price(stop.end - stop.start)
            lane, start, end = stop.lane, stop.start, stop.end
    return total


def _requests(trail: Trail) -> Iterator[Request]:
    left = trail
    while left is not None:
        yield left[0]
        left = left[1]
