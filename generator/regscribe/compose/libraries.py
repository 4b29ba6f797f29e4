"""Libraries: their names become names of the map, their commands, errata and notes come along."""

from regscribe.compose.file_loader import LoadedFile
from regscribe.compose.findings import LEAVES_NOTHING_OUT, ComposeFindings, suggestion
from regscribe.compose.merge import TABLES, laid_over, replace
from regscribe.compose.numbering import Numbering
from regscribe.compose.tree import cut, in_file, key_place, listing, mapping, members, put, remove
from regscribe.model import Diagnostic
from regscribe.model.nearest import nearest
from regscribe.source import Document, SourceNode

_LISTS = ("errata", "notes")
_WHOLE = ("process",)
_MERGED = {*TABLES, *_LISTS, "notations", "protocol"}


def with_libraries(root: SourceNode, libraries: list[LoadedFile], findings: ComposeFindings) -> SourceNode:
    """The map with all that its libraries hold, less the commands that it gives as null."""
    nulls = left_out(root)
    below = mapping({}, root.place)
    for library in libraries:
        part = _without(library.root, nulls)
        advice = "use one of the two libraries only"
        below = laid_over(below, part, findings, _LISTS, owner="another library", advice=advice)
        below = replace(below, part, _WHOLE)
    every = [name for library in libraries for name in members(library.root.child("commands"))]
    for name in nulls - set(every):
        message = f"there is no command `{name}` in a library that could be left out"
        where = key_place(root.child("commands") or root, name)
        advice = f"commands of a base are dropped by `drop`; {suggestion(name, every)}"
        findings.add(LEAVES_NOTHING_OUT, message, where, advice, replacement=nearest(name, every))
    own = _without(root, nulls)
    advice = "use that one, or rename yours"
    merged = laid_over(below, own, findings, _LISTS, owner="a library that it uses", advice=advice)
    return replace(merged, own, [key for key in own.members or () if key not in _MERGED])


def left_out(root: SourceNode) -> set[str]:
    """The commands that a map gives as null: those of its libraries that it has not."""
    return {name for name, command in members(root.child("commands")).items() if command.value is None}


def _without(root: SourceNode, commands: set[str]) -> SourceNode:
    for name in sorted(commands):
        root = remove(root, ("commands", name))
    return root


def as_map(library: Document) -> tuple[Document, list[Diagnostic]]:
    """A map of one model with a group for each set of a library, so that its references can be looked at."""
    findings, place = ComposeFindings(), library.root.place
    root = Numbering(findings, {}).on_the_wire(in_file(library.root, library.name))
    groups = []
    for name, registers in members(root.child("sets")).items():
        label = SourceNode(name, registers.place)
        groups.append(mapping({"id": label, "name": label, "registers": registers}, registers.place))
    models = mapping({"Library": mapping({}, place)}, place)
    root = put(cut(root, "library"), "map", root.child("library") or root)
    root = put(put(root, "models", models), "groups", listing(groups, place))
    return Document(library.name, library.text, root.value, library.content_hash, root), findings.diagnostics
