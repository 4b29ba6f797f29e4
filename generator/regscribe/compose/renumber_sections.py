"""Chapters under another number: the sections of a base as the manual of the extension numbers them."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from regscribe.compose.tree import key_place, listing, members, put, scalar
from regscribe.model import chapters_of, renumbered
from regscribe.source import SourceNode

_ELSEWHERE = frozenset({"when", "text", "with", "writes", "conditions"})
_SECTIONS = {"source", "where"}


@dataclass(frozen=True, slots=True)
class Renumbering:
    """Old chapters to new ones; `used` collects the old ones that occur."""

    chapters: Mapping[str, str]
    used: set[str] = field(default_factory=set)

    def of(self, node: SourceNode) -> SourceNode:
        """The value with all its sections renumbered."""
        if node.elements is not None:
            return listing(map(self.of, node.elements), node.place)
        for key, member in members(node).items():
            if key in _ELSEWHERE:
                continue
            if key in _SECTIONS and member.members is None and member.elements is None:
                section = str(member.value)
                self.used.update(chapter for chapter in chapters_of(section) if chapter in self.chapters)
                new = scalar(renumbered(section, self.chapters), member.place)
            else:
                new = self.of(member)
            node = put(node, key, new, key_place(node, key))
        return node
