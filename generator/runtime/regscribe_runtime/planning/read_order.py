"""The position of each register in the requests of one read, and the order of the requests.

What values depend on is read behind them (or in the same request, which a device answers at once), so that it holds
for all that was read before. Dependencies in a cycle are read once more at the end.
"""

from collections.abc import Collection, Mapping, Sequence
from operator import attrgetter
from typing import NamedTuple

from regscribe_runtime.planning.dependency_order import dependency_order
from regscribe_runtime.planning.plan import Block, Terms, blocks
from regscribe_runtime.planning.read_places import ReadPlace
from regscribe_runtime.values.views import View

_span = attrgetter("span")


class WordPosition(NamedTuple):
    """Where a register is read: the number of the block, the view that decodes it, its first word in the block."""

    block: int
    view: View
    start: int


class ReadOrder(NamedTuple):
    """Blocks in the order of sending, the position of each register in them, and the one that checks a dependency.

    The last `again` blocks repeat reads of dependencies in a cycle. `atomic`: each value stands in one request with all
    that it depends on.
    """

    blocks: tuple[Block, ...]
    places: Mapping[str, WordPosition]
    checks: Mapping[str, WordPosition]
    atomic: bool
    again: int = 0


def lay_out(
    wanted: Mapping[str, ReadPlace], needs: Mapping[str, Collection[str]], terms: Terms, gone: Collection[str] = ()
) -> ReadOrder:
    """The cheapest blocks for `wanted` (places by path), dependencies (`needs` by path) behind what depends on them.

    What the absence of the registers `gone` depends on is checked as well.
    """
    unordered = blocks(map(_span, wanted.values()), terms)
    found = _positions(wanted, unordered)
    relations = [(path, need) for path in wanted for need in needs.get(path, ()) if need in wanted]
    waits: dict[int, frozenset[int]] = dict.fromkeys(range(len(unordered)), frozenset())
    for path, need in relations:
        waits[found[need].block] |= {found[path].block} - {found[need].block}
    first = list(map(unordered.__getitem__, dependency_order(waits, int)))
    places = _positions(wanted, first)
    early = _read_early(relations, places)
    twice = {path: place for path, place in wanted.items() if path in early}
    tail = blocks(map(_span, twice.values()), terms)
    again = _positions(twice, tail, len(first))
    relations += [(path, need) for path in gone for need in needs.get(path, ()) if need in wanted]
    checks = {need: again.get(need, places[need]) for _, need in relations}
    return ReadOrder((*first, *tail), places, checks, atomic=not (early or any(waits.values())), again=len(tail))


def _read_early(relations: Sequence[tuple[str, str]], places: Mapping[str, WordPosition]) -> set[str]:
    """Dependencies that are read before a register that depends on them, and the dependencies of these."""
    early = {need for path, need in relations if places[path].block > places[need].block}
    return early | {need for path, need in relations if path in early}


def _positions(wanted: Mapping[str, ReadPlace], made: Sequence[Block], first: int = 0) -> dict[str, WordPosition]:
    """The position of each register in blocks that are numbered from `first`."""
    numbers = {span: number for number, block in enumerate(made) for span in block.items}
    found = {}
    for path, place in wanted.items():
        number = numbers[place.span]
        found[path] = WordPosition(first + number, place.view, place.span.address - made[number].address)
    return found
