"""Address ranges that read requests may cover without being refused.

A hole (an address of no register) is crossed only where the device lets holes be read or the map calls it unused.
Registers that cannot be read, that this unit refused, or that reading clears (`alone`) are never read along. A view
whose requests must be aligned has a stretch of its own.
"""

from bisect import bisect_right
from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import chain, pairwise
from typing import NamedTuple

from regscribe_runtime.values.views import Placed, View
from regscribe_runtime.values.wire_types import PAGE_BITS, WIRE, Space

Range = tuple[int, int]
"""First address, and the first behind."""


class RegisterSpan(NamedTuple):
    """The addresses of one view of one register; they are read together."""

    space: Space
    address: int
    words: int
    offsets: tuple[int, ...] = ()

    @property
    def ranges(self) -> list[Range]:
        """Its own addresses: all, or each of its words where they stand apart (at `offsets`)."""
        each = [(self.address + offset, self.address + offset + 1) for offset in self.offsets]
        return each or [(self.address, self.end)]

    @property
    def end(self) -> int:
        """The first address behind it."""
        return self.address + self.words


class AddressStretch(NamedTuple):
    """Addresses that one request may cover; its address and count must be multiples of `align`."""

    first: int
    end: int
    align: int = 1


class AddressRanges:
    """The stretches of every space of one device, and why they end."""

    __slots__ = ("_aligned", "_alone", "_apart", "_known", "_refused", "_starts", "_stretches", "_unreadable", "holes")

    def __init__(
        self,
        readable: Mapping[Space, list[Range]],
        *,
        unreadable: Mapping[Space, list[Range]] | None = None,
        aligned: Mapping[Space, list[AddressStretch]] | None = None,
        refused: Mapping[Space, list[Range]] | None = None,
        apart: Mapping[Space, list[Range]] | None = None,
        alone: Mapping[Space, list[Range]] | None = None,
        holes: bool = False,
    ) -> None:
        self.holes, self._aligned, self._alone = holes, aligned or {}, alone or {}
        self._known, self._refused, self._apart = _merged(readable), _merged(refused), _merged(apart)
        self._unreadable = {
            space: without(ranges, self._known.get(space, ())) for space, ranges in _merged(unreadable).items()
        }
        self._stretches = {
            space: tuple(self._cut(space)) for space in {*self._known, *self._unreadable, *self._refused}
        }
        self._starts = {space: [one.first for one in stretches] for space, stretches in self._stretches.items()}

    def refusing(self, items: Iterable[RegisterSpan], *, apart: Iterable[RegisterSpan] = ()) -> "AddressRanges":
        """The same ranges without items that a unit refused; those in `apart` may be read, but not read along."""
        return AddressRanges(
            self._known,
            unreadable=self._unreadable,
            aligned=self._aligned,
            refused=_by_space(items),
            apart=_by_space(apart),
            alone=self._alone,
            holes=self.holes,
        )

    def _cut(self, space: Space) -> Iterator[AddressStretch]:
        """The stretches of a space: what may be read, cut where alignment changes and where reading along ends."""
        aligned = list(_disjoint(self._aligned.get(space, [])))
        allowed = self._known.get(space, [])
        if self.holes and not space.part_bits:
            pages = sorted({0, *(space.page(first) for first, _ in allowed)})
            allowed = [(page << PAGE_BITS, page << PAGE_BITS | WIRE) for page in pages]
            allowed = [(first, last + 1) for first, last in allowed]
        barred = merged([*self._unreadable.get(space, ()), *self._refused.get(space, ())])
        cuts = [*((one.first, one.end) for one in aligned), *self._apart.get(space, ()), *self._alone.get(space, ())]
        edges = sorted(set(chain.from_iterable(cuts)))
        for start, stop in without(allowed, barred):
            inside = [edge for edge in edges if start < edge < stop]
            for first, end in pairwise([start, *inside, stop]):
                align = next((one.align for one in aligned if one.first <= first < one.end), 1)
                yield AddressStretch(first, end, align)

    def stretch(self, item: RegisterSpan) -> AddressStretch | None:
        """The stretch that holds an item and what must be read along for alignment; None if it cannot be read."""
        place = bisect_right(self._starts.get(item.space, []), item.address) - 1
        if place < 0:
            return None
        found = self._stretches[item.space][place]
        wide = item if found.align == 1 else _widened(item, found.align)
        return found if found.first <= wide.address and wide.end <= found.end else None

    def widened(self, item: RegisterSpan) -> RegisterSpan:
        """The addresses to request for an item: whole steps of the alignment there."""
        found = self.stretch(item)
        return item if found is None or found.align == 1 else _widened(item, found.align)

    def between(self, before: RegisterSpan, after: RegisterSpan) -> str:
        """Why none reads from `before` to `after`: refused, unreadable, clears, hole, alignment; "" if one may."""
        if self.stretch(before) == self.stretch(after):
            return ""
        space, gap = before.space, (before.end, after.address)
        if _touches(self._alone.get(space, ()), (before.address, after.end)):
            return "clears"
        if _touches(self._refused.get(space, ()), gap) or _touches(self._apart.get(space, ()), gap):
            return "refused"
        if _touches(self._unreadable.get(space, ()), gap):
            return "unreadable"
        if (not self.holes or space.part_bits) and without([gap], self._known.get(space, ())):
            return "hole"
        return "alignment"


def _disjoint(stretches: Iterable[AddressStretch]) -> Iterator[AddressStretch]:
    """Sorted stretches, each without the addresses of those before it."""
    taken = 0
    for one in stretches:
        if one.end > taken:
            yield AddressStretch(max(one.first, taken), one.end, one.align)
            taken = one.end


def _merged(by_space: Mapping[Space, list[Range]] | None) -> dict[Space, list[Range]]:
    return {space: merged(ranges) for space, ranges in (by_space or {}).items()}


def _by_space(items: Iterable[RegisterSpan]) -> dict[Space, list[Range]]:
    found: dict[Space, list[Range]] = defaultdict(list)
    for item in items:
        found[item.space] += item.ranges
    return found


def _widened(item: RegisterSpan, align: int) -> RegisterSpan:
    first = item.address // align * align
    return RegisterSpan(item.space, first, -(-(item.end - first) // align) * align)


def span_of(view: View, address: int) -> RegisterSpan:
    """What a view takes whose first word stands at an address."""
    return RegisterSpan(view.space, address, view.words, tuple(view.offsets) if view.is_apart else ())


def ground_of(
    registers: Iterable[Placed],
    *,
    unused: Iterable[tuple[Space, int, int]] = (),
    holes: bool = False,
    absent: Collection[str] = (),
) -> AddressRanges:
    """The address ranges of a device with these registers; `unused` (space, first, last address) read as 0.

    The registers of the paths `absent` may not exist: nothing is read there.
    """
    readable: dict[Space, list[Range]] = defaultdict(list)
    alone: dict[Space, list[Range]] = defaultdict(list)
    unreadable: dict[Space, list[Range]] = defaultdict(list)
    aligned: dict[tuple[Space, str], AddressStretch] = {}
    for register in registers:
        for view, address in places(register):
            end = address + view.words
            there = register.access.readable and view.readable and register.path not in absent
            ranges = readable if there else unreadable
            ranges[view.space] += span_of(view, address).ranges
            if register.reading.clears and view.readable:
                alone[view.space].append((address, end))
            if view.align > 1:
                known = aligned.get((view.space, view.name), AddressStretch(address, end, view.align))
                both = AddressStretch(min(known.first, address), max(known.end, end), view.align)
                aligned[view.space, view.name] = both
    for space, first, last in unused:
        readable[space].append((first, last + 1))
    regions: dict[Space, list[AddressStretch]] = defaultdict(list)
    for (space, _), stretch in sorted(aligned.items(), key=lambda one: one[1]):
        regions[space].append(stretch)
    return AddressRanges(readable, unreadable=unreadable, aligned=regions, alone=alone, holes=holes)


def places(register: Placed) -> Iterator[tuple[View, int]]:
    """Every view of a register with its address, then the base view with the aliases."""
    for view in register.views:
        yield view, view.address(register.at)
    base = register.views[0]
    for alias in register.aliases:
        yield base, alias


def merged(ranges: Iterable[Range]) -> list[Range]:
    """The same addresses in the fewest ranges, sorted."""
    found: list[Range] = []
    for first, end in sorted(ranges):
        if found and first <= found[-1][1]:
            found[-1] = (found[-1][0], max(end, found[-1][1]))
        else:
            found.append((first, end))
    return found


def without(ranges: Iterable[Range], barred: Iterable[Range]) -> list[Range]:
    """What is left of `ranges` outside `barred`; both merged."""
    found: list[Range] = []
    gone = list(barred)
    place = 0
    for first, end in ranges:
        start = first
        while place < len(gone) and gone[place][1] <= start:
            place += 1
        at = place
        while at < len(gone) and gone[at][0] < end:
            if start < gone[at][0]:
                found.append((start, gone[at][0]))
            start = max(start, gone[at][1])
            at += 1
        if start < end:
            found.append((start, end))
    return found


def _touches(ranges: Iterable[Range], gap: Range) -> bool:
    return any(first < gap[1] and gap[0] < end for first, end in ranges)
