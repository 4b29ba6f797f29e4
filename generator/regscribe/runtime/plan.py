"""Which registers in which requests: contiguous stretches within the device's limits.

The simple planner: it merges what touches, bridges a short gap where the device lets holes be read, and never crosses
the word limit.
"""

from collections.abc import Iterable
from typing import NamedTuple

from regscribe.runtime.request import READ_FUNCTIONS

BRIDGE = 8
"""Words worth reading for nothing: a request and its answer cost about 8 bytes each, and two silences."""


class Item(NamedTuple):
    """Addresses that are wanted together: one view of one register."""

    space: str
    address: int
    words: int

    @property
    def end(self) -> int:
        """The first address behind it."""
        return self.address + self.words


class Block(NamedTuple):
    """One read request and the items that it carries, in the order of their addresses."""

    function: int
    address: int
    quantity: int
    items: tuple[Item, ...]


class Limits(NamedTuple):
    """Most words and bits in one read, and whether addresses of no register may be read along."""

    words: int = 125
    bits: int = 2000
    holes: bool = False


def plan(items: Iterable[Item], limits: Limits) -> tuple[Block, ...]:
    """Blocks that cover every item once, none over the limit, no hole unless the device allows it."""
    blocks: list[Block] = []
    open_items: list[Item] = []
    for item in sorted(set(items)):
        if open_items and not _fits(open_items, item, limits):
            blocks.append(_block(open_items))
            open_items = []
        open_items.append(item)
    return (*blocks, _block(open_items)) if open_items else tuple(blocks)


def _fits(items: list[Item], item: Item, limits: Limits) -> bool:
    most = limits.bits if item.space in {"coil", "discrete"} else limits.words
    end = max(other.end for other in items)
    gap = BRIDGE if limits.holes else 0
    return item.space == items[0].space and item.address <= end + gap and item.end - items[0].address <= most


def _block(items: list[Item]) -> Block:
    start = items[0].address
    return Block(READ_FUNCTIONS[items[0].space], start, max(item.end for item in items) - start, tuple(items))
