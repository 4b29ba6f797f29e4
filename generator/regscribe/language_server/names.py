"""What the files of a map declare, and where they refer to it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from regscribe.compose.tree import elements, id_of, key_place, members, text
from regscribe.language_server.files import MapText, Spot
from regscribe.source import SourceNode, SourcePlace

TABLES = {
    "model": "models",
    "notation": "notations",
    "given": "givens",
    "chain": "chains",
    "block": "blocks",
    "condition": "conditions",
    "unit": "units",
    "enum": "enums",
    "views": "views",
    "decimals": "decimals",
    "scale": "scales",
    "set": "sets",
    "command": "commands",
    "computed": "computed",
    "program": "programs",
}
"""The key at the top of a file under which things of a kind are declared, as `x-names` of the schema calls the kind."""

REGISTER, GROUP, VIEW = "register", "group", "view"
DEEPEST = 8
"""Sets in sets that are followed."""


@dataclass(frozen=True, slots=True)
class Declaration:
    """Something with a name: what it is, its name (of a register its path without indexes), where, and what is said.

    `spot` is the place of the name; `derived`: the id is made of the `name` that stands there.
    """

    kind: str
    name: str
    spot: Spot
    node: SourceNode
    derived: bool = False

    @property
    def id(self) -> str:
        """The last part of the name."""
        return self.name.rpartition(".")[2]


@dataclass(frozen=True, slots=True)
class Names:
    """The declarations of the files of a map: by kind and name, and the registers of sets by the name of the set."""

    tables: dict[tuple[str, str], Declaration]
    sets: dict[str, dict[str, Declaration]]

    def of(self, kind: str) -> dict[str, Declaration]:
        """All declarations of a kind by name."""
        return {name: one for (own, name), one in self.tables.items() if own == kind}

    def find(self, kind: str, name: str) -> Declaration | None:
        """The declaration of a name."""
        return self.tables.get((kind, name))

    def registers(self, inside: str = "") -> dict[str, Declaration]:
        """The registers that can be named in a set, or elsewhere."""
        return {**self.of(REGISTER), **self.sets.get(inside, {})}


def names_of(project: Sequence[MapText]) -> Names:
    """Collect what the files of a map declare; what stands in the first of them counts first."""
    tables: dict[tuple[str, str], Declaration] = {}
    for file in project:
        for one in _declared(file):
            tables.setdefault((one.kind, one.name), one)
    every = [(file, name, node) for file in project for name, node in members(file.root.child("sets")).items()]
    named = {name: (file, node) for file, name, node in reversed(every)}
    for file in project:
        for group in elements(file.root.child("groups")):
            for one in _registers(file, group.child("registers"), "", named):
                tables.setdefault((REGISTER, one.name), one)
    sets = {name: {one.name: one for one in _registers(file, node, "", named)} for name, (file, node) in named.items()}
    return Names(tables, sets)


def _declared(file: MapText) -> Iterator[Declaration]:
    for kind, table in TABLES.items():
        whole = file.root.child(table)
        for name, node in members(whole).items():
            if node.value is not None or kind == "model":
                yield Declaration(kind, name, Spot(file.path, key_place(whole or node, name)), node)
        for node in elements(whole):
            if label := node.child("name"):
                yield Declaration(kind, text(label), Spot(file.path, label.place), node)
    for group in elements(file.root.child("groups")):
        yield declared_at(file.path, group, GROUP)
    for views in members(file.root.child("views")).values():
        for name, view in members(views).items():
            yield Declaration(VIEW, name, Spot(file.path, key_place(views, name)), view)


def declared_at(path: Path, node: SourceNode, kind: str, prefix: str = "") -> Declaration:
    """The declaration of a register, an array or a group: at its id, else at its name, else where it starts."""
    own = node.child("id") or node.child("name")
    name = f"{prefix}{id_of(node)}"
    return Declaration(kind, name, Spot(path, own.place if own else node.place), node, derived=node.child("id") is None)


Sets = dict[str, tuple[MapText, SourceNode]]


def _registers(
    file: MapText, node: SourceNode | None, prefix: str, sets: Sets, depth: int = 0
) -> Iterator[Declaration]:
    """The registers and arrays of a list, those of sets among them."""
    for one in elements(node):
        used = sets.get(text(one.child("set")))
        if used and depth < DEEPEST:
            left_out = {text(each) for each in elements(one.child("except_ids"))}
            inside = _registers(used[0], used[1], prefix, sets, depth + 1)
            yield from (each for each in inside if each.name.removeprefix(prefix) not in left_out)
        elif one.members is not None and not one.child("set"):
            own = declared_at(file.path, one, REGISTER, prefix)
            if not own.id:
                continue
            yield own
            yield from _registers(file, one.child("registers"), f"{own.name}.", sets, depth)


def home_of(root: SourceNode, path: Sequence[str | int]) -> tuple[str, tuple[str, ...]]:
    """Where a path lies: the set around it (or none), and the prefixes of the arrays around it, the inner first."""
    inside = str(path[1]) if len(path) > 1 and path[0] == "sets" else ""
    node: SourceNode | None = root
    prefix, prefixes = "", [""]
    for place, step in enumerate(path):
        node = node.child(step) if node else None
        is_element = isinstance(step, int) and place and path[place - 1] == "registers"
        is_element = is_element or (isinstance(step, int) and place == 2 and bool(inside))  # noqa: PLR2004 - sets, name, number
        owner = node.child("array") if node and path[0] == "programs" else None
        if node and is_element and node.child("registers"):
            prefix = f"{prefix}{id_of(node)}."
        elif owner and tuple(path[place + 1 :]) != ("array",):  # names in a program are those of its arrays
            prefix = f"{prefix}{text(owner)}."
        prefixes.insert(0, prefix)
    return inside, tuple(dict.fromkeys(prefixes))


def part_places(place: SourcePlace, written: str, *, quoted: bool) -> Iterator[tuple[str, SourcePlace]]:
    """The names in a path (`segments[1].level`), without indexes, each with its place."""
    column = place.column + quoted
    for part in written.split("."):
        name = part.partition("[")[0]
        yield name, SourcePlace(place.line, column, place.line, column + len(name))
        column += len(part) + 1
