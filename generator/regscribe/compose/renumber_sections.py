"""Renumbers the sections of a base map, where the manual of the extension has its chapters under other numbers."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from regscribe.compose.tree import branches, key_place, listing, members, put, scalar
from regscribe.source import SourceNode

_SECTIONS = {"source", "where"}
_CHAPTER = re.compile(r"(^|[,;] ?| and )((?:[Tt]able|[Ff]igure|[Ss]ection|[Cc]hapter) )?([0-9]+)")
"""The first number of a section: behind its line's start, a separator or a word such as `table`."""


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
        return scalar(_CHAPTER.sub(self._new, str(node.value)), node.place)

    def _new(self, found: re.Match[str]) -> str:
        """A chapter as the other manual counts it (`4.2, 4.3` by {4: 5}: `5.2, 5.3`)."""
        opening, word, chapter = found[1], found[2] or "", found[3]
        self.used.update({chapter} & self.chapters.keys())
        return f"{opening}{word}{self.chapters.get(chapter, chapter)}"
