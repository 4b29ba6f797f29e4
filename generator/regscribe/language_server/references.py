"""Where names are used: found by walking a file and the schema side by side."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from regscribe.language_server import grammar
from regscribe.language_server.files import MapText, Spot
from regscribe.language_server.grammar import Schema
from regscribe.language_server.names import REGISTER, Declaration, Names, home_of, part_places
from regscribe.schema import schema_json
from regscribe.source import Path, SourceNode, SourcePlace

GIVEN = "given"
_GIVEN_PREFIX = f"{GIVEN}."


@dataclass(frozen=True, slots=True)
class Reference:
    """A name as it is used: of which kind the schema says it is, where it stands, and the path to there."""

    kind: str
    text: str
    place: SourcePlace
    path: Path


def references_in(file: MapText) -> tuple[Reference, ...]:
    """All names that a file uses; that there is something of the name is not said."""
    return tuple(_walk(file.root, grammar.parts(schema_json(), file.root.value), ()))


def _walk(node: SourceNode, schemas: Sequence[Schema], path: Path) -> Iterator[Reference]:
    if node.members is None and node.elements is None:
        kind = grammar.kind_named(schemas)
        if kind and isinstance(node.value, str | int) and not isinstance(node.value, bool):
            yield Reference(kind, str(node.value), node.place, path)
    kind = grammar.kind_of_keys(schemas)
    known = {key for schema in schemas for key in schema.get("properties", ())}
    inner = next((names for schema in schemas if isinstance(names := schema.get("x-names"), dict)), {})
    for key, child in (node.members or {}).items():
        own = (*path, key)
        if kind and key not in known and not key.startswith("x-") and node.keys:
            yield Reference(kind, key, node.keys[key], own)
        if key in inner:
            yield Reference(inner[key], str(child.value), child.place, own)
        elif not key.startswith("x-"):
            yield from _walk(child, grammar.step_into(schemas, key, child.value), own)
    for number, child in enumerate(node.elements or ()):
        yield from _walk(child, grammar.step_into(schemas, number, child.value), (*path, number))


def resolve(reference: Reference, file: MapText, names: Names) -> list[tuple[SourcePlace, Declaration]]:
    """What a name means: of a path each name in it that is declared, with its place."""
    place, text = reference.place, reference.text
    width = place.end_column - place.column if place.line == place.end_line else len(text)
    quoted = width == len(text) + 2
    if reference.kind == REGISTER and text.startswith(_GIVEN_PREFIX):
        found = names.find(GIVEN, text.removeprefix(_GIVEN_PREFIX))
        column = place.column + quoted + len(_GIVEN_PREFIX)
        return (
            [(SourcePlace(place.line, column, place.line, column + len(text) - len(_GIVEN_PREFIX)), found)]
            if found
            else []
        )
    if reference.kind == REGISTER:
        return _registers(reference, file, names, quoted=quoted)
    found = names.find(reference.kind, text)
    bare = SourcePlace(place.line, place.column + quoted, place.line, place.column + quoted + len(text))
    return [(bare, found)] if found else []


def _registers(
    reference: Reference, file: MapText, names: Names, *, quoted: bool
) -> list[tuple[SourcePlace, Declaration]]:
    inside, prefixes = home_of(file.root, reference.path)
    if reference.path[-2:-1] == ("except_ids",) or "except_ids" in reference.path:
        node: SourceNode | None = file.root
        for step in reference.path[: reference.path.index("except_ids")]:
            node = node.child(step) if node else None
        used = node.child("set") if node else None
        inside, prefixes = str(used.value) if used else "", ("",)
    known = names.registers(inside)
    parts = list(part_places(reference.place, reference.text, quoted=quoted))
    for prefix in prefixes:
        found, path = [], prefix
        for name, place in parts:
            if f"{path}{name}" not in known:
                break
            found.append((place, known[f"{path}{name}"]))
            path = f"{path}{name}."
        if found:
            return found
    return []


def uses_of(wanted: Declaration, project: Sequence[MapText], names: Names) -> Iterator[Spot]:
    """All places where a declared thing is named, without its declaration."""
    for file in project:
        for reference in references_in(file):
            if reference.kind != wanted.kind and not (wanted.kind == GIVEN and reference.kind == REGISTER):
                continue
            for place, found in resolve(reference, file, names):
                if found.spot == wanted.spot and found.kind == wanted.kind:
                    yield Spot(file.path, place)
