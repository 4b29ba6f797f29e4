"""What the names in a map mean on one model, seen from one register."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeVar, cast

from regscribe.lower.names import unknown
from regscribe.lower.node import Value
from regscribe.lower.rules import OTHER_MODELS, UNKNOWN_REGISTER
from regscribe.lower.tree import TreeNode
from regscribe.lower.variants import Models, present
from regscribe.model import Enum, Related
from regscribe.model.identifiers import opened

Made = TypeVar("Made")


@dataclass(frozen=True, slots=True)
class Scope:
    """One model's registers by path, and the tables of the map.

    `homes` are the models that have a register of a path. `viewer` is the register that refers: a name means a sibling
    in the same element of an array before a register elsewhere. `lenient`: what is looked up belongs to no register
    yet, so a name is good if any model and any element has it. `folded`: the viewer stands for that register of all
    elements, so a sibling in the same element is found under a path with empty brackets, `channels[].decimals`.
    """

    map: Value
    model: str
    models: Models
    entries: dict[str, TreeNode]
    homes: dict[str, Models]
    viewer: TreeNode | None = None
    lenient: bool = False
    folded: bool = False
    enums: dict[str, Enum] = field(default_factory=dict)
    known: dict[object, object] = field(default_factory=dict)

    @property
    def prefixes(self) -> tuple[str, ...]:
        """The elements around the register that refers, from the inside out."""
        return self.viewer.place.prefixes if self.viewer else ()

    def at(self, entry: TreeNode) -> "Scope":
        """The same scope, seen from a register."""
        return replace(self, viewer=entry)

    def has(self, node: Value) -> bool:
        """Whether a command, effect, member or field is on this model; RS0314 for names of no model."""
        return self.model in present(node, self.models, self.models)

    def once(self, key: object, make: Callable[[], Made]) -> Made:
        """What `make` gives for `key`; worked out once for all registers that find the same ones by name."""
        seen_from = (key, self.prefixes, self.lenient, self.folded)
        if seen_from not in self.known:
            self.known[seen_from] = make()
        return cast("Made", self.known[seen_from])

    def find(self, name: str) -> TreeNode | None:
        """The register of this name on this model, None if there is none."""
        for prefix in self.prefixes:
            if found := self.entries.get(f"{prefix}{name}"):
                return replace(found, path=f"{opened(prefix)}{name}") if self.folded else found
        return self.entries.get(name)

    def named(self, node: Value, table: str, *, rule: str, what: str) -> Value | None:
        """The entry of a table of the map that `node` names; reports `rule` and returns None if there is none."""
        name = node.text()
        found = self.map.child(table)
        entry = found.child(name) if found else None
        if entry is None:
            unknown(node, rule, what, name, [key for key, _ in found.items()] if found else [])
        return entry

    def register(self, node: Value, name: str | None = None, *, at_key: bool = False) -> TreeNode | None:
        """The register that `node` names; RS0301 if no model has it, RS0302 if only other models have."""
        wanted = node.text() if name is None else name
        entry = self.find(wanted)
        if entry is None:
            self.missing(node, wanted, at_key=at_key)
        return entry

    def missing(self, node: Value, name: str, *, at_key: bool = False) -> None:
        """Report that this model has no register of this name."""
        homes = next((self.homes[f"{at}{name}"] for at in (*self.prefixes, "") if f"{at}{name}" in self.homes), ())
        if self.lenient and (homes or any(path.endswith(f".{name}") for path in self.homes)):
            return
        if homes:
            self._elsewhere(node, name, homes, at_key=at_key)
        else:
            unknown(node, UNKNOWN_REGISTER, "register", name, self.homes, at_key=at_key)

    def _elsewhere(self, node: Value, name: str, homes: Models, *, at_key: bool) -> None:
        viewer = self.viewer
        needed = f"where `{viewer.path}` needs it" if viewer else "where it is needed"
        message = f"`{name}` is not on {self.model}, {needed}, only on {', '.join(homes)}"
        remedy = f"keep what refers to it to those models with `models`, or give it a variant for {self.model}"
        related = (Related(f"needed by `{viewer.path}`", viewer.span),) if viewer else ()
        node.report(OTHER_MODELS, message, remedy=remedy, at_key=at_key, related=related)


def path_of(entry: TreeNode | None, name: str) -> str:
    """The path of a register, or the name that was not found as a placeholder."""
    return entry.path if entry else name
