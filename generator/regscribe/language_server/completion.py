"""What may be written at the cursor: keys that the schema allows there, values, and names that the map knows."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from regscribe.compose.tree import text
from regscribe.language_server import grammar
from regscribe.language_server.cursor import Cursor, cursor_at
from regscribe.language_server.files import Files, MapText, folders
from regscribe.language_server.meaning import members_of, summary
from regscribe.language_server.names import REGISTER, Names, home_of, names_of
from regscribe.language_server.tolerant import MARK
from regscribe.map_files import ENDINGS, ids_in
from regscribe.model.units import KNOWN_UNITS
from regscribe.schema import inline
from regscribe.source import Path, SourcePlace


@dataclass(frozen=True, slots=True)
class Proposal:
    """Something to write at `place`: what a list shows, what is inserted, and what is said of it in Markdown."""

    label: str
    insert: str
    place: SourcePlace
    sort: str
    detail: str = ""
    about: str = ""


def complete(files: Files, file: MapText, line: int, column: int) -> list[Proposal]:
    """All that may be written at a position of a file, the likeliest first."""
    cursor = cursor_at(file.text, line, column)
    if cursor is None:
        return []
    names = names_of(files.project(file.path))
    found = list(_keys_at(cursor, names) if cursor.at_key else _values_at(cursor, names, file))
    return list({one.insert: one for one in reversed(found)}.values())[::-1]


def _keys_at(cursor: Cursor, names: Names) -> Iterator[Proposal]:
    """The keys that may be added to a mapping; where a list is to stand, its elements."""
    value = cursor.value()
    roots = grammar.roots_at(cursor.root, cursor.path)
    yield from _keys(roots, value, cursor)
    schemas = [part for root in roots for part in grammar.parts(root, value)]
    if kind := grammar.kind_of_keys(schemas):
        ending = "" if cursor.has_colon else ": "
        yield from _named(kind, cursor, names, list(value), ending=ending)
    if cursor.own_line and not value:
        yield from _elements(roots, cursor)


def _keys(roots: Sequence[object], value: dict[str, object], cursor: Cursor, before: str = "") -> Iterator[Proposal]:
    free = grammar.missing_keys(roots, value)
    schemas = [part for root in roots for part in grammar.parts(root, value)]
    needed = grammar.required(schemas)
    for number, (key, schema) in enumerate(free.items()):
        ending = "" if cursor.has_colon else ": "
        rank = f"{key not in needed:d}{number:03}"
        detail = "needed" if key in needed else ""
        yield Proposal(key, f"{before}{key}{ending}", cursor.place, f"0{rank}", detail, grammar.about([schema]))


def _elements(roots: Sequence[object], cursor: Cursor) -> Iterator[Proposal]:
    """The keys of the first element of a list that is to start here."""
    lists = [part for root in roots for part in grammar.parts(root, [])]
    yield from _keys(grammar.under(lists, 0), {}, cursor, "- ")


def _values_at(cursor: Cursor, names: Names, file: MapText) -> Iterator[Proposal]:
    roots = grammar.roots_at(cursor.root, cursor.path)
    schemas = [part for root in roots for part in grammar.parts(root, "")]
    for number, (word, about) in enumerate(grammar.words(schemas).items()):
        yield Proposal(word, word, cursor.place, f"0{number:03}", about=about)
    if kind := grammar.kind_named(schemas):
        yield from _named(kind, cursor, names, _beside(cursor), file=file)
    yield from _members(cursor, names)
    if cursor.own_line:
        yield from _keys(roots, {}, cursor)
        yield from _elements(roots, cursor)


def _beside(cursor: Cursor) -> list[str]:
    """The other elements of the list in which the cursor stands."""
    node = cursor.root
    for step in cursor.path[:-1]:
        found = node.child(step)
        if found is None:
            return []
        node = found
    return [text(one) for one in node.elements or () if MARK not in text(one)]


def _named(
    kind: str,
    cursor: Cursor,
    names: Names,
    given: Sequence[str],
    *,
    file: MapText | None = None,
    ending: str = "",
) -> Iterator[Proposal]:
    """The names of a kind that are not given yet."""
    if kind in ENDINGS and file:
        every = dict.fromkeys(ids_in(folders(file), kind), "")
    elif kind == REGISTER:
        every = _registers(cursor, names)
    else:
        every = {name: summary(one) for name, one in names.of(kind).items()}
        every |= {symbol: "known unit" for symbol in KNOWN_UNITS if symbol not in every} if kind == "unit" else {}
    for number, (name, detail) in enumerate(every.items()):
        if name not in given:
            yield Proposal(name, f"{inline(name)}{ending}", cursor.place, f"1{number:04}", detail)


def _registers(cursor: Cursor, names: Names) -> dict[str, str]:
    """The registers as they are called here: those of the same element by their ids alone."""
    inside, prefixes = home_of(cursor.root, cursor.path)
    known = names.registers(inside)
    near = {
        name.removeprefix(prefix): one
        for prefix in prefixes
        if prefix
        for name, one in known.items()
        if name.startswith(prefix)
    }
    return {name: summary(one) for name, one in {**near, **known}.items() if "." not in name or name in known}


def _members(cursor: Cursor, names: Names) -> Iterator[Proposal]:
    """The codes of the register whose value stands at the cursor: its default, or a test of it."""
    path: Path = cursor.path[:-1] if cursor.path and isinstance(cursor.path[-1], int) else cursor.path
    if not path or not isinstance(path[-1], str):
        return
    inside, prefixes = home_of(cursor.root, path)
    known = names.registers(inside)
    tested = next((known[f"{prefix}{path[-1]}"] for prefix in prefixes if f"{prefix}{path[-1]}" in known), None)
    parent = grammar.at(cursor.root, path[:-1])
    if tested and grammar.kind_of_keys(parent) == REGISTER:
        for number, (code, name, label) in enumerate(members_of(tested.node, names)):
            yield Proposal(name, inline(name), cursor.place, f"0{number:03}", f"{code}: {label}")
    elif path[-1] in {"default", "delivered"}:
        node = cursor.root
        for step in path[:-1]:
            node = node.child(step) or node
        for number, (code, name, label) in enumerate(members_of(node, names)):
            yield Proposal(f"{code} = {label}", code, cursor.place, f"0{number:03}", name)
