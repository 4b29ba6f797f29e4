"""Chapters under another number: the sections of a base as the manual of the extension numbers them."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from regscribe.compose.tree import branches, key_place, listing, members, put, scalar
from regscribe.model import chapters_of, renumbered
from regscribe.source import SourceNode

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
        for key in _SECTIONS & members(node).keys():
            node = put(node, key, self._section(members(node)[key]), key_place(node, key))
        for key, member in branches(node):
            node = put(node, key, self.of(member), key_place(node, key))
        return node

    def _section(self, node: SourceNode) -> SourceNode:
        if node.members is not None or node.elements is not None:
            return node
        section = str(node.value)
        self.used.update(chapter for chapter in chapters_of(section) if chapter in self.chapters)
        return scalar(renumbered(section, self.chapters), node.place)
