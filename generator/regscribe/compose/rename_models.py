"""The models of a base under their new names; what only models have that nobody names goes with them."""

from collections.abc import Mapping
from dataclasses import dataclass

from regscribe.compose.tree import cut, elements, key_place, listing, mapping, members, put, scalar, text
from regscribe.source import SourceNode

Names = Mapping[str, tuple[str, ...]]
"""The new names of each model of the base; none for a model that is dropped."""

_ELSEWHERE = frozenset({"when", "text", "with", "writes", "conditions"})
"""Below these keys stand names of registers, which may be called like anything."""


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
        inside: SourceNode | None = self._present(node)
        if inside is None:
            return None
        for key, member in members(inside).items():
            if key in _ELSEWHERE or (member.members is None and member.elements is None):
                continue
            new = member if key in {"models", "except"} else self.of(member)
            if new is None and key == "registers":
                return None
            inside = cut(inside, key) if new is None else put(inside, key, new, key_place(inside, key))
        return None if node.members and not inside.members else inside

    def _present(self, node: SourceNode) -> SourceNode | None:
        """The mapping with the models that have it renamed; None, or what is left of it, where there are none."""
        only, but, one = node.child("models"), node.child("except"), node.child("model")
        if only is not None and self._lists_models(only):
            names = self._renamed(only)
            if not names:
                return _invalid(node)
            node = put(node, "models", _names(names, only), key_place(node, "models"))
        if but is not None and self._lists_models(but):
            names = self._renamed(but)
            if set(names) >= set(self.every):
                return None
            node = put(node, "except", _names(names, but), key_place(node, "except")) if names else cut(node, "except")
        if one is not None and text(one) in self.names:
            new = self.names[text(one)]
            return put(node, "model", scalar(new[0], one.place), key_place(node, "model")) if new else None
        return node

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


def renamed(root: SourceNode, renaming: Renaming) -> SourceNode:
    """A map with its models renamed, but for the table `models` itself."""
    for key, member in members(root).items():
        if key in {"models", *_ELSEWHERE} or (member.members is None and member.elements is None):
            continue
        new = renaming.of(member)
        root = cut(root, key) if new is None else put(root, key, new, key_place(root, key))
    return root
