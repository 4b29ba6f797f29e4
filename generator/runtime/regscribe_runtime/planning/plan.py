"""The read requests of least total cost for a set of registers, and why neighbours are not one request.

A request may cover what `ground` allows, up to the device's limit. The result is exact and the same every time.
`blocks` serves drivers; `explain` adds costs and reasons for `regscribe plan`.
"""

from collections import defaultdict
from collections.abc import Iterable, Sequence
from enum import StrEnum
from itertools import pairwise
from typing import NamedTuple

from regscribe_runtime.planning.address_ranges import AddressRanges, AddressStretch, RegisterSpan
from regscribe_runtime.planning.block_cover import cheapest_cover
from regscribe_runtime.planning.cost import Cost, Tariff, milliseconds
from regscribe_runtime.values.facts import CommandStep, Page
from regscribe_runtime.values.protocol import Protocol, SpaceLimits
from regscribe_runtime.values.wire_types import WRITE_AND_READ, Space, written_space


class Block(NamedTuple):
    """One read request and the items that it carries, in the order of their addresses; without items, a write."""

    function: int
    address: int
    quantity: int
    items: tuple[RegisterSpan, ...]

    @property
    def space(self) -> Space:
        """The space that is read, or written."""
        return self.items[0].space if self.items else written_space(self.function, self.address)

    @property
    def end(self) -> int:
        """The first address behind it."""
        return self.address + self.quantity


class RequestLimits(NamedTuple):
    """Most words and bits in one read (in `spaces` others), and whether addresses of no register may be read along."""

    words: int = 125
    bits: int = 2000
    holes: bool = False
    spaces: tuple[SpaceLimits, ...] = ()

    @classmethod
    def of(cls, protocol: Protocol) -> "RequestLimits":
        """The limits of a device."""
        return cls(protocol.read_words, protocol.read_bits, protocol.read_holes, protocol.spaces)

    def most(self, space: Space) -> int:
        """The most addresses of one read; a queue comes as a whole."""
        if space.is_whole:
            return space.most
        own = next((one.read for one in self.spaces if one.space is space), 0)
        most = min(space.most, space.each * own or (self.bits if space.is_bits else self.words))
        return most - most % space.each


class Terms(NamedTuple):
    """Constraints and prices of a plan: the device's limits, the addresses that may be read, the cost of requests.

    `pages` are how each page is reached.
    """

    limits: RequestLimits
    ground: AddressRanges
    cost: Cost
    pages: tuple[Page, ...] = ()

    def tariff(self, space: Space, address: int) -> Tariff:
        """The cost of reads where an address stands."""
        return self.cost.tariff(space, len(self.words(space, address)))

    def words(self, space: Space, address: int) -> tuple[int, ...]:
        """What a read of an address writes in the same request, to select a page."""
        page = space.page(address) if space is Space.HOLDING else 0
        return self.pages[page - 1].words if page and self.pages[page - 1].at_once else ()

    def steps(self, block: "Block", selected: int) -> tuple[int, tuple[CommandStep, ...]]:
        """The page that is selected for a read while `selected` is (0: none), and what is written to select it."""
        page = block.space.page(block.address)
        if self.words(block.space, block.address):
            return 0, ()
        if page in {0, selected} or not self.pages or not self.pages[page - 1].steps:
            return selected, ()
        return page, self.pages[page - 1].steps

    def spelled(self, space: Space, address: int) -> str:
        """An address for people, with the page that it is on or the unit id that it is at."""
        page = space.page(address)
        unit = self.pages[page - 1].unit if page and self.pages else 0
        return f"{space.inside(address)} at unit id {unit}" if unit else space.spelled(address)

    def most(self, block: Block) -> int:
        """The most addresses of one request there."""
        most, stretch = self.limits.most(block.space), self.ground.stretch(block.items[0])
        return most - most % (stretch.align if stretch else 1)


class SplitReason(StrEnum):
    """Why a request is not one with the request before."""

    FIRST = "first"
    SPACE = "other function"
    LIMIT = "limit"
    HOLE = "hole"
    UNREADABLE = "unreadable"
    REFUSED = "refused"
    ALIGNMENT = "alignment"
    CLEARS = "clears"
    CHEAPER = "cheaper apart"
    AGAIN = "once more"
    SELECTS = "selects a page"
    PAGE = "other page or unit id"


class Split(NamedTuple):
    """The reason and its numbers, in words."""

    reason: SplitReason
    detail: str = ""


class Planned(NamedTuple):
    """One request of a plan: how many of its addresses are wanted, bytes of its frames, expected milliseconds.

    `words` are what it writes, to select a page.
    """

    block: Block
    wanted: int
    bytes: int
    ms: float
    split: Split
    words: tuple[int, ...] = ()

    @property
    def quantity(self) -> int:
        """The quantity that stands in the request."""
        return self.block.quantity // self.block.space.each

    @property
    def carried(self) -> int:
        """Addresses that its answer carries."""
        return self.quantity if self.block.items else 0


class Plan(NamedTuple):
    """The requests of a plan in the order of sending."""

    requests: tuple[Planned, ...]

    @property
    def wanted(self) -> int:
        """Addresses that were asked for."""
        return sum(one.wanted for one in self.requests)

    @property
    def carried(self) -> int:
        """Addresses that the answers carry."""
        return sum(one.carried for one in self.requests)

    @property
    def bytes(self) -> int:
        """Bytes of all frames, both ways."""
        return sum(one.bytes for one in self.requests)

    @property
    def ms(self) -> float:
        """Expected milliseconds of the whole."""
        return sum(one.ms for one in self.requests)


def blocks(items: Iterable[RegisterSpan], terms: Terms) -> tuple[Block, ...]:
    """The requests of least total cost that read all items; ValueError for one that cannot be read.

    An item that is longer than a request is a block of its own, which goes out `as_sent`.
    """
    stretches: dict[tuple[Space, AddressStretch], dict[RegisterSpan, list[RegisterSpan]]] = defaultdict(dict)
    for item in dict.fromkeys(items):
        stretch = terms.ground.stretch(item)
        if stretch is None:
            message = f"{item.space} {item.address}..{item.end - 1} cannot be read"
            raise ValueError(message)
        stretches[item.space, stretch].setdefault(terms.ground.widened(item), []).append(item)
    found = []
    for (space, stretch), held in stretches.items():
        most = terms.limits.most(space)
        tariff = terms.tariff(space, stretch.first)
        for spans in cheapest_cover(sorted(held, key=_longer_first), tariff, most - most % stretch.align):
            first, end = spans[0].address, max(span.end for span in spans)
            carried = sorted(item for span in spans for item in held[span])
            found.append(Block(space.read_function, first, end - first, tuple(carried)))
    page = {block: block.space.page(block.address) for block in found}
    return tuple(sorted(found, key=lambda block: (page[block], block.space, block.address, block.quantity)))


def _longer_first(item: RegisterSpan) -> tuple[int, int]:
    """By address; what begins within a longer item is read in that item's request, so that both have the same words."""
    return item.address, -item.words


def explain(requests: Sequence[Block], terms: Terms, *, again: int = 0) -> Plan:
    """Requests in the order of sending, each with its cost and why it is not one with its neighbour by address.

    The last `again` of them are repeated reads. Before them stand the writes that select a page.
    """
    sent = [
        (part, number >= len(requests) - again) for number, one in enumerate(requests) for part in as_sent(one, terms)
    ]
    first_time = sorted((part for part, repeated in sent if not repeated), key=lambda one: (one.space, one.address))
    reasons = {block: split(before, block, terms) for before, block in pairwise((None, *first_time)) if block}
    planned: list[Planned] = []
    selected = 0
    for block, repeated in sent:
        selected, steps = terms.steps(block, selected)
        planned += [_selecting(selected, step, terms.cost) for step in steps]
        reason = Split(SplitReason.AGAIN, "others depend on it, and it on them") if repeated else reasons[block]
        planned.append(_reading(block, reason, terms))
    return Plan(tuple(planned))


def as_sent(block: Block, terms: Terms) -> list[Block]:
    """The requests of a block: several where a value in it is longer than a request."""
    most = terms.most(block)
    starts = range(block.address, block.end, most)
    return [block._replace(address=start, quantity=min(most, block.end - start)) for start in starts]


def _reading(block: Block, reason: Split, terms: Terms) -> Planned:
    """A request of a plan, by function 23 where it selects the page of what it reads."""
    held = range(block.address, block.end)
    wanted = {address for item in block.items for address in range(item.address, item.end) if address in held}
    words = terms.words(block.space, block.address)
    size = terms.cost.frame_bytes(block.space, block.quantity, len(words))
    ms = milliseconds(terms.tariff(block.space, block.address).of(block.quantity))
    sent = block._replace(function=WRITE_AND_READ) if words else block
    return Planned(sent, len(wanted) // block.space.each, size, ms, reason, words)


def one_by_one(items: Iterable[RegisterSpan], terms: Terms) -> Plan:
    """A request for each item, after the writes that select its page."""
    made = (Block(one.space.read_function, one.address, one.words, (one,)) for one in items)
    return Plan(tuple(one for block in made for one in explain([block], terms).requests))


def _selecting(page: int, step: CommandStep, cost: Cost) -> Planned:
    """A write that selects a page."""
    count = len(step.words)
    block = Block(step.function, step.address, count, ())
    size, ms = cost.write_bytes(step.function, count), milliseconds(cost.of_write(step.function, count))
    return Planned(block, 0, size, ms, Split(SplitReason.SELECTS, str(page)), step.words)


GAPS = {
    "hole": "no registers",
    "refused": "refused by this unit",
    "unreadable": "not readable",
    "clears": "reading clears one of them",
}
"""What may lie between two requests, in words."""


def split(before: Block | None, block: Block, terms: Terms) -> Split:
    """Why two neighbours of a plan are two requests."""
    if before is None:
        return Split(SplitReason.FIRST)
    if elsewhere := _elsewhere(before, block):
        return elsewhere
    first, last = (RegisterSpan(one.space, one.address, one.quantity) for one in (before, block))
    gap = block.address - before.end
    barred = terms.ground.between(first, last)
    if barred in GAPS:
        spelled = block.space.spelled
        where = f"{spelled(before.end)}..{spelled(block.address - 1)}" if gap > 0 else f"at {spelled(block.address)}"
        return Split(SplitReason(barred), GAPS[barred] if barred == "clears" else f"{GAPS[barred]} {where}")
    if beyond := _beyond(before, block, terms.limits.most(block.space) // block.space.each):
        return Split(SplitReason.LIMIT, beyond)
    if barred:
        return Split(SplitReason.ALIGNMENT, f"requests from {block.space.spelled(block.address)} on must be aligned")
    tariff = terms.tariff(block.space, block.address)
    saved = tariff.of(block.end - before.address) - tariff.of(before.quantity) - tariff.of(block.quantity)
    return Split(SplitReason.CHEAPER, f"{gap} between, saves {milliseconds(saved):.1f} ms")


def _elsewhere(before: Block, block: Block) -> Split | None:
    """Why no request could ever carry both: another space, page or unit id."""
    if before.space != block.space:
        return Split(SplitReason.SPACE, f"function {before.function:02d} before")
    return Split(SplitReason.PAGE) if block.space.page(before.address) != block.space.page(block.address) else None


def _beyond(before: Block, block: Block, most: int) -> str:
    """How far two neighbours together are more than a request may carry; empty where they are not."""
    long = next((one.items[0].words for one in (before, block) if one.quantity < one.items[0].words), 0)
    each = block.space.each
    if long:
        return f"a value of {long // each} in requests of its own, limit {most}"
    together = (block.end - before.address) // each
    return f"{together} together, limit {most}" if together > most else ""
