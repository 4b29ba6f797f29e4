"""Mends that a diagnostic proposes: the name that was meant, a key that is missing, an address that is free."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

from regscribe.compose.tree import elements, members
from regscribe.language_server import grammar
from regscribe.language_server.files import Files, MapText
from regscribe.language_server.navigation import register_around
from regscribe.language_server.positions import place_of
from regscribe.language_server.rename import Edit, apply
from regscribe.model import Diagnostic
from regscribe.pipeline import compile_map
from regscribe.schema import inline
from regscribe.schema.rules import MISSING_KEY
from regscribe.source import Path as TreePath
from regscribe.source import SourceNode, SourcePlace

OVERLAP = "RS0401"
FARTHEST = 2000
TRIES = 4
"""Addresses that are tried; each takes a compilation."""


@dataclass(frozen=True, slots=True)
class Fix:
    """A mend: what it does in words, the edits of the file, and whether it is most likely what was meant."""

    title: str
    edits: tuple[Edit, ...]
    likely: bool = False


def fixes(files: Files, file: MapText, found: Diagnostic) -> Iterator[Fix]:
    """All mends of a finding."""
    place = place_of(found.span)
    if found.replacement:
        yield Fix(f"Write `{found.replacement}`", ((place, inline(found.replacement)),), likely=True)
    if found.rule == MISSING_KEY:
        yield from _missing(file, place)
    if found.rule == OVERLAP and (fix := _free_address(files, file, found)):
        yield fix


def _missing(file: MapText, place: SourcePlace) -> Iterator[Fix]:
    """The keys that a mapping needs, each with an example of a value."""
    for path, node in _mappings(file.root, (), place):
        value = node.value
        schemas = grammar.at(file.root, path)
        known = grammar.keys(schemas)
        for key in dict.fromkeys(grammar.required(schemas)):
            if key not in value:
                said = known.get(key, {})
                example = next(iter(said.get("x-examples", ())), "")
                yield Fix(f"Add `{key}`", (_added(file, node, f"{key}: {inline(example)}"),))


def _mappings(node: SourceNode, path: TreePath, place: SourcePlace) -> Iterator[tuple[TreePath, SourceNode]]:
    """The mappings that stand at a place, or whose key does."""
    if path == () and node.members is not None and node.place[:2] == place[:2]:
        yield path, node
    for key, child in (node.members or {}).items():
        if child.members is not None and place[:2] in {(node.keys or {})[key][:2], child.place[:2]}:
            yield (*path, key), child
        yield from _mappings(child, (*path, key), place)
    for number, child in enumerate(node.elements or ()):
        if child.members is not None and child.place[:2] == place[:2]:
            yield (*path, number), child
        yield from _mappings(child, (*path, number), place)


def _added(file: MapText, node: SourceNode, written: str) -> Edit:
    """The edit that adds a key at the end of a mapping."""
    lines = file.text.split("\n")
    place = node.place
    if lines[place.line][place.column : place.column + 1] == "{":
        line, column = place.end_line, place.end_column - 1
        if lines[line][column : column + 1] != "}":
            line, column = place.end_line, place.end_column
        return SourcePlace(line, column, line, column), f", {written}" if node.members else written
    line, column = place.end_line, len(lines[place.end_line].split(" #")[0].rstrip())
    return SourcePlace(line, column, line, column), f"\n{' ' * place.column}{written}"


def _free_address(files: Files, file: MapText, found: Diagnostic) -> Fix | None:
    """The next address at which a register overlaps nothing."""
    register = register_around(file, found.span.line - 1, found.span.column - 1)
    at = register.child("at") if register else None
    if at is None or not isinstance(at.value, int):
        return None
    taken = set(_addresses(file.root))
    free = (number for number in range(at.value + 1, at.value + FARTHEST) if number not in taken)
    for number in islice(free, TRIES):
        edit = (at.place, str(number))
        if not _overlaps_still(files, file, found, edit):
            return Fix(f"Move it to {number}, the next free address", (edit,))
    return None


def _overlaps_still(files: Files, file: MapText, found: Diagnostic, edit: Edit) -> bool:
    texts = {**files.unsaved, file.path: apply(file.text, [edit])}
    name = found.message.partition("`")[2].partition("`")[0]
    now = compile_map(file.path, texts).diagnostics
    return any(one.rule == OVERLAP and f"`{name}`" in one.message for one in now)


def _addresses(root: SourceNode) -> Iterator[int]:
    """All numbers that stand at `at`."""
    waiting = [
        *(group.child("registers") for group in elements(root.child("groups"))),
        *members(root.child("sets")).values(),
    ]
    while waiting:
        for one in elements(waiting.pop()):
            at = one.child("at")
            if at is not None and isinstance(at.value, int):
                yield at.value
            waiting.append(one.child("registers"))
