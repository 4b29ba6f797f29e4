"""Renames the models of a base map; what only models have that are dropped is removed with them."""

from collections.abc import Mapping
from dataclasses import dataclass

from regscribe.compose.tree import branches, cut, elements, key_place, listing, mapping, put, scalar, text
from regscribe.source import SourceNode

Names = Mapping[str, tuple[str, ...]]
"""The new names of each model of the base; none for a model that is dropped."""


@dataclass(frozen=True, slots=True)
class Renaming:
    """Old names to new ones, and all new names."""

    names: Names
    every: tuple[str, ...]

    def of(self, node: SourceNode) -> SourceNode | None:
        """The value with its models renamed; None where no model is left that has it."""
        if node.elements is not None:
            kept = [each for each in map(self.of, node.elements) if each is not None]
            return None if node.elements and not kept else listing(kept, node.place)
        return node if node.members is None else self._mapping(node)

    def _mapping(self, node: SourceNode) -> SourceNode | None:
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
                node = cut(node, key) if new is None else put(node, key, new, key_place(node, key))
        return node

    def _present(self, node: SourceNode) -> SourceNode | None:
        """The mapping with the models that have it renamed; None, or what is left of it, where there are none."""
        found: SourceNode | None = node
        for rename in (self._only, self._but, self._one):
            found = rename(found) if found is not None else None
        return found

    def _only(self, node: SourceNode) -> SourceNode | None:
        only = node.child("models")
        if only is None or not self._lists_models(only):
            return node
        names = self._renamed(only)
        return put(node, "models", _names(names, only), key_place(node, "models")) if names else _invalid(node)

    def _but(self, node: SourceNode) -> SourceNode | None:
        but = node.child("except")
        if but is None or not self._lists_models(but):
            return node
        names = self._renamed(but)
        if set(names) >= set(self.every):
            return None
        return put(node, "except", _names(names, but), key_place(node, "except")) if names else cut(node, "except")

    def _one(self, node: SourceNode) -> SourceNode | None:
        one = node.child("model")
        if one is None or text(one) not in self.names:
            return node
        new = self.names[text(one)]
        return put(node, "model", scalar(new[0], one.place), key_place(node, "model")) if new else None

    def _lists_models(self, node: SourceNode) -> bool:
        return bool(node.elements) and all(text(each) in self.names for each in elements(node))

    def _renamed(self, node: SourceNode) -> list[str]:
        return [new for each in elements(node) for new in self.names[text(each)]]


def _names(names: list[str], old: SourceNode) -> SourceNode:
    return listing((scalar(name, old.place) for name in dict.fromkeys(names)), old.place)


def _invalid(node: SourceNode) -> SourceNode | None:
    """What is left of a code that no model has: that it is invalid, if the base says so."""
    invalid = node.child("invalid")
    return None if invalid is None else mapping({"invalid": invalid}, node.keys or {}, node.place)
