"""A thing gets another name, wherever it is named; what would not compile any more is refused."""

import re
from collections.abc import Sequence
from pathlib import Path

from regscribe.language_server.files import Files, MapText
from regscribe.language_server.names import GROUP, REGISTER, TABLES, VIEW, Declaration, Names, names_of
from regscribe.language_server.navigation import references
from regscribe.map_files import shipped
from regscribe.model import Severity
from regscribe.pipeline import compile_map
from regscribe.schema import inline, schema_json
from regscribe.schema.schemas import exact
from regscribe.source import SourcePlace, shorten

Edit = tuple[SourcePlace, str]
PUBLIC = {REGISTER, GROUP, VIEW, "enum", "model", "given", "command", "computed", "program", "chain", "block"}
"""Kinds whose names stand in drivers."""


class RenameRefusedError(ValueError):
    """A name that cannot be given; the message says why."""


def renamed(
    files: Files, file: MapText, wanted: Declaration, new: str, every: Sequence[MapText]
) -> dict[Path, list[Edit]]:
    """The edits of all files that give a thing another name; raises RenameRefusedError."""
    affected = [one for one in every if any(each.path == wanted.spot.file for each in files.project(one.path))]
    affected = list({one.path: one for one in (file, *affected)}.values())
    _check_form(wanted, new)
    _check_place(wanted, file)
    for one in affected:
        _check_free(wanted, new, names_of(files.project(one.path)))
    edits: dict[Path, list[Edit]] = {wanted.spot.file: [_declared(files, wanted, new)]}
    for spot in references(files, file, wanted, affected):
        edits.setdefault(spot.file, []).append((spot.place, new))
    edits = {path: sorted(set(found)) for path, found in edits.items()}
    _check_result(files, affected, edits)
    return edits


def _check_form(wanted: Declaration, new: str) -> None:
    if wanted.kind in TABLES and wanted.kind != "notation":
        table = schema_json()["properties"][TABLES[wanted.kind]]
        fits = any(re.search(exact(one), new) for one in table["patternProperties"] if one != "^x-")
        form = table.get("x-key", {}).get("description", "")
    else:
        own = schema_json()["$defs"]["id"]
        fits, form = bool(re.search(exact(own["pattern"]), new)), own["description"]
    if (not fits and wanted.kind != "notation") or new.startswith("x-"):
        message = f"`{shorten(new)}` is no name of a {wanted.kind}: {form}"
        raise RenameRefusedError(message)


def _check_place(wanted: Declaration, file: MapText) -> None:
    if wanted.spot.file.is_relative_to(shipped()) and not file.path.is_relative_to(shipped()):
        message = f"`{wanted.name}` stands in a map that comes with regscribe, {wanted.spot.file.name}"
        raise RenameRefusedError(message)


def _check_free(wanted: Declaration, new: str, names: Names) -> None:
    """Refuse a name that a thing of the kind has beside it, in each place in which it is known."""
    tables = [names.of(wanted.kind), *(names.sets.values() if wanted.kind == REGISTER else ())]
    for table in tables:
        for name, one in table.items():
            other = f"{name.rpartition('.')[0]}.{new}".lstrip(".")
            if one.spot == wanted.spot and other in table:
                taken = table[other].spot
                message = f"there is a {wanted.kind} `{other}` already: {taken.file.name}:{taken.place.line + 1}"
                raise RenameRefusedError(message)


def _declared(files: Files, wanted: Declaration, new: str) -> Edit:
    """The edit of the declaration; a thing without an `id` gets one, before its `name`."""
    place = wanted.spot.place
    if not wanted.derived or wanted.kind not in {REGISTER, GROUP}:
        return place, new if wanted.kind in TABLES and wanted.kind != "notation" else inline(new)
    key = (wanted.node.keys or {})["name"]
    line = files.text_of(wanted.spot.file)
    before = line.split("\n")[key.line][: key.column] if line else ""
    flow = "{" in before or "," in before
    ending = ", " if flow else "\n" + " " * key.column
    return SourcePlace(key.line, key.column, key.line, key.column), f"id: {new}{ending}"


def apply(text: str, edits: Sequence[Edit]) -> str:
    """A text with edits, which do not overlap."""
    lines = text.split("\n")
    for place, new in sorted(edits, reverse=True):
        first, last = lines[place.line][: place.column], lines[place.end_line][place.end_column :]
        lines[place.line : place.end_line + 1] = [f"{first}{new}{last}"]
    return "\n".join(lines)


def _check_result(files: Files, affected: Sequence[MapText], edits: dict[Path, list[Edit]]) -> None:
    """Refuse what makes a map wrong that was right."""
    after = dict(files.unsaved) | {path: apply(files.text_of(path) or "", found) for path, found in edits.items()}
    for one in affected:
        if any(found.severity is Severity.ERROR for found in compile_map(one.path, dict(files.unsaved)).diagnostics):
            continue
        found = [each for each in compile_map(one.path, after).diagnostics if each.severity is Severity.ERROR]
        if found:
            message = f"the map would be wrong: {found[0].message} ({found[0].span})"
            raise RenameRefusedError(message)
