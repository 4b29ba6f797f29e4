"""The order of things that wait for each other."""

import heapq
from collections.abc import Callable, Collection, Mapping
from typing import Any, TypeVar

K = TypeVar("K")


def dependency_order(needs: Mapping[K, Collection[K]], rank: Callable[[K], Any]) -> list[K]:
    """The keys such that those which each needs stand before it, of several the one of the lowest rank first.

    A circle is cut at its lowest rank.
    """
    behind = _behind(needs)
    waits = {key: len(before) for key, before in needs.items()}
    left = dict.fromkeys(sorted(needs, key=rank))
    places = {key: place for place, key in enumerate(left)}
    ready = [(places[key], key) for key in left if not waits[key]]
    order: list[K] = []
    while left:
        key = heapq.heappop(ready)[1] if ready else next(iter(left))
        if key not in left:
            continue  # a circle was cut at it
        del left[key]
        order.append(key)
        for one in behind[key]:
            waits[one] -= 1
            if not waits[one]:
                heapq.heappush(ready, (places[one], one))
    return order


def _behind(needs: Mapping[K, Collection[K]]) -> dict[K, list[K]]:
    """What needs each key."""
    behind: dict[K, list[K]] = {key: [] for key in needs}
    for key, before in needs.items():
        for one in before:
            behind[one].append(key)
    return behind
