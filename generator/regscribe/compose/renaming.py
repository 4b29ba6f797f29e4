"""What another model range and another manual call the models and chapters of a base map."""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from regscribe.compose.tree import branches, cut, elements, listing, mapping, members, put, text
from regscribe.source import SourceNode

_SECTIONS = {"source", "where"}
_CHAPTER = re.compile(r"(^|[,;] ?| and )((?:[Tt]able|[Ff]igure|[Ss]ection|[Cc]hapter) )?([0-9]+)")
"""The first number of a section: behind its line's start, a separator or a word such as `table`."""


@dataclass(frozen=True, slots=True)
class Renaming:
    """Renames models: `names` are the new names of each old one (none: it is dropped), `every` all new names.

    What only models have that are dropped is removed with them.
    """

    names: Mapping[str, tuple[str, ...]]
    every: tuple[str, ...]

    def of(self, node: SourceNode) -> SourceNode | None:
        """The value with its models renamed; None where no model is left that has it."""
        if node.elements is not None:
            kept = list(filter(None, map(self.of, node.elements)))
            return None if node.elements and not kept else listing(kept, node.place)
        if node.members is None:
            return node
        present = self._present(node)
        if present is None:
            return None
        inside = self.inside(present)
        lost = present.child("registers") is not None and inside.child("registers") is None
        return None if lost or (node.members and not inside.members) else inside

    def inside(self, node: SourceNode) -> SourceNode:
        """The mapping with the models renamed in all that it holds, but for its own lists of models."""
        for key, member in branches(node):
            if key not in {"models", "except"}:
                new = self.of(member)
                node = cut(node, key) if new is None else put(node, key, new)
        return node

    def _present(self, node: SourceNode) -> SourceNode | None:
        """The mapping with the models that have it renamed; None, or what is left of it, where there are none."""
        only, but, one = self._renamed(node, "models"), self._renamed(node, "except"), node.child("model")
        if only is not None:
            if not only.elements:
                invalid = node.child("invalid")  # what is left of a code that no model has
                return None if invalid is None else mapping({"invalid": invalid}, node.place, node.keys)
            node = put(node, "models", only)
        if but is not None:
            if set(map(text, elements(but))) >= set(self.every):
                return None
            node = put(node, "except", but) if but.elements else cut(node, "except")
        if one is not None and text(one) in self.names:
            names = self.names[text(one)]
            return put(node, "model", SourceNode(names[0], one.place)) if names else None
        return node

    def _renamed(self, node: SourceNode, key: str) -> SourceNode | None:
        """A list of models under a key with their new names; None where there is no such list."""
        old = elements(node.child(key))
        if not old or any(text(each) not in self.names for each in old):
            return None
        names = dict.fromkeys(name for each in old for name in self.names[text(each)])
        place = (node.child(key) or node).place
        return listing((SourceNode(name, place) for name in names), place)


def renumbered(node: SourceNode, chapters: Mapping[str, str], used: set[str]) -> SourceNode:
    """The value with all its sections as the other manual counts them (`4.2, 4.3` by {4: 5}: `5.2, 5.3`).

    `used` collects the chapters that occur.
    """

    def renumber(found: re.Match[str]) -> str:
        opening, word, chapter = found[1], found[2] or "", found[3]
        used.update({chapter} & chapters.keys())
        return f"{opening}{word}{chapters.get(chapter, chapter)}"

    if node.elements is not None:
        return listing((renumbered(each, chapters, used) for each in node.elements), node.place)
    for key in _SECTIONS & members(node).keys():
        section = members(node)[key]
        if section.members is None and section.elements is None:
            node = put(node, key, SourceNode(_CHAPTER.sub(renumber, str(section.value)), section.place))
    for key, member in branches(node):
        node = put(node, key, renumbered(member, chapters, used))
    return node
