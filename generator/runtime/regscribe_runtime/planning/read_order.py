"""Where each register of one read stands in its requests, and the order of the requests.

What values depend on is read behind them (or in the same request, which a device answers at once), so that it bears
witness for all that was read before. Where that goes round in a circle, it is read once more at the end.
"""

import heapq
from collections.abc import Collection, Mapping
from typing import NamedTuple

from regscribe_runtime.planning.plan import Block, Terms, blocks
from regscribe_runtime.planning.read_places import ReadPlace
from regscribe_runtime.values.specs import View


class WordPosition(NamedTuple):
    """Where a register is read: the number of the block, the view that decodes it, its first word in the block."""

    block: int
    view: View
    start: int


class ReadOrder(NamedTuple):
    """Blocks in the order of sending, the place of each register in them, and the one where a dependency is checked.

    The last `again` blocks are read once more: what goes round in a circle, behind all that depends on it. `atomic`:
    each value stands in one request with all that it depends on.
    """

    blocks: tuple[Block, ...]
    places: Mapping[str, WordPosition]
    checks: Mapping[str, WordPosition]
    atomic: bool
    again: int = 0


def lay_out(wanted: Mapping[str, ReadPlace], needs: Mapping[str, Collection[str]], terms: Terms) -> ReadOrder:
    """The cheapest blocks for `wanted` (places by path), ordered by what the meaning of each depends on."""
    made = blocks((place.span for place in wanted.values()), terms)
    numbers = {item: number for number, block in enumerate(made) for item in block.items}
    taken = {path: numbers[place.span] for path, place in wanted.items()}
    relations = [(path, need) for path in taken for need in needs.get(path, ()) if need in taken]
    edges = {(taken[path], taken[need]) for path, need in relations}
    order = _in_order(len(made), {edge for edge in edges if edge[0] != edge[1]})
    rank = {number: place for place, number in enumerate(order)}
    late = {need for path, need in relations if rank[taken[path]] > rank[taken[need]]}
    late |= {need for path, need in relations if path in late}
    tail = blocks((wanted[path].span for path in taken if path in late), terms)
    ordered = (*(made[number] for number in order), *tail)
    places = {path: _position(rank[number], wanted[path], ordered) for path, number in taken.items()}
    again = {
        path: _position(number, wanted[path], ordered)
        for number, block in enumerate(tail, len(made))
        for path in late
        if wanted[path].span in block.items
    }
    needed = {need for _, need in relations}
    checks = {path: again.get(path, place) for path, place in places.items() if path in needed}
    atomic = not late and all(first == then for first, then in edges)
    return ReadOrder(ordered, places, checks, atomic, again=len(tail))


def _in_order(count: int, edges: Collection[tuple[int, int]]) -> list[int]:
    """Blocks such that the first of each edge is sent before the second; a circle is cut at its lowest block."""
    behind: list[list[int]] = [[] for _ in range(count)]
    waits = [0] * count
    for first, then in edges:
        behind[first].append(then)
        waits[then] += 1
    ready = [number for number in range(count) if not waits[number]]
    left, order = dict.fromkeys(range(count)), list[int]()
    while left:
        number = heapq.heappop(ready) if ready else next(iter(left))
        if number not in left:
            continue  # a circle was cut at it
        del left[number]
        order.append(number)
        for then in behind[number]:
            waits[then] -= 1
            if not waits[then]:
                heapq.heappush(ready, then)
    return order


def _position(number: int, place: ReadPlace, ordered: tuple[Block, ...]) -> WordPosition:
    return WordPosition(number, place.view, place.span.address - ordered[number].address)
