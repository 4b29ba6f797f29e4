"""Changes to the text of a map that leave all else as it is: keys of a register, new registers, new groups."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from regscribe.source import Document, SourceNode, SourcePlace

QUOTED = re.compile(r'"(?:[^"\\]|\\.)*"|\'[^\']*\'')
REMARK = re.compile(r"(^|\s)#")


class EditError(Exception):
    """A change that cannot be made in the text for sure; the message says why."""


@dataclass(slots=True)
class Edits:
    """Collects changes of one text and makes them at once."""

    document: Document
    starts: list[int] = field(default_factory=list)
    changes: list[tuple[int, int, str]] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Index the lines of the text."""
        self.starts = [0]
        for line in self.text.split("\n"):
            self.starts.append(self.starts[-1] + len(line) + 1)

    @property
    def text(self) -> str:
        """The text that is changed."""
        return self.document.text

    def at(self, line: int, column: int) -> int:
        """The offset of a place."""
        return min(self.starts[line] + column, len(self.text))

    def start(self, place: SourcePlace) -> int:
        """The offset where something begins."""
        return self.at(place.line, place.column)

    def end(self, place: SourcePlace) -> int:
        """The offset behind something, without the blanks that follow a block."""
        text = self.text[self.start(place) : self.at(place.end_line, place.end_column)]
        return self.start(place) + len(text.rstrip())

    def slice(self, place: SourcePlace) -> str:
        """The text at a place."""
        return self.text[self.start(place) : self.end(place)]

    def line_end(self, offset: int) -> int:
        """The end of the line of an offset, before its line feed."""
        found = self.text.find("\n", offset)
        return len(self.text) if found < 0 else found

    def change(self, start: int, end: int, new: str) -> None:
        """Replace a stretch of the text. Raises EditError where a comment stands in it or it was changed already."""
        if REMARK.search(QUOTED.sub("", self.text[start:end])):
            message = "a comment stands in what would be replaced"
            raise EditError(message)
        if any(start < last and first < end for first, last, _ in self.changes):
            message = "two changes meet in one place"
            raise EditError(message)
        self.changes.append((start, end, new))

    def done(self) -> str:
        """The text with all changes; those at one place in the order in which they were asked for."""
        text = self.text
        order = sorted(range(len(self.changes)), key=lambda index: (self.changes[index][0], index), reverse=True)
        for start, end, new in (self.changes[index] for index in order):
            text = text[:start] + new + text[end:]
        return text


def is_flow(edits: Edits, node: SourceNode) -> bool:
    """Whether a mapping or a list stands in brackets."""
    return edits.text[edits.start(node.place) : edits.start(node.place) + 1] in {"{", "["}


def set_keys(edits: Edits, node: SourceNode, keys: Mapping[str, str]) -> None:
    """Give keys of a mapping other values, or add them behind the last one. Raises EditError."""
    members, places = _known(node)
    added = []
    for key, text in keys.items():
        if key in members:
            edits.change(edits.start(members[key].place), edits.end(members[key].place), text)
        else:
            added.append(f"{key}: {text}")
    if not added:
        return
    last = edits.end(members[max(members, key=lambda key: edits.start(members[key].place))].place)
    if is_flow(edits, node):
        edits.change(last, last, "".join(f", {text}" for text in added))
        return
    margin = " " * next(iter(places.values())).column
    end = edits.line_end(last)
    edits.change(end, end, "".join(f"\n{margin}{text}" for text in added))


def drop_key(edits: Edits, node: SourceNode, key: str) -> None:
    """Take a key out of a mapping. Raises EditError."""
    members, places = _known(node)
    order = sorted(members, key=lambda name: edits.start(members[name].place))
    at = order.index(key)
    if at == 0 and len(order) == 1:
        message = "it is the only key"
        raise EditError(message)
    if at == 0:
        edits.change(edits.start(places[key]), edits.start(places[order[1]]), "")
    else:
        edits.change(edits.end(members[order[at - 1]].place), edits.end(members[key].place), "")


def _known(node: SourceNode) -> tuple[dict[str, SourceNode], dict[str, SourcePlace]]:
    if not node.members or not node.keys:
        message = "it is no mapping with keys"
        raise EditError(message)
    return node.members, node.keys


def add_elements(edits: Edits, listed: SourceNode, after: SourceNode | None, items: Sequence[str]) -> None:
    """Put elements into a list, behind one of them or at its end; each is a text on one or several lines.

    Raises EditError where the list has none, or stands in brackets and an item has several lines.
    """
    elements = listed.elements or []
    if not elements:
        message = "the list is empty"
        raise EditError(message)
    anchor = after or elements[-1]
    end = edits.end(anchor.place)
    if is_flow(edits, listed):
        if any("\n" in item for item in items):
            message = "the list stands in brackets"
            raise EditError(message)
        edits.change(end, end, "".join(f", {item}" for item in items))
        return
    margin = " " * _dash(edits, anchor)
    end = edits.line_end(end)
    edits.change(end, end, "".join(f"\n{_item(item, margin)}" for item in items))


def _item(item: str, margin: str) -> str:
    """An element with its dash; comments above it stand without one."""
    lines = item.split("\n")
    comments = [line for line in lines if line.startswith("#")]
    first, *rest = lines[len(comments) :]
    texts = [*(f"{margin}{line}" for line in comments), f"{margin}- {first}", *(f"{margin}  {line}" for line in rest)]
    return "\n".join(texts)


def _dash(edits: Edits, element: SourceNode) -> int:
    """The column of the dash before an element."""
    start = edits.start(element.place)
    line = edits.starts[element.place.line]
    found = edits.text.rfind("-", line, start)
    if found < 0 or edits.text[line:found].strip("- "):
        message = "its dash stands in a line of its own"
        raise EditError(message)
    return found - line
