"""Entities of ESPHome before they have names: where each stands, and what is said of it."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from regscribe.export.device import Point
from regscribe.model import Protocol, Space

Keys = dict[str, object]

MOST_WORDS, MOST_BITS = 125, 250
"""The component itself keeps to no limit, and counts bytes and bits of an answer in one byte."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Item:
    """An entity: the list that it stands in, of which register, what to call it, its place and its keys.

    `part` is the id of the flag or part that it is (empty: of the whole register).
    """

    platform: str
    point: Point
    label: str
    address: int
    count: int = 1
    part: str = ""
    keys: Keys = field(default_factory=dict)

    @property
    def space(self) -> Space:
        """The space that it is read from."""
        return self.point.wire.space

    @property
    def path(self) -> str:
        """What tells it from all others."""
        return f"{self.point.register.path}.{self.part}" if self.part else self.point.register.path

    @property
    def id(self) -> str:
        """The path as an identifier."""
        return f"{self.point.id}_{self.part}" if self.part else self.point.id


def forced(items: Sequence[Item], protocol: Protocol) -> frozenset[tuple[Space, int]]:
    """Return where `force_new_range` must stand so that no request is longer than the device allows.

    The component joins neighbours to one request without an end. An item that is forced is a request of its own, and
    so makes a gap; all items at one address are forced together, as answers find them by their first address.
    """
    found: set[tuple[Space, int]] = set()
    space, end, length = None, -1, 0
    for one in sorted(items, key=lambda item: (item.space, item.address, -item.count)):
        if one.space is not space:
            space, end, length = one.space, -1, 0
        if one.address < end:
            continue  # it reads what another one has, or begins in the middle of it
        length = length + one.count if one.address == end else one.count
        end = one.address + one.count
        if length > _most(protocol, one.space):
            found.add((one.space, one.address))
            length = 0  # what follows begins a request
    return frozenset(found)


def _most(protocol: Protocol, space: Space) -> int:
    return min(protocol.most_read(space), MOST_BITS if space.is_bits else MOST_WORDS)


def doubled(items: Sequence[Item]) -> list[Item]:
    """Return the items that begin where another one of another length does: the component reads one of them short."""
    first: dict[tuple[Space, int], int] = {}
    return [one for one in items if first.setdefault((one.space, one.address), one.count) != one.count]
