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
    for key, needed in needs.items():
        for one in needed:
            dependents[one].append(key)
    waits = {key: len(needed) for key, needed in needs.items()}
    left = dict.fromkeys(sorted(needs, key=rank))
    places = {key: place for place, key in enumerate(left)}
    ready = [(places[key], key) for key in left if not waits[key]]
    order: list[K] = []
    while left:
        key = heapq.heappop(ready)[1] if ready else next(iter(left))
        if key not in left:
            continue  # a cycle was cut at it
        del left[key]
        order.append(key)
        for one in dependents[key]:
            waits[one] -= 1
            if not waits[one]:
                heapq.heappush(ready, (places[one], one))
    return order
