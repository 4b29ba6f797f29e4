"""Values in flow style, and scalars, read so that an unclosed bracket or quote ends where its block does."""

import re

from regscribe.language_server.characters import PROPERTY, Characters
from regscribe.source import NumberFormError, Plain, SourceNode, SourcePlace, resolve

_PLAIN = re.compile(r"(?:[^,\[\]{}:#\n]|:(?![\s,\[\]{}]|$)|(?<=\S)#)*")
_COLON = re.compile(r"[ \t]*:[ \t]*")
_ALIAS = re.compile(r"\*([^\s,\[\]{}]+)")
_ENDS = {"{": "}", "[": "]"}
LONGEST = 100
"""Lines in which the end of a quoted text is looked for."""

_ESCAPES = {"n": "\n", "t": "\t"}


def scalar(text: str, place: SourcePlace) -> SourceNode:
    """A plain scalar; a number in a notation that maps do not have is a text."""
    try:
        value: Plain = resolve(text)
    except NumberFormError:
        value = text
    return SourceNode(value, place)


def unquoted(text: str) -> str:
    """What a text in quotes says; of escapes those that maps use."""
    inner = " ".join(line.strip() for line in text[1:-1].split("\n")) if "\n" in text else text[1:-1]
    if text.startswith("'"):
        return inner.replace("''", "'")
    return re.sub(r"\\(.)", lambda found: _ESCAPES.get(found[1], found[1]), inner)


def key_text(text: str) -> str:
    """A key as `source` has it: codes in decimal."""
    if text[:1] in {'"', "'"}:
        return unquoted(text)
    value = scalar(text, SourcePlace(0, 0, 0, 0)).value
    return str(value) if type(value) is int else text


def collection(start: SourcePlace, keys: dict[str, SourcePlace], members: dict[str, SourceNode]) -> SourceNode:
    """A mapping in block style, which ends where its last value does."""
    last = list(members.values())[-1].place if members else start
    place = start._replace(end_line=last.end_line, end_column=last.end_column)
    return SourceNode({key: node.value for key, node in members.items()}, place, keys, members)


def listing(start: SourcePlace, elements: list[SourceNode]) -> SourceNode:
    """A list in block style, which ends where its last element does."""
    last = elements[-1].place if elements else start
    place = start._replace(end_line=last.end_line, end_column=last.end_column)
    return SourceNode([node.value for node in elements], place, elements=elements)


class FlowReader:
    """Reads values in flow style; `floor` is the column of the block around them, whose next line ends them."""

    DEEPEST = 60

    def __init__(self, text: str) -> None:
        self.at = Characters(text)
        self.anchors: dict[str, SourceNode] = {}
        self.depth = 0

    def flow(self, floor: int, outer: str = "") -> SourceNode:
        """The collection whose bracket stands here; `outer` are the brackets that end those around it."""
        at, line, column = self.at, self.at.line, self.at.column
        opening = at.rest[0]
        closing = _ENDS[opening]
        at.column += 1
        self.depth += 1
        keys, members, elements = dict[str, SourcePlace](), dict[str, SourceNode](), list[SourceNode]()
        while self._goes_on(line, floor):
            character = at.rest[0]
            if character == closing:
                at.column += 1
                break
            if character in outer:
                break
            if character in ",]}" or (character in _ENDS and self.depth > self.DEEPEST):
                at.column += 1
            elif opening == "{":
                self._entry(floor, outer + closing, keys, members)
            else:
                elements.append(self._element(floor, outer + closing))
        self.depth -= 1
        place = at.place(line, column)
        if opening == "[":
            return SourceNode([node.value for node in elements], place, elements=elements)
        return SourceNode({key: node.value for key, node in members.items()}, place, keys, members)

    def _goes_on(self, line: int, floor: int) -> bool:
        """Go to the next character of a collection; False where the block around it has gone on, or the text ends."""
        at = self.at
        before = at.line, at.column
        at.skip()
        if at.ended or (at.line > line and at.line > before[0] and at.column <= floor and at.rest[0] not in "]}"):
            at.line, at.column = before
            return False
        return True

    def _entry(self, floor: int, outer: str, keys: dict[str, SourcePlace], members: dict[str, SourceNode]) -> None:
        at, line, column = self.at, self.at.line, self.at.column
        if at.rest[0] in _ENDS:  # a collection as a key: no key of any map
            self.flow(floor, outer)
            return
        text = self._text(floor)
        if at.line == line and at.column == column:
            at.column += 1
            return
        name = key_text(text)
        keys.setdefault(name, at.place(line, column))
        if at.take(_COLON):
            members[name] = self._element(floor, outer)
        else:
            members[name] = SourceNode(None, at.place(at.line, at.column))

    def _element(self, floor: int, outer: str) -> SourceNode:
        """A value in a collection; nothing where the next `,` or bracket stands."""
        at = self.at
        anchor, line, column = "", at.line, at.column
        while found := at.take(PROPERTY):
            anchor = found[1] if found[0].startswith("&") else anchor
        if not self._goes_on(line, floor) or at.rest[0] in ",]}":
            node = SourceNode(None, SourcePlace(line, column, line, column))
        elif alias := at.take(_ALIAS):
            place = SourcePlace(at.line, alias.start(), at.line, alias.end())
            node = self.anchors.get(alias[1], SourceNode(None, place))._replace(place=place)
        elif at.rest[0] in _ENDS and self.depth <= self.DEEPEST:
            node = self.flow(floor, outer)
        else:
            node = self._plain_or_quoted(floor)
        return self._anchored(anchor, node)

    def _plain_or_quoted(self, floor: int) -> SourceNode:
        at, line, column = self.at, self.at.line, self.at.column
        quoted = at.rest[0] in "\"'"
        text = self._text(floor)
        if (at.line, at.column) == (line, column):
            at.column += 1
        place = at.place(line, column)
        return SourceNode(unquoted(text), place) if quoted else scalar(text, place)

    def _anchored(self, anchor: str, node: SourceNode) -> SourceNode:
        if anchor:
            self.anchors[anchor] = node
        return node

    def _text(self, floor: int) -> str:
        """The text of a scalar as it is written, in quotes or plain."""
        at = self.at
        if at.rest[0] in "\"'":
            line, column = at.line, at.column
            self.quoted(floor)
            return "\n".join([*at.lines[line : at.line], at.lines[at.line][: at.column]])[column:]
        found = at.take(_PLAIN)
        text = found[0] if found else ""
        at.column -= len(text) - len(text.rstrip())
        text = text.rstrip()
        while text and not at.rest.strip() and at.line + 1 < len(at.lines):
            below = at.lines[at.line + 1]
            deep = len(below) - len(below.lstrip(" "))
            if not below.strip() or deep <= floor or below[deep] in ",[]{}#\"'&*":
                break
            at.line, at.column = at.line + 1, deep
            more = at.take(_PLAIN)
            text = f"{text} {more[0].strip() if more else ''}"
            at.column -= len(more[0]) - len(more[0].rstrip()) if more else 0
        return text

    def quoted(self, floor: int) -> SourceNode:
        """A text in quotes; one that is not closed ends with its line."""
        at, line, column = self.at, self.at.line, self.at.column
        end = re.compile(r"(?:[^\"\\]|\\.)*\"" if at.rest[0] == '"' else r"(?:[^']|'')*'")
        text = at.rest
        lines = 1
        while not (found := end.match(text, 1)):
            below = at.lines[line + lines] if line + lines < len(at.lines) else ""
            if lines > LONGEST or not below.strip() or len(below) - len(below.lstrip(" ")) <= floor:
                at.column = len(at.lines[line])
                return SourceNode(at.lines[line][column + 1 :], at.place(line, column))
            text, lines = f"{text}\n{below}", lines + 1
        before = text[: found.end()]
        at.line = line + before.count("\n")
        at.column = column + len(before) if at.line == line else len(before) - before.rfind("\n") - 1
        return SourceNode(unquoted(before), at.place(line, column))
