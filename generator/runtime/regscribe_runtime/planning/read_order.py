"""Where each register of one read stands in its requests, and the order of the requests.

What values depend on is read behind them (or in the same request, which a device answers at once), so that it bears
witness for all that was read before. Where that goes round in a circle, it is read once more at the end.
"""

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import NamedTuple

from regscribe_runtime.planning.dependency_order import dependency_order
from regscribe_runtime.planning.plan import Block, Terms, blocks
from regscribe_runtime.planning.read_places import ReadPlace
from regscribe_runtime.values.views import View


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
    taken = _numbers(wanted, made)
    relations = _relations(wanted, needs)
    waits = _waits(len(made), [(taken[path], taken[need]) for path, need in relations])
    order = dependency_order(waits, int)
    late = _late(relations, {path: order.index(number) for path, number in taken.items()})
    twice = {path: place for path, place in wanted.items() if path in late}
    tail = blocks((place.span for place in twice.values()), terms)
    first = [made[number] for number in order]
    places, again = _positions(wanted, first, 0), _positions(twice, tail, len(first))
    checks = {need: again.get(need, places[need]) for _, need in relations}
    return ReadOrder((*first, *tail), places, checks, atomic=not (late or any(waits.values())), again=len(tail))


def _numbers(wanted: Mapping[str, ReadPlace], made: Sequence[Block]) -> dict[str, int]:
    """The number of the block that carries each register."""
    numbers = {span: number for number, block in enumerate(made) for span in block.items}
    return {path: numbers[place.span] for path, place in wanted.items()}


def _relations(wanted: Collection[str], needs: Mapping[str, Collection[str]]) -> list[tuple[str, str]]:
    """Each register with each of those that it needs and that are read, too."""
    return [(path, need) for path in wanted for need in needs.get(path, ()) if need in wanted]


def _waits(count: int, relations: Iterable[tuple[int, int]]) -> dict[int, set[int]]:
    """The blocks that go before each block: those of what depends on it."""
    waits: dict[int, set[int]] = {number: set() for number in range(count)}
    for first, then in relations:
        waits[then] |= {first} - {then}
    return waits


def _late(relations: Sequence[tuple[str, str]], rank: Mapping[str, int]) -> set[str]:
    """What would be read before something that depends on it, and what these depend on in turn."""
    late = {need for path, need in relations if rank[path] > rank[need]}
    return late | {need for path, need in relations if path in late}


def _positions(wanted: Mapping[str, ReadPlace], made: Sequence[Block], first: int) -> dict[str, WordPosition]:
    """Where each register stands in blocks whose first has the number `first`."""
    return {
        path: WordPosition(first + number, wanted[path].view, wanted[path].span.address - made[number].address)
        for path, number in _numbers(wanted, made).items()
    }
