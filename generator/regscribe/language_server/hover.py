"""What stands at a position: the meaning of a key, of a name, or all about a register."""

from regscribe.language_server import grammar
from regscribe.language_server.condition_facts import condition_text
from regscribe.language_server.cursor import path_at
from regscribe.language_server.files import Files, MapText
from regscribe.language_server.meaning import meaning
from regscribe.language_server.names import REGISTER, declared_at
from regscribe.language_server.navigation import named_at, register_around
from regscribe.language_server.register_facts import facts, found_at
from regscribe.model import RegisterMap
from regscribe.source import SourceNode, SourcePlace, display_name

OF_REGISTER = {"at", "id", "name", "symbol"}
"""Keys whose values stand for the register."""


def hover(
    files: Files, file: MapText, line: int, column: int, compiled: RegisterMap | None
) -> tuple[SourcePlace, str] | None:
    """The place of what stands at a position, and what is said of it in Markdown."""
    path, is_key = path_at(file.root, line, column)
    if path and is_key and (said := key_text(file, path)):
        parent = _node(file.root, path[:-1])
        return ((parent.keys or {})[str(path[-1])] if parent else SourcePlace(line, column, line, column)), said
    own = register_around(file, line, column) if path and path[-1] in OF_REGISTER else None
    if own and (said := register_text(file, own, compiled)):
        return (own.child(path[-1]) or own).place, said
    if found := named_at(files, file, line, column):
        place, one = found
        home = files.get(one.spot.file)
        if home is not None:
            said = register_text(home, one.node, compiled) if one.kind == REGISTER else ""
            told = condition_text(compiled, one.name) if one.kind == "condition" and compiled else ""
            return place, said or "\n\n".join(filter(None, (meaning(one, home), told)))
    return None


def _node(root: SourceNode, path: tuple[str | int, ...]) -> SourceNode | None:
    node: SourceNode | None = root
    for step in path:
        node = node.child(step) if node else None
    return node


def key_text(file: MapText, path: tuple[str | int, ...]) -> str:
    """What the schema says of the key that ends a path; empty for a key that the map itself chose."""
    above = grammar.at(file.root, path[:-1])
    if not any(path[-1] in schema.get("properties", {}) for schema in above):
        return ""
    return grammar.about(grammar.described(above, str(path[-1])))


def register_text(file: MapText, node: SourceNode, compiled: RegisterMap | None) -> str:
    """All about a register as it compiles; empty if it does not, or has no place of its own in a driver."""
    if compiled is None:
        return ""
    own = declared_at(file.path, node, REGISTER)
    found = found_at(compiled, own.spot.place.span(display_name(file.path)))
    return facts(compiled, *found) if found else ""
