"""Chapters under another number: the sections of a base as the manual of the extension numbers them."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from regscribe.compose.tree import key_place, listing, members, put, scalar
from regscribe.source import Node

_CHAPTER = re.compile(r"(^|[,;] ?| and )((?:[Tt]able|[Ff]igure|[Ss]ection|[Cc]hapter) )?([0-9]+)")
_ELSEWHERE = frozenset({"when", "with", "writes", "conditions"})
_SECTIONS = {"source", "where"}


@dataclass(frozen=True, slots=True)
class Renumbering:
    """Old chapters to new ones; `used` collects the old ones that occur."""

    chapters: Mapping[str, str]
    used: set[str] = field(default_factory=set)

    def of(self, node: Node) -> Node:
        """The value with all its sections renumbered."""
        if node.elements is not None:
            return listing(map(self.of, node.elements), node.place)
        for key, member in members(node).items():
            if key in _ELSEWHERE:
                continue
            if key in _SECTIONS and member.members is None and member.elements is None:
                new = scalar(_CHAPTER.sub(self._chapter, str(member.value)), member.place)
            else:
                new = self.of(member)
            node = put(node, key, new, key_place(node, key))
        return node

    def _chapter(self, found: re.Match[str]) -> str:
        before, word, number = found[1], found[2] or "", found[3]
        if number in self.chapters:
            self.used.add(number)
        return f"{before}{word}{self.chapters.get(number, number)}"
