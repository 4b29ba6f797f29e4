"""What is being written at a position of a text: a key or a value, and where in the map."""

import re
from dataclasses import dataclass

from regscribe.language_server.tolerant import MARK, read
from regscribe.source import Path, SourceNode, SourcePlace

_BEFORE = re.compile(r"(?:.*[\s{\[,])?")
_AFTER = re.compile(r"\s*(?:$|#|[,\]}:])")
_NO_WORD = re.compile(rf"-?{MARK}-?(?:\s|$)|.*:{MARK}")
"""Behind a dash or a colon without its blank, or before blanks and something else."""


@dataclass(frozen=True, slots=True)
class Cursor:
    """A place where something may be written.

    `path` leads to the mapping that gets a key (`at_key`), or to the value. `place` is that of the word at the cursor.
    `own_line`: nothing but dashes stands before it on its line. `has_colon`: the key has its colon. `root` is the
    text's tree, in which the word has a mark.
    """

    root: SourceNode
    path: Path
    at_key: bool
    place: SourcePlace
    own_line: bool
    has_colon: bool

    def value(self) -> dict[str, object]:
        """The mapping that gets a key, without the key at the cursor."""
        node: SourceNode | None = self.root
        for step in self.path:
            node = node.child(step) if node else None
        members = (node.members if node else None) or {}
        return {key: one.value for key, one in members.items() if MARK not in key}


def cursor_at(text: str, line: int, column: int) -> Cursor | None:
    """What is being written at a position, which counts from 0; None in comments and where no word can stand."""
    lines = text.replace(MARK, " ").split("\n")
    if line >= len(lines):
        return None
    before, after = lines[line][:column], lines[line][column:]
    lines[line] = f"{before}{MARK}{after}"
    root = read("\n".join(lines))
    found = _marked(root)
    if found is None:
        return None
    path, at_key, place = found
    if place.line != place.end_line or not _is_word(lines[line], place):
        return None
    end = place.end_column - 1
    own_line = not before[: place.column].strip(" -") and place.line == line
    whole = SourcePlace(place.line, place.column, place.end_line, max(end, place.column))
    has_colon = at_key and lines[line][place.end_column :].lstrip().startswith(":")
    return Cursor(root, path, at_key, whole, own_line, has_colon)


def _is_word(text: str, place: SourcePlace) -> bool:
    """Whether what is at the cursor stands alone: between blanks, brackets and commas, on one line."""
    before, word, after = text[: place.column], text[place.column : place.end_column], text[place.end_column :]
    return bool(_BEFORE.fullmatch(before) and _AFTER.match(after)) and not (word != MARK and _NO_WORD.match(word))


def _marked(root: SourceNode) -> tuple[Path, bool, SourcePlace] | None:
    """Where the mark is: the path, whether in a key, and the place of the key or value."""
    waiting: list[tuple[SourceNode, Path]] = [(root, ())]
    while waiting:
        node, path = waiting.pop()
        for key, place in (node.keys or {}).items():
            if MARK in key:
                return path, True, place
        if isinstance(node.value, str) and MARK in node.value:
            return path, False, node.place
        waiting += [(child, (*path, key)) for key, child in (node.members or {}).items()]
        waiting += [(child, (*path, number)) for number, child in enumerate(node.elements or ())]
    return None


def path_at(root: SourceNode, line: int, column: int) -> tuple[Path, bool]:
    """The path to what stands at a position, and whether that is a key: then the path ends with it."""
    return _path_below(root, (), line, column)


def _path_below(node: SourceNode, path: Path, line: int, column: int) -> tuple[Path, bool]:
    for key, place in (node.keys or {}).items():
        if covers(place, line, column):
            return (*path, key), True
    for key, child in (node.members or {}).items():
        if covers(child.place, line, column):
            return _path_below(child, (*path, key), line, column)
    for number, child in enumerate(node.elements or ()):
        if covers(child.place, line, column):
            return _path_below(child, (*path, number), line, column)
    return path, False


def covers(place: SourcePlace, line: int, column: int) -> bool:
    """Whether a position lies in a place, or just behind it."""
    return (place.line, place.column) <= (line, column) <= (place.end_line, place.end_column)
