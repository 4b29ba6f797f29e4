"""Topological order with a rank among what is ready."""

import heapq
from collections import defaultdict
from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeVar

K = TypeVar("K")


def dependency_order(needs: Mapping[K, Collection[K]], rank: Callable[[K], Any]) -> list[K]:
    """The keys in topological order: each behind the keys it needs, the lowest rank first among those ready.

    A cycle is cut at its lowest rank.
    """
    dependents: dict[K, list[K]] = defaultdict(list)
    waits: dict[K, int] = {}
    for key, needed in needs.items():
        waits[key] = len(needed)
        for one in needed:
            dependents[one].append(key)
    left = {key: place for place, key in enumerate(sorted(needs, key=rank))}
    ready = [(place, key) for key, place in left.items() if not waits[key]]
    order: list[K] = []
    while left:
        key = heapq.heappop(ready)[1] if ready else next(iter(left))
        del left[key]
        order.append(key)
        waits[key] = 0  # where a cycle was cut: it never becomes ready
        for one in dependents[key]:
            waits[one] -= 1
            if not waits[one]:
                heapq.heappush(ready, (left[one], one))
    return order
