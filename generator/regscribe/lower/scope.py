"""What the names in a map mean on one model, seen from one register."""

from dataclasses import dataclass, field, replace

from regscribe.lower.names import unknown
from regscribe.lower.node import Node
from regscribe.lower.presence import Models
from regscribe.lower.tree import Entry
from regscribe.model import Enum


@dataclass(frozen=True, slots=True)
class Scope:
    """One model's registers by path, and the tables of the map.

    `homes` are the models that have a register of a path; `prefixes` the elements around the register that refers,
    from the inside out: a name means a sibling in the same element before a register elsewhere.
    """

    map: Node
    model: str
    models: Models
    entries: dict[str, Entry]
    homes: dict[str, Models]
    prefixes: tuple[str, ...] = ()
    enums: dict[tuple[str, str], Enum] = field(default_factory=dict)

    def at(self, entry: Entry) -> "Scope":
        """The same scope, seen from a register."""
        return replace(self, prefixes=entry.place.prefixes) if entry.place.prefixes != self.prefixes else self

    def find(self, name: str) -> Entry | None:
        """The register of this name on this model, None if there is none."""
        for prefix in self.prefixes:
            if f"{prefix}{name}" in self.entries:
                return self.entries[f"{prefix}{name}"]
        return self.entries.get(name)

    def named(self, node: Node, table: str, *, rule: str, what: str) -> Node | None:
        """The entry of a table of the map that `node` names; reports `rule` and returns None if there is none."""
        name = node.text()
        found = self.map.child(table)
        entry = found.child(name) if found else None
        if entry is None:
            unknown(node, rule, what, name, [key for key, _ in found.items()] if found else [])
        return entry

    def register(self, node: Node, name: str | None = None, *, at_key: bool = False) -> Entry | None:
        """The register that `node` names; RS0301 if no model has it, RS0302 if only other models have."""
        wanted = node.text() if name is None else name
        entry = self.find(wanted)
        if entry is None:
            self.missing(node, wanted, at_key=at_key)
        return entry

    def missing(self, node: Node, name: str, *, at_key: bool = False) -> None:
        """Report that this model has no register of this name."""
        homes = next((self.homes[f"{at}{name}"] for at in (*self.prefixes, "") if f"{at}{name}" in self.homes), ())
        if homes:
            message = f"`{name}` is not on {self.model}, where it is needed, only on {', '.join(homes)}"
            remedy = "keep the referring register to those models with `models`, or give it a variant"
            node.report("RS0302", message, remedy=remedy, at_key=at_key)
        else:
            unknown(node, "RS0301", "register", name, self.homes, at_key=at_key)


def path_of(entry: Entry | None, name: str) -> str:
    """The path of a register, or the name that was not found as a placeholder."""
    return entry.path if entry else name
