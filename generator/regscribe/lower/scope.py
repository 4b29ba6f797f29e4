"""What the names in a map mean on one model, seen from one register."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeVar, cast

from regscribe.lower.node import Value
from regscribe.lower.rules import OTHER_MODELS, UNKNOWN_COMMAND, UNKNOWN_REGISTER
from regscribe.lower.texts import unknown
from regscribe.lower.tree import TreeNode, span_of
from regscribe.lower.variants import Models, present
from regscribe.model import Enum, Related
from regscribe.model.identifiers import opened

Made = TypeVar("Made")


@dataclass(frozen=True, slots=True)
class Scope:
    """One model's registers by path, and the tables of the map.

    `owners` are the models that have a register of a path. `viewer` is the register that refers: a name means a sibling
    in the same element of an array before a register elsewhere. `lenient`: what is looked up belongs to no register
    yet, so a name is good if any model and any element has it. `folded`: the viewer stands for that register of all
    elements, so a sibling in the same element is found under a path with empty brackets, `channels[].decimals`.
    `conditions` are the names of those around.
    """

    map: Value
    model: str
    models: Models
    entries: dict[str, TreeNode]
    owners: dict[str, Models]
    viewer: TreeNode | None = None
    lenient: bool = False
    folded: bool = False
    conditions: tuple[str, ...] = ()
    enums: dict[str, Enum] = field(default_factory=dict)
    cache: dict[object, object] = field(default_factory=dict)

    @property
    def prefixes(self) -> tuple[str, ...]:
        """The elements around the register that refers, from the inside out."""
        return self.viewer.place.prefixes if self.viewer else ()

    def at(self, entry: TreeNode) -> "Scope":
        """The same scope, seen from a register."""
        return replace(self, viewer=entry)

    def inside(self, condition: str) -> "Scope":
        """The same scope, in a named condition."""
        return replace(self, conditions=(*self.conditions, condition))

    def has(self, node: Value) -> bool:
        """Whether a command, effect, member or field is on this model; RS0314 for names of no model."""
        return self.model in present(node, self.models, self.models)

    def once(self, key: object, make: Callable[[], Made]) -> Made:
        """The result of `make`, computed once per `key` for all registers whose names mean the same registers."""
        seen_from = (key, self.prefixes, self.lenient, self.folded)
        if seen_from not in self.cache:
            self.cache[seen_from] = make()
        return cast("Made", self.cache[seen_from])

    def find(self, name: str) -> TreeNode | None:
        """The register of this name on this model, None if there is none."""
        for prefix in self.prefixes:
            if found := self.entries.get(f"{prefix}{name}"):
                return replace(found, path=f"{opened(prefix)}{name}") if self.folded else found
        return self.entries.get(name)

    def named(self, node: Value, table: str, *, rule: str, what: str) -> Value | None:
        """The entry of a table of the map that `node` names; reports `rule` and returns None if there is none."""
        entries = self.map.mapping_of(table)
        entry = entries.child(node.text())
        if entry is None:
            unknown(node, rule, what, node.text(), [key for key, _ in entries.items()])
        return entry

    def command(self, node: Value | None) -> str:
        """The id of the command that `node` names, empty where it is None; RS0313 if there is none."""
        if node is None:
            return ""
        self.named(node, "commands", rule=UNKNOWN_COMMAND, what="command")
        return node.text()

    def register(self, node: Value, name: str | None = None, *, at_key: bool = False) -> TreeNode | None:
        """The register that `node` names; RS0301 if no model has it, RS0302 if only other models have."""
        wanted = node.text() if name is None else name
        entry = self.find(wanted)
        if entry is None:
            self.missing(node, wanted, at_key=at_key)
        return entry

    def path(self, node: Value | None) -> str:
        """The path of the register that `node` names, or that name as a placeholder; empty where it is None."""
        if node is None:
            return ""
        entry = self.register(node)
        return entry.path if entry else node.text()

    def missing(self, node: Value, name: str, *, at_key: bool = False) -> None:
        """Report that this model has no register of this name."""
        owners = next((self.owners[f"{at}{name}"] for at in (*self.prefixes, "") if f"{at}{name}" in self.owners), ())
        if self.lenient and (owners or any(path.endswith(f".{name}") for path in self.owners)):
            return
        if not owners and self.map.mapping_of("givens").child(name):
            message, remedy = f"there is no register `{name}`, but a given", f"write `{{given: {name}}}`"
            remedy += f", or in a condition the key `given.{name}`"
            node.report(UNKNOWN_REGISTER, message, remedy=remedy, at_key=at_key)
            return
        if not owners:
            unknown(node, UNKNOWN_REGISTER, "register", name, self.owners, at_key=at_key)
            return
        viewer = self.viewer
        needed = f"where `{viewer.path}` needs it" if viewer else "where it is needed"
        message = f"`{name}` is not on {self.model}, {needed}, only on {', '.join(owners)}"
        remedy = f"keep what refers to it to those models with `models`, or give it a variant for {self.model}"
        related = (Related(f"needed by `{viewer.path}`", span_of(viewer.node)),) if viewer else ()
        node.report(OTHER_MODELS, message, remedy=remedy, at_key=at_key, related=related)
