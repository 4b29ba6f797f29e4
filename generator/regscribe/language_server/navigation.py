"""Where things are declared and used, and what a file holds."""

from collections.abc import Iterator
from dataclasses import dataclass

from regscribe.compose.tree import elements, id_of, key_place, members, text
from regscribe.language_server.cursor import covers
from regscribe.language_server.files import Files, MapText, Spot, bases
from regscribe.language_server.names import GROUP, REGISTER, TABLES, Declaration, Names, declared_at, names_of
from regscribe.language_server.references import references_in, resolve, uses_of
from regscribe.source import SourceNode, SourcePlace


@dataclass(frozen=True, slots=True)
class Outlined:
    """A thing of a file: its name, what it is, all of it, where its name stands, and what is in it."""

    name: str
    kind: str
    place: SourcePlace
    own: SourcePlace
    inside: tuple["Outlined", ...] = ()


def named_at(files: Files, file: MapText, line: int, column: int) -> tuple[SourcePlace, Declaration] | None:
    """The declared thing whose name stands at a position, where it is used or declared, and the place of the name."""
    names = names_of(files.project(file.path))
    for reference in references_in(file):
        if covers(reference.place, line, column):
            for place, found in resolve(reference, file, names):
                if covers(place, line, column):
                    return place, found
    return declared_here(file, names, line, column)


def declared_here(file: MapText, names: Names, line: int, column: int) -> tuple[SourcePlace, Declaration] | None:
    """The thing that is declared at a position."""
    every = [*names.tables.values(), *(one for table in names.sets.values() for one in table.values())]
    for one in every:
        if one.spot.file == file.path and covers(one.spot.place, line, column):
            return one.spot.place, one
    return None


def register_around(file: MapText, line: int, column: int) -> SourceNode | None:
    """The innermost register or array around a position."""
    found, waiting = None, [file.root.child("groups"), *members(file.root.child("sets")).values()]
    while waiting:
        node = waiting.pop()
        for one in elements(node):
            if covers(one.place, line, column):
                found = found if one.child("registers") and not one.child("at") and not one.child("repeat") else one
                waiting = [one.child("registers")]
    return found


def references(files: Files, file: MapText, wanted: Declaration, every: list[MapText]) -> list[Spot]:
    """All uses of a thing in a file, in what it builds on, and in those of `every` that build on where it stands."""
    spots: dict[Spot, None] = {}
    for one in {each.path: each for each in (file, *every)}.values():
        project = files.project(one.path)
        if any(each.path == wanted.spot.file for each in project):
            names = names_of(project)
            spots |= dict.fromkeys(uses_of(wanted, project, names))
    return list(spots)


def targets(files: Files, file: MapText, line: int, column: int) -> list[Spot]:
    """Where the thing is declared whose name stands at a position; of `extends` and `uses` the file."""
    for node, path in bases(file, files.unsaved):
        if covers(node.place, line, column):
            return [Spot(path, SourcePlace(0, 0, 0, 0))]
    found = named_at(files, file, line, column)
    return [found[1].spot] if found else []


def outline(file: MapText) -> list[Outlined]:
    """The groups with their registers, and the tables of names."""
    groups = elements(file.root.child("groups"))
    found = [_outlined(file, one, GROUP, tuple(_registers(file, one.child("registers")))) for one in groups]
    for kind, table in TABLES.items():
        whole = file.root.child(table)
        if whole and whole.members:
            own = key_place(file.root, table)
            found.append(Outlined(table, "table", _span(own, whole), own, tuple(_declared(file, kind, whole))))
    return sorted(found, key=lambda one: one.place)


def _declared(file: MapText, kind: str, table: SourceNode) -> Iterator[Outlined]:
    for name, node in members(table).items():
        own = key_place(table, name)
        inside = tuple(_registers(file, node)) if kind == "set" else ()
        yield Outlined(name, kind, _span(own, node), own, inside)


def _registers(file: MapText, node: SourceNode | None) -> Iterator[Outlined]:
    for one in elements(node):
        if one.members is None:
            continue
        if used := one.child("set"):
            yield Outlined(f"set {text(used)}", "set", one.place, used.place)
        elif id_of(one):
            yield _outlined(file, one, REGISTER, tuple(_registers(file, one.child("registers"))))


def _outlined(file: MapText, node: SourceNode, kind: str, inside: tuple[Outlined, ...]) -> Outlined:
    own = declared_at(file.path, node, kind)
    kind = "array" if kind == REGISTER and node.child("registers") else kind
    return Outlined(own.name or kind, kind, _span(own.spot.place, node), own.spot.place, inside)


def _span(own: SourcePlace, node: SourceNode) -> SourcePlace:
    start = min((own.line, own.column), (node.place.line, node.place.column))
    end = max((own.end_line, own.end_column), (node.place.end_line, node.place.end_column))
    return SourcePlace(*start, *end)
