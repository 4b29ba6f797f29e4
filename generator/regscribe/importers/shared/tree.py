"""A document as a tree of texts with their lines, whatever its notation; built without recursion and within limits.

Numbers stay the texts that they are written as, so that none goes through a float.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Final

from regscribe.visible import safe

MOST_DEPTH = 40
"""Levels of nesting; the deepest of the configurations that are read here have nine."""
MOST_NODES = 400_000
"""Values of one document, those that an alias repeats counted as often."""
MOST_TEXT = 100_000
"""Characters of one value; the longest lambda is far below."""
NULL: Final = frozenset({"", "~", "null", "Null", "NULL"})
TRUE: Final = frozenset({"true", "yes", "on"})
FALSE: Final = frozenset({"false", "no", "off"})


class TreeError(Exception):
    """A document cannot be read: the line, what is wrong and what to do."""

    def __init__(self, line: int, message: str, help_text: str = "") -> None:
        super().__init__(message)
        self.line, self.message, self.help_text = line, message, help_text


@dataclass(frozen=True, slots=True)
class Node:
    """A value: its line, and a text, members by key, or elements. `tag` is what stands before it, such as `!secret`."""

    line: int
    text: str = ""
    quoted: bool = False
    tag: str = ""
    members: Mapping[str, "Node"] | None = None
    elements: tuple["Node", ...] | None = None
    size: int = 1

    @property
    def is_null(self) -> bool:
        """Whether it says nothing."""
        return self.is_scalar and not self.quoted and not self.tag and self.text in NULL

    @property
    def is_scalar(self) -> bool:
        """Whether it is neither a mapping nor a list."""
        return self.members is None and self.elements is None

    def get(self, key: str) -> "Node | None":
        """Return the value of a key; None where there is none, or nothing in it."""
        found = (self.members or {}).get(key)
        return None if found is None or found.is_null else found

    def word(self, key: str) -> str:
        """Return the text of a key; empty where it has none."""
        found = self.get(key)
        return found.text.strip() if found is not None and found.is_scalar else ""

    @property
    def each(self) -> tuple["Node", ...]:
        """Its elements; of a single value that value, as many programs take one for a list of one."""
        if self.elements is not None:
            return self.elements
        return () if self.is_null else (self,)

    @property
    def shown(self) -> str:
        """The value in short, for a message."""
        if self.members is not None:
            text = f"{{{', '.join(self.members)}}}"
        elif self.elements is not None:
            text = f"[{', '.join(one.text for one in self.elements)}]"
        else:
            text = f"{self.tag} {self.text}".strip()
        flat = safe(" ".join(text.split()))
        return f"`{flat if len(flat) <= 60 else f'{flat[:57]}...'}`"  # noqa: PLR2004 - a part of a line


@dataclass(slots=True)
class _Open:
    """A mapping or list that is being read."""

    line: int
    tag: str
    members: dict[str, Node] | None
    elements: list[Node]
    key: str | None = None
    size: int = 1


@dataclass(slots=True)
class Builder:
    """Makes a tree of what a reader meets, in its order."""

    open: list[_Open] = field(default_factory=list)
    root: Node | None = None
    doubled: list[tuple[int, str]] = field(default_factory=list)
    nodes: int = 0

    @property
    def awaits_key(self) -> bool:
        """Whether the next text is a key."""
        return bool(self.open) and self.open[-1].members is not None and self.open[-1].key is None

    def key(self, text: str, line: int) -> None:
        """Take a key of the mapping that is open; one that is there already is noted, and its last value counts."""
        top = self.open[-1]
        self._check(text, line)
        if text in (top.members or {}):
            self.doubled.append((line, text))
        top.key = text

    def start(self, line: int, *, mapping: bool, tag: str = "") -> None:
        """Begin a mapping or a list. Raises TreeError where they are nested too deep."""
        if len(self.open) >= MOST_DEPTH:
            raise TreeError(line, f"values are nested more than {MOST_DEPTH} deep", "no such configuration is")
        self.open.append(_Open(line, tag, {} if mapping else None, []))

    def end(self) -> Node:
        """End the innermost mapping or list."""
        top = self.open.pop()
        members = None if top.members is None else top.members
        elements = tuple(top.elements) if members is None else None
        return self.add(Node(top.line, tag=top.tag, members=members, elements=elements, size=top.size))

    def scalar(self, text: str, line: int, *, quoted: bool, tag: str = "") -> Node:
        """Add a text. Raises TreeError for one that is too long."""
        self._check(text, line)
        return self.add(Node(line, text, quoted, tag))

    def add(self, node: Node) -> Node:
        """Add a value. Raises TreeError where there are too many."""
        if node.size > MOST_NODES:
            raise TreeError(node.line, f"more than {MOST_NODES} values, aliases counted as often as they are used")
        if not self.open:
            self.root = node
            return node
        top = self.open[-1]
        top.size += node.size
        if top.size > MOST_NODES:
            raise TreeError(node.line, f"more than {MOST_NODES} values, aliases counted as often as they are used")
        if top.members is None:
            top.elements.append(node)
        else:
            self._member(top, top.members, node)
        return node

    def _member(self, top: _Open, members: dict[str, Node], node: Node) -> None:
        """Add the value of a key; `<<` adds those of other mappings that are not there."""
        key, top.key = top.key or "", None
        if key != "<<":
            members[key] = node
            return
        for one in node.each:
            for name, value in (one.members or {}).items():
                members.setdefault(name, value)

    def _check(self, text: str, line: int) -> None:
        if len(text) > MOST_TEXT:
            raise TreeError(line, f"a value of {len(text)} characters: at most {MOST_TEXT} are read")


def walk(node: Node) -> Iterator[Node]:
    """Yield a value and all those in it."""
    waiting = [node]
    while waiting:
        one = waiting.pop()
        yield one
        waiting.extend(reversed([*(one.members or {}).values(), *(one.elements or ())]))
