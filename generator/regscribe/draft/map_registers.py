"""The registers of a map's text, each with its group, its keys, and where they stand."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from regscribe.model.identifiers import snake
from regscribe.source import Document, SourceNode

HOLDING = "holding"

Place = tuple[str, str, str, str]
"""What tells a register from all others: unit id, space, address and byte."""


@dataclass(frozen=True, slots=True)
class MapRegister:
    """One register or array: its keys, the defaults of its group, and where it stands, if in a text."""

    group: str
    keys: Mapping[str, Any]
    each: Mapping[str, Any]
    unit: str = ""
    node: SourceNode | None = None
    index: int = 0

    @property
    def name(self) -> str:
        """What people call it."""
        return str(self.keys.get("name", ""))

    @property
    def id(self) -> str:
        """Its id."""
        return str(self.keys.get("id") or snake(self.name))

    @property
    def place(self) -> Place:
        """Where it is on the wire."""
        space = str(self.value("space") or HOLDING)
        return self.unit, space, str(self.keys.get("at", "")), str(self.keys.get("byte", ""))

    def value(self, key: str) -> object:
        """The value of a key, of its own or of its group; None where neither has one."""
        return self.keys.get(key, self.each.get(key))

    def __str__(self) -> str:
        """What a message calls it."""
        return f"{self.name} ({self.place[1]} {self.place[2]})"


@dataclass(frozen=True, slots=True)
class MapGroup:
    """A group with its node, the node of its list of registers, and these."""

    name: str
    id: str
    node: SourceNode
    list: SourceNode | None
    registers: tuple[MapRegister, ...]


def groups_of(document: Document) -> tuple[MapGroup, ...]:
    """The groups of a map with the registers that stand in them, in their order."""
    groups = document.root.child("groups")
    return tuple(_group(node) for node in (groups.elements if groups and groups.elements else ()) if node.members)


def _group(node: SourceNode) -> MapGroup:
    keys = node.value if isinstance(node.value, dict) else {}
    listed = node.child("registers")
    name = str(keys.get("name") or keys.get("id", ""))
    registers = tuple(_registers(listed, name, keys)) if listed is not None else ()
    return MapGroup(name, str(keys.get("id", "")), node, listed, registers)


def _registers(listed: SourceNode, group: str, keys: Mapping[str, Any]) -> Iterator[MapRegister]:
    each = keys.get("each")
    unit = str(keys.get("unit_id", ""))
    for index, node in enumerate(listed.elements or ()):
        if isinstance(node.value, dict) and ("at" in node.value or "registers" in node.value):
            yield MapRegister(group, node.value, each if isinstance(each, dict) else {}, unit, node, index)
