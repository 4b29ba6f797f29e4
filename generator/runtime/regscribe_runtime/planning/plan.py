"""Which registers in which requests: the plan of least total cost, and why it is parted where it is.

A request may cover what `ground` allows, up to the device's limit; it costs what `cost` says of the real line. Among
all partitions the cheapest is taken, exactly; of equally cheap ones the same at every time. `blocks` is for drivers,
`told` adds costs and reasons for people: `regscribe plan` shows them.
"""

from bisect import bisect_right
from collections.abc import Iterable, Sequence
from enum import StrEnum
from functools import cache
from itertools import pairwise
from typing import NamedTuple

from regscribe_runtime.planning.address_ranges import AddressRanges, RegisterSpan
from regscribe_runtime.planning.block_cover import Lane, cover
from regscribe_runtime.planning.cost import Cost, Tariff, milliseconds
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.wire_types import Space


class Block(NamedTuple):
    """One read request and the items that it carries, in the order of their addresses."""

    function: int
    address: int
    quantity: int
    items: tuple[RegisterSpan, ...]

    @property
    def space(self) -> Space:
        """The space that is read."""
        return self.items[0].space

    @property
    def end(self) -> int:
        """The first address behind it."""
        return self.address + self.quantity


class RequestLimits(NamedTuple):
    """Most words and bits in one read, and whether addresses of no register may be read along."""

    words: int = 125
    bits: int = 2000
    holes: bool = False

    @classmethod
    def of(cls, protocol: Protocol) -> "RequestLimits":
        """What reads of a device must keep to."""
        return cls(protocol.read_words, protocol.read_bits, protocol.read_holes)

    def most(self, space: Space) -> int:
        """The most addresses of one read; the status byte is alone."""
        return 1 if space is Space.STATUS else self.bits if space.is_bits else self.words


class Terms(NamedTuple):
    """What a plan must keep to and what it pays: the device's limits, where requests may run, the line's cost."""

    limits: RequestLimits
    ground: AddressRanges
    cost: Cost


class SplitReason(StrEnum):
    """Why a request is not one with the request before."""

    FIRST = "first"
    SPACE = "other function"
    LIMIT = "limit"
    HOLE = "hole"
    UNREADABLE = "unreadable"
    REFUSED = "refused"
    ALIGNMENT = "alignment"
    CHEAPER = "cheaper apart"
    AGAIN = "once more"


class Split(NamedTuple):
    """The reason and its numbers, in words."""

    reason: SplitReason
    detail: str = ""


class Planned(NamedTuple):
    """One request of a plan: how many of its addresses are wanted, and what it takes."""

    block: Block
    wanted: int
    bytes: int
    ms: float
    split: Split

    @property
    def carried(self) -> int:
        """Addresses that the answer carries."""
        return self.block.quantity


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


class Uncoverable(ValueError):  # noqa: N818 (a fact about an item; callers ask the ground first)
    """An item that no request may read."""


def blocks(items: Iterable[RegisterSpan], terms: Terms) -> tuple[Block, ...]:
    """The requests of least total cost that read all items; Uncoverable for one that cannot be read."""
    wide = {item: _widened(item, terms.ground) for item in items}
    requests = cover(wide.values(), _lanes(wide.values(), terms))
    return tuple(_filled(requests, wide))


def plan(items: Iterable[RegisterSpan], terms: Terms) -> Plan:
    """The same with costs and reasons, for people."""
    return told(blocks(items, terms), terms)


def told(made: Sequence[Block], terms: Terms, *, again: int = 0) -> Plan:
    """Requests in the order of sending, each with its cost and why it is not one with the one before it by address.

    The last `again` of them are read once more.
    """
    first_time = sorted(made[: len(made) - again], key=lambda one: (one.space, one.address))
    reasons = {block: split(before, block, terms) for before, block in pairwise((None, *first_time)) if block}
    requests = []
    for number, block in enumerate(made):
        repeated = number >= len(made) - again
        taken = terms.cost.frame_bytes(block.space, block.quantity)
        ms = milliseconds(terms.cost.tariff(block.space).of(block.quantity))
        reason = Split(SplitReason.AGAIN, "others depend on it, and it on them") if repeated else reasons[block]
        requests.append(Planned(block, _wanted(block.items), taken, ms, reason))
    return Plan(tuple(requests))


GAPS = {"hole": "no registers", "refused": "refused by this unit", "unreadable": "not readable"}
"""What may lie between two requests, in words."""


def split(before: Block | None, block: Block, terms: Terms) -> Split:
    """Why two neighbours of a plan are two requests."""
    if before is None:
        return Split(SplitReason.FIRST)
    if before.space != block.space:
        return Split(SplitReason.SPACE, f"function {before.function:02d} before")
    first, last = _hull(before), _hull(block)
    gap = block.address - before.end
    barred = terms.ground.between(first, last)
    if barred in GAPS:
        where = f"{before.end}..{block.address - 1}" if gap > 0 else f"at {block.address}"
        return Split(SplitReason(barred), f"{GAPS[barred]} {where}")
    together, most = block.end - before.address, terms.limits.most(block.space)
    if together > most:
        return Split(SplitReason.LIMIT, f"{together} together, limit {most}")
    if barred:
        return Split(SplitReason.ALIGNMENT, f"requests from {block.address} on must be aligned")
    tariff = terms.cost.tariff(block.space)
    saved = tariff.of(together) - tariff.of(before.quantity) - tariff.of(block.quantity)
    return Split(SplitReason.CHEAPER, f"{gap} between, saves {milliseconds(saved):.1f} ms")


def _hull(block: Block) -> RegisterSpan:
    return RegisterSpan(block.space, block.address, block.quantity)


def _widened(item: RegisterSpan, ground: AddressRanges) -> RegisterSpan:
    if ground.stretch(item) is None:
        message = f"{item.space} {item.address}..{item.end - 1} cannot be read"
        raise Uncoverable(message)
    return ground.widened(item)


def _lanes(items: Iterable[RegisterSpan], terms: Terms) -> dict[RegisterSpan, Lane]:
    @cache
    def lane(space: Space, first: int, align: int) -> Lane:
        most = terms.limits.most(space)
        return Lane(space, first, tariffs(space), most - most % align)

    @cache
    def tariffs(space: Space) -> Tariff:
        return terms.cost.tariff(space)

    found = {}
    for item in items:
        stretch = terms.ground.stretch(item)
        found[item] = lane(item.space, stretch.first, stretch.align) if stretch else lane(item.space, -1, 1)
    return found


def _filled(requests: Sequence[RegisterSpan], wide: dict[RegisterSpan, RegisterSpan]) -> Iterable[Block]:
    spaces = {request.space for request in requests}
    holders = {space: _Holders([one for one in requests if one.space == space]) for space in spaces}
    held: dict[RegisterSpan, list[RegisterSpan]] = {request: [] for request in requests}
    for item, asked in wide.items():
        held[holders[item.space].of(asked)].append(item)
    for request, items in held.items():
        yield Block(request.space.read_function, request.address, request.words, tuple(sorted(items)))


class _Holders:
    """Sorted requests of one space, to find the one that reads an item."""

    def __init__(self, requests: list[RegisterSpan]) -> None:
        self._requests = requests
        self._starts = [one.address for one in requests]
        self._longest = max(one.words for one in requests)

    def of(self, item: RegisterSpan) -> RegisterSpan:
        place = bisect_right(self._starts, item.address)
        while place and item.address - self._starts[place - 1] < self._longest:
            place -= 1
            if item.end <= self._requests[place].end:
                return self._requests[place]
        raise Uncoverable(item)  # not reached: `cover` holds each item whole


def _wanted(items: Iterable[RegisterSpan]) -> int:
    return len({address for item in items for address in range(item.address, item.end)})
