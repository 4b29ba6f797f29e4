"""Rows that a file writes in a notation of its manual (`written_in`): their numbers as wire addresses.

The rest of the compiler sees wire addresses alone. A number tells its space where the row does not say it.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from regscribe.compose.findings import NO_NUMBER, UNKNOWN_NOTATION, ComposeFindings
from regscribe.compose.tree import at, cut, elements, listing, mapping, members, put, text
from regscribe.source import SourceNode

KEY = "written_in"
WIRE, MODICON = "wire", "modicon"
_LAST = 0xFFFF
_TABLES = ("groups", "sets", "commands", "override", "reserved", "unused")
_INNER = frozenset({"registers", "each", "set_each", "variants", "steps", "set", "write"})
"""Keys of a row below which more rows, or keys of it, stand."""
_COILS = (5, 15)
_BITS = frozenset({"coil", "discrete"})
_NOT_NUMBERED = frozenset({"status", "file", "queue"})
"""Spaces whose addresses no notation has numbers for."""


class Stretch(NamedTuple):
    """The numbers of one space in a notation: that of wire address 0, and the last that tells the space by itself."""

    space: str
    first: int
    last: int
    notation: str = MODICON


_MODICON = (
    *(Stretch("coil", 1, 9999), Stretch("discrete", 10_001, 19_999)),
    *(Stretch("input", 30_001, 39_999), Stretch("holding", 40_001, 49_999)),
    *(Stretch("discrete", 100_001, 165_536), Stretch("input", 300_001, 365_536), Stretch("holding", 400_001, 465_536)),
)


def writes_numbers(root: SourceNode) -> bool:
    """Whether the file, or a group in it, is written in a notation."""
    return any(node.child(KEY) for node in (root, *elements(root.child("groups"))))


@dataclass(slots=True)
class Numbering:
    """Turns the numbers of files into wire addresses; `used` are the stretches of `modicon` that rows stand in."""

    findings: ComposeFindings
    used: dict[str, Stretch]

    def on_the_wire(self, root: SourceNode) -> SourceNode:
        """The file with wire addresses, and without `written_in`."""
        if not writes_numbers(root):
            return root
        rows = _Rows(self, root, self.notation(root, root, ()))
        for table in _TABLES:
            node = root.child(table)
            if node is not None:
                root = put(root, table, rows.in_table(node))
        return cut(root, KEY)

    def notation(self, node: SourceNode, root: SourceNode, otherwise: tuple[Stretch, ...]) -> tuple[Stretch, ...]:
        """The stretches of the notation that `node` names; empty for the wire itself."""
        name = node.child(KEY)
        if name is None:
            return otherwise
        own = [each for each in elements(root.child("notations")) if text(each.child("name")) == text(name)]
        if own:
            return tuple(_declared(each) for each in own)
        if text(name) not in {WIRE, MODICON}:
            known = [text(each.child("name")) for each in elements(root.child("notations"))]
            message = f"there is no notation `{text(name)}`"
            self.findings.unknown(UNKNOWN_NOTATION, message, name, [MODICON, WIRE, *known])
        return _MODICON if text(name) == MODICON else ()

    def with_notations(self, root: SourceNode) -> SourceNode:
        """The composed map with the notation `Modicon` of the spaces whose rows are written in it."""
        have = elements(root.child("notations"))
        offsets = {(text(each.child("space")), text(each.child("offset"))) for each in have}
        new = [one for one in self.used.values() if (one.space, str(one.first)) not in offsets]
        if not new:
            return root
        return put(root, "notations", listing([*have, *(_declaration(one, root) for one in new)], root.place))


def _declaration(stretch: Stretch, root: SourceNode) -> SourceNode:
    keys = {"name": MODICON.capitalize(), "space": stretch.space, "offset": stretch.first}
    return mapping({key: SourceNode(value, root.place) for key, value in keys.items()}, root.place)


def _declared(node: SourceNode) -> Stretch:
    offset = int(text(node.child("offset")))
    return Stretch(text(node.child("space")), offset, offset + _LAST, text(node.child("name")))


@dataclass(frozen=True, slots=True)
class _Rows:
    """The rows of one file, in a notation."""

    numbering: Numbering
    root: SourceNode
    among: tuple[Stretch, ...]

    def in_table(self, node: SourceNode) -> SourceNode:
        """A table with wire addresses: a list of rows, or rows by name."""
        if node.elements is not None:
            return listing((self._group(each) for each in node.elements), node.place)
        return mapping({key: self.rows(each) for key, each in (node.members or {}).items()}, node.place, node.keys)

    def _group(self, node: SourceNode) -> SourceNode:
        """A row of a table; a group may be written in a notation of its own, or relative to a block."""
        if node.child("block"):
            return cut(node, KEY)
        among = self.numbering.notation(node, self.root, self.among)
        return cut(_Rows(self.numbering, self.root, among).rows(node), KEY)

    def rows(self, node: SourceNode, space: str = "", stated: str = "") -> SourceNode:
        """A row, or a list of them: `stated` is the space that is said around it, `space` the one that it has."""
        if node.elements is not None:
            return listing((self.rows(each, space, stated) for each in node.elements), node.place)
        if node.members is None:
            return node
        stated = text(node.child("space")) or text(at(node, ("each", "space"))) or stated
        stated = "coil" if text(node.child("function")) in map(str, _COILS) else stated
        spaces = set[str]()
        numbers = () if node.child("block") else ("at", "aliases")  # a step in a block counts from there
        node = self._converted(node, numbers, stated, spaces)
        found = next(iter(spaces), stated or space)
        if spaces and not stated and found != (space or "holding"):
            node = put(node, "space", SourceNode(found, node.place))
        written = "coil" if found in _BITS else found if found == "enron" else "holding"
        node = self._converted(node, ("write_at",), written, set())
        for key, each in members(node).items():
            said = (written, written) if key == "write" else (found, stated)
            node = put(node, key, self.rows(each, *said)) if key in _INNER else node
        return node

    def _converted(self, node: SourceNode, keys: Iterable[str], stated: str, spaces: set[str]) -> SourceNode:
        """The row with the numbers of some keys as wire addresses; the space of the first is added to `spaces`."""
        for key in keys:
            each = node.child(key)
            node = node if each is None else put(node, key, self._wire(each, stated, set() if spaces else spaces))
        return node

    def _wire(self, node: SourceNode, stated: str, spaces: set[str]) -> SourceNode:
        """A number, a range of them or a list as wire addresses; their spaces are added to `spaces`."""
        if node.elements is not None:
            return listing((self._wire(each, stated, spaces) for each in node.elements), node.place)
        numbers = [int(end) for end in str(node.value).split("..") if end.strip().isdecimal()]
        numbered = self.among and numbers and stated not in _NOT_NUMBERED
        stretch = self._stretch(numbers, stated, node) if numbered else None
        if stretch is None:
            return node
        spaces.add(stretch.space)
        wire = [number - stretch.first for number in numbers]
        return node._replace(value=wire[0] if isinstance(node.value, int) else "..".join(map(str, wire)))

    def _stretch(self, numbers: list[int], stated: str, node: SourceNode) -> Stretch | None:
        first, last = numbers[0], numbers[-1]
        inside = [one for one in self.among if one.first <= first and last <= one.last]
        beyond = [one for one in self.among if one.space == stated and one.first <= first and last - one.first <= _LAST]
        fitting = [one for one in inside if one.space == stated] if stated else inside
        fitting = fitting or ([] if inside else beyond)
        if fitting:
            found = max(fitting, key=lambda one: one.first)
            if self.among == _MODICON:
                self.numbering.used.setdefault(found.space, found)
            return found
        where = f" in {stated}" if stated else ""
        message = f"{text(node)} is no number{where} of `{self.among[0].notation}`, which it is written in"
        ends = ", ".join(f"{one.first}..{one.last} ({one.space})" for one in self.among)
        advice = "" if stated else "; of others give the `space`"
        self.numbering.findings.add(NO_NUMBER, message, node.place, f"its numbers are {ends}{advice}")
        return None
