"""A parsed map: plain values, and where each of them stands."""

from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

from regscribe.model import Span

Plain: TypeAlias = Any
"""dict with str keys, list, str, bool, int, Decimal (a number with fraction or exponent) or None.

`Any`, because the JSON Schema says which of them stands where, not the type checker.
"""

Path = tuple[str | int, ...]
"""Keys and list indices from the top of the file to a value."""


class SourcePlace(NamedTuple):
    """Start and end (exclusive) in the text; lines and columns count from 0.

    `file` is empty in the document's own file; in a document of several files it tells the others apart.
    """

    line: int
    column: int
    end_line: int
    end_column: int
    file: str = ""

    def span(self, file: str) -> Span:
        """Count from 1, as people do."""
        return Span(self.file or file, self.line + 1, self.column + 1, self.end_line + 1, self.end_column + 1)


START = SourcePlace(0, 0, 0, 0)
"""The start of a file: the place of mistakes of the file as a whole."""


class SourceNode(NamedTuple):
    """One value with its place, the places of its keys, its children, and its size with all aliases expanded."""

    value: Plain
    place: SourcePlace
    keys: dict[str, SourcePlace] | None = None
    members: "dict[str, SourceNode] | None" = None
    elements: "list[SourceNode] | None" = None
    size: int = 1
    height: int = 1

    def child(self, step: str | int) -> "SourceNode | None":
        """Return the value under a key or index, if there is one."""
        if self.members is not None:
            return self.members.get(str(step))
        if self.elements is not None and isinstance(step, int) and 0 <= step < len(self.elements):
            return self.elements[step]
        return None


@dataclass(frozen=True, slots=True)
class Document:
    """A map as read: `name` is the file as diagnostics show it, `content_hash` the SHA-256 of its bytes in hex.

    A document may be composed of several files: then each place below `root` knows the file that it lies in, `text` is
    that of the file `name`, and `content_hash` stands for all of them.

    `text` has line feeds as its only line ends and no byte order mark, so that a span's line is the element
    `span.line - 1` of `text` split at line feeds.
    """

    name: str
    text: str
    data: Plain
    content_hash: str
    root: SourceNode

    def span(self, path: Path) -> Span:
        """Where the value at `path` stands; where nothing does, the nearest value above it that exists."""
        return self._reach(path)[0].place.span(self.name)

    def key_span(self, path: Path) -> Span:
        """Where the key that ends `path` stands; for a list's element the element itself."""
        parent, missing = self._reach(path[:-1])
        if path and not missing and parent.keys and str(path[-1]) in parent.keys:
            return parent.keys[str(path[-1])].span(self.name)
        return self.span(path)

    def _reach(self, path: Path) -> tuple[SourceNode, int]:
        """Walk along `path`: the deepest node there is, and how many steps are missing."""
        node = self.root
        for done, step in enumerate(path):
            child = node.child(step)
            if child is None:
                return node, len(path) - done
            node = child
        return node, 0
