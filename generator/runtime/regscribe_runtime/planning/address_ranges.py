"""Where a read may run: the stretches of addresses that one request can cover without being refused.

What is no register is a hole, crossed only where the device lets holes be read or the map calls it unused. What can
only be written, what the read function may not address, and what this unit turned out not to have is never read along.
A view whose requests must be aligned has a stretch of its own.
"""

from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from typing import NamedTuple

from regscribe_runtime.values.views import Placed, View
from regscribe_runtime.values.wire_types import Space

ADDRESSES = 1 << 16
Range = tuple[int, int]
"""First address, and the first behind."""


class RegisterSpan(NamedTuple):
    """Addresses that are wanted together: one view of one register."""

    space: Space
    address: int
    words: int

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

    __slots__ = ("_aligned", "_apart", "_known", "_refused", "_starts", "_stretches", "_unreadable", "holes")

    def __init__(
        self,
        readable: Mapping[Space, list[Range]],
        *,
        unreadable: Mapping[Space, list[Range]] | None = None,
        aligned: Mapping[Space, list[AddressStretch]] | None = None,
        refused: Mapping[Space, list[Range]] | None = None,
        apart: Mapping[Space, list[Range]] | None = None,
        holes: bool = False,
    ) -> None:
        self.holes, self._aligned = holes, aligned or {}
        self._known, self._refused, self._apart = _merged(readable), _merged(refused), _merged(apart)
        self._unreadable = {
            space: without(found, self._known.get(space, ())) for space, found in _merged(unreadable).items()
        }
        self._stretches = {
            space: tuple(self._parted(space, self._cut(space, self._aligned.get(space, []))))
            for space in {*self._known, *self._unreadable, *self._refused}
        }
        self._starts = {space: [one.first for one in found] for space, found in self._stretches.items()}

    def refusing(self, items: Iterable[RegisterSpan], *, apart: Iterable[RegisterSpan] = ()) -> "AddressRanges":
        """The same ground without addresses that a unit refused; those in `apart` may be read, but not read along."""
        return AddressRanges(
            self._known,
            unreadable=self._unreadable,
            aligned=self._aligned,
            refused=_by_space(items),
            apart=_by_space(apart),
            holes=self.holes,
        )

    def _parted(self, space: Space, stretches: Iterable[AddressStretch]) -> Iterator[AddressStretch]:
        edges = sorted(edge for found in self._apart.get(space, ()) for edge in found)
        for stretch in stretches:
            inside = [edge for edge in edges if stretch.first < edge < stretch.end]
            for first, end in pairwise([stretch.first, *inside, stretch.end]):
                yield AddressStretch(first, end, stretch.align)

    def _cut(self, space: Space, aligned: list[AddressStretch]) -> Iterator[AddressStretch]:
        allowed = [(0, ADDRESSES)] if self.holes else self._known.get(space, [])
        barred = merged([*self._unreadable.get(space, ()), *self._refused.get(space, ())])
        for first, end in without(allowed, barred):
            place = first
            for region in aligned:
                low, high = max(place, region.first), min(end, region.end)
                if low < high:
                    if place < low:
                        yield AddressStretch(place, low)
                    yield AddressStretch(low, high, region.align)
                    place = high
            if place < end:
                yield AddressStretch(place, end)

    def stretch(self, item: RegisterSpan) -> AddressStretch | None:
        """The stretch that holds an item and what must be read along for alignment; None if it cannot be read."""
        place = bisect_right(self._starts.get(item.space, []), item.address) - 1
        if place < 0:
            return None
        found = self._stretches[item.space][place]
        wide = item if found.align == 1 else _aligned(item, found.align)
        return found if found.first <= wide.address and wide.end <= found.end else None

    def widened(self, item: RegisterSpan) -> RegisterSpan:
        """The addresses that must be asked for to read an item: whole steps of the alignment there."""
        found = self.stretch(item)
        return item if found is None or found.align == 1 else _aligned(item, found.align)

    def between(self, before: RegisterSpan, after: RegisterSpan) -> str:
        """Why no request reads from `before` to `after`: unreadable, refused, hole or alignment; "" if one may."""
        if self.stretch(before) == self.stretch(after):
            return ""
        space, gap = before.space, (before.end, after.address)
        if _touches(self._refused.get(space, ()), gap) or _touches(self._apart.get(space, ()), gap):
            return "refused"
        if _touches(self._unreadable.get(space, ()), gap):
            return "unreadable"
        if not self.holes and without([gap], self._known.get(space, ())):
            return "hole"
        return "alignment"


def _merged(found: Mapping[Space, list[Range]] | None) -> dict[Space, list[Range]]:
    return {space: merged(ranges) for space, ranges in (found or {}).items()}


def _by_space(items: Iterable[RegisterSpan]) -> dict[Space, list[Range]]:
    found: dict[Space, list[Range]] = {}
    for item in items:
        found.setdefault(item.space, []).append((item.address, item.end))
    return found


def _aligned(item: RegisterSpan, align: int) -> RegisterSpan:
    first = item.address // align * align
    return RegisterSpan(item.space, first, -(-(item.end - first) // align) * align)


def ground_of(
    registers: Iterable[Placed],
    *,
    unused: Iterable[tuple[Space, int, int]] = (),
    holes: bool = False,
) -> AddressRanges:
    """The ground of a device with these registers; `unused` are spaces, first and last addresses that read as 0."""
    readable: dict[Space, list[Range]] = {}
    unreadable: dict[Space, list[Range]] = {}
    aligned: dict[tuple[Space, str], AddressStretch] = {}
    for register in registers:
        for view, address in places(register):
            may = register.access.readable and view.readable
            (readable if may else unreadable).setdefault(view.space, []).append((address, address + view.words))
            if view.align > 1:
                key = view.space, view.name
                known = aligned.get(key, AddressStretch(address, address, view.align))
                first, end = min(known.first, address), max(known.end, address + view.words)
                aligned[key] = AddressStretch(first, end, view.align)
    for space, first, last in unused:
        readable.setdefault(space, []).append((first, last + 1))
    regions: dict[Space, list[AddressStretch]] = {}
    for (space, _), stretch in sorted(aligned.items(), key=lambda one: one[1]):
        regions.setdefault(space, []).append(stretch)
    return AddressRanges(readable, unreadable=unreadable, aligned=regions, holes=holes)


def places(register: Placed) -> Iterator[tuple[View, int]]:
    """Every place where a register is transmitted: its views, then the aliases of the base view."""
    for view in register.views:
        yield view, view.address(register.at)
    base = register.views[0]
    for alias in register.aliases:
        yield base, alias


def merged(ranges: Iterable[Range]) -> list[Range]:
    """The same addresses in few ranges, in order."""
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
