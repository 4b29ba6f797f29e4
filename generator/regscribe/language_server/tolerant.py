"""The tree of a map's text while it is written: a broken line costs what stands in it, and nothing else is lost.

Of a sound text the tree is that of `source.parse`, with its places; nothing is ever refused.
"""

import re

from regscribe.language_server.characters import BLOCK_TEXT, DASH, KEY, PROPERTY
from regscribe.language_server.tolerant_flow import FlowReader, collection, key_text, listing, scalar
from regscribe.source import SourceNode, SourcePlace

MARK = "\ue000"
"""Stands at the cursor in a text that is read to find out what may be written there."""

_WORD = re.compile(rf"[^\s:#]*{MARK}[^\s:#]*")
_ALIAS = re.compile(r"\*([^\s,\[\]{}]+)")


def read(text: str) -> SourceNode:
    """The tree of a text; line ends are line feeds."""
    reader = _Reader(text)
    at = reader.at
    reader.start()
    node = reader.block(-1)
    while not at.ended and node.members is not None:  # what no collection took
        at.next_line()
        at.skip()
        more = reader.block(-1)
        if more.members:
            node = collection(node.place, {**(more.keys or {}), **(node.keys or {})}, {**more.members, **node.members})
    return node


class _Reader(FlowReader):
    """Reads collections in block style by their indentation."""

    def start(self) -> None:
        """Go to the first value of the document, behind a mark and directives, which no map has."""
        self.at.skip()
        while self.at.rest.startswith("%"):
            self.at.next_line()
            self.at.skip()
        if re.match(r"---\s*$", self.at.rest):
            self.at.next_line()
            self.at.skip()

    def block(self, floor: int) -> SourceNode:
        """The value that starts here, more than `floor` deep."""
        at = self.at
        at.skip()
        if at.ended or at.column <= floor or self.depth > self.DEEPEST:
            return SourceNode(None, at.place(at.line, at.column))
        self.depth += 1
        column = at.column
        if at.match(DASH):
            node = self._list(column)
        elif at.match(KEY) or (at.match(_WORD) and not at.lines[at.line][:column].strip()):
            node = self._mapping(column)
        else:
            node = self._inline(floor)
        self.depth -= 1
        return node

    def _list(self, column: int) -> SourceNode:
        at, elements, start = self.at, list[SourceNode](), self.at.line
        while self._continues(column) and (dash := at.take(DASH)):
            line = at.line
            if not at.rest or at.rest.startswith("#"):
                at.next_line()
                at.skip()
                elements.append(
                    self.block(column) if not at.ended and at.column > column else self._nothing(line, dash.end())
                )
            else:
                elements.append(self._value(column, in_list=True))
        return listing(SourcePlace(start, column, start, column), elements)

    def _mapping(self, column: int) -> SourceNode:
        at, start = self.at, self.at.line
        keys, members = dict[str, SourcePlace](), dict[str, SourceNode]()
        while self._continues(column):
            line, where = at.line, at.column
            found = at.take(KEY) or at.take(_WORD)
            if not found or at.match(DASH):
                if where == column and found is None and at.match(DASH):
                    break
                at.next_line()
                continue
            name = key_text(found[1] if found.re is KEY else found[0])
            keys.setdefault(
                name, SourcePlace(line, where, line, where + len(found[1] if found.re is KEY else found[0]))
            )
            members[name] = self._value(column) if found.re is KEY else self._nothing(line, found.end())
        return collection(SourcePlace(start, column, start, column), keys, members)

    def _continues(self, column: int) -> bool:
        """Go to the next line of a collection; False where it ends. What is too deep belongs to nothing, but a mark."""
        at = self.at
        at.skip()
        while not at.ended and at.column > column and not at.match(_WORD):
            at.next_line()
            at.skip()
        return not at.ended and at.column >= column

    def _value(self, column: int, *, in_list: bool = False) -> SourceNode:
        """The value behind a key or a dash that stands at `column`."""
        at = self.at
        anchor = self._anchor()
        line, where = at.line, at.column
        if in_list and (at.match(DASH) or at.match(KEY)):
            node = self.block(column)
        elif not at.rest or at.rest.startswith("#"):
            node = self._below(column, line, where)
        elif at.match(BLOCK_TEXT):
            node = self._block_text(column)
        else:
            node = self._inline(column)
        return self._anchored(anchor, node)

    def _anchor(self) -> str:
        anchor = ""
        self.at.skip_blanks()
        while found := self.at.take(PROPERTY):
            anchor = found[1] if found[0].startswith("&") else anchor
        return anchor

    def _below(self, column: int, line: int, where: int) -> SourceNode:
        """The value on the lines below a key; a list may start as deep as its key."""
        at = self.at
        at.next_line()
        at.skip()
        if at.ended or at.column < column or (at.column == column and not at.match(DASH)):
            return self._nothing(line, where)
        return self.block(column - 1 if at.column == column else column)

    def _block_text(self, column: int) -> SourceNode:
        """A text after `|` or `>`."""
        at, line, where = self.at, self.at.line, self.at.column
        at.next_line()
        found = []
        while not at.ended:
            text = at.rest
            if text.strip() and len(text) - len(text.lstrip(" ")) <= column:
                break
            found.append(text.strip())
            at.next_line()
        return SourceNode("\n".join(found), at.place(line, where))

    def _inline(self, floor: int) -> SourceNode:
        """A value in flow style or a scalar, then the end of its line."""
        at = self.at
        if alias := at.take(_ALIAS):
            place = SourcePlace(at.line, alias.start(), at.line, alias.end())
            node = self.anchors.get(alias[1], SourceNode(None, place))._replace(place=place)
        elif at.rest[:1] in {"{", "["}:
            node = self.flow(floor)
        else:
            node = self._scalar(floor)
        at.skip_blanks()
        if not at.ended and at.rest and at.column > 0:
            at.next_line()
        return node

    def _scalar(self, floor: int) -> SourceNode:
        """A scalar in block style, which goes on over lines that are deeper than `floor`."""
        at, line, where = self.at, self.at.line, self.at.column
        if at.rest[:1] in {'"', "'"}:
            return self.quoted(floor)
        text = at.rest.split(" #")[0].rstrip()
        at.column += len(text)
        end = at.place(line, where)
        while not at.rest.strip() and at.line + 1 < len(at.lines):
            below = at.lines[at.line + 1]
            deep = len(below) - len(below.lstrip(" "))
            if not below.strip() or deep <= floor or below.lstrip().startswith(("#", "- ")) or KEY.match(below, deep):
                break
            at.line, at.column = at.line + 1, len(below.split(" #")[0].rstrip())
            text, end = f"{text} {below.split(' #')[0].strip()}", at.place(line, where)
        return scalar(text, end)

    def _nothing(self, line: int, column: int) -> SourceNode:
        return SourceNode(None, SourcePlace(line, column, line, column))
