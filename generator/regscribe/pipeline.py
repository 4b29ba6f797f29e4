"""The phases in their order: source, schema, compose (and schema again, for the whole), lower, checks.

A phase reports all its errors; the next one runs only if there are none. Warnings stop nothing.
"""

import gc
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from regscribe import checks, compose, lower, schema, source
from regscribe.lower.rules import DEPENDS_ON_MAP
from regscribe.model import Diagnostic, RegisterMap, Related, Severity
from regscribe.source import Document


@dataclass(frozen=True, slots=True)
class Compiled:
    """What became of one file: the map, unless an error was found, and all that was found, in the file's order.

    There is no map of a library either. `files` are all files that the map was made of, its own first, each with the
    SHA-256 of its bytes; `empty` are paths where another file would have been taken, had there been one.
    """

    path: Path
    map: RegisterMap | None
    diagnostics: tuple[Diagnostic, ...] = ()
    files: tuple[tuple[Path, str], ...] = ()
    empty: tuple[Path, ...] = ()


def compile_map(path: Path) -> Compiled:
    """Read, validate, compose, lower and check the map at `path`; what is wrong is in the diagnostics."""
    with _undisturbed():
        document, found = source.load(path)
        if document is None or has_errors(found):
            return Compiled(path, None, _ordered(found))
        return _compile(document, path, found)


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Let no search for cycles walk the growing trees again and again: they have none, and nearly all of them stays."""
    searching = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if searching:
            gc.enable()


def _compile(document: Document, path: Path, found: list[Diagnostic]) -> Compiled:
    found = [*found, *schema.validate(document)]
    if has_errors(found):
        return Compiled(path, None, _ordered(found))
    if compose.is_library(document):
        return Compiled(path, None, _ordered([*found, *_check_library(document, path)]))
    composed = compose.compose(document, path)
    found = [*found, *composed.diagnostics]
    if composed.document is not None and composed.document is not document:
        found = [*found, *schema.validate(composed.document)]
    if composed.document is None or has_errors(found):
        return Compiled(path, None, _ordered(found))
    register_map, checked = _meaning(composed)
    found = [*found, *_told(checked, document)]
    files = ((path, document.content_hash), *composed.files)
    if register_map is None:
        return Compiled(path, None, _ordered(found))
    return Compiled(path, register_map, _ordered(found), files, composed.empty)


def _meaning(composed: compose.Composed) -> tuple[RegisterMap | None, list[Diagnostic]]:
    """Lower and check what was composed."""
    if composed.document is None:
        return None, []
    register_map, found = lower.lower(composed.document)
    if register_map is None or has_errors(found):
        return None, found
    if composed.files:
        origin = {"extends": composed.extends, "uses": composed.uses, "overrides": composed.overrides}
        register_map = replace(register_map, **origin)  # type: ignore[arg-type]  # three fields of three types
        libraries = tuple(lower.library_of(library) for library in composed.libraries)
        register_map = replace(register_map, libraries=libraries, shipped=composed.shipped)
    found = [*found, *checks.check(register_map)]
    return None if has_errors(found) else register_map, found


def _check_library(document: Document, path: Path) -> list[Diagnostic]:
    """Look at a library alone: what it refers to must be in it, but for what each map adds."""
    misplaced = compose.misplaced(document, path)
    _, found = lower.lower(compose.as_map(document))
    return [*misplaced, *(diagnostic for diagnostic in found if diagnostic.rule not in DEPENDS_ON_MAP)]


def _told(found: Iterable[Diagnostic], document: Document) -> Iterable[Diagnostic]:
    """Add to what is wrong in another file which map was being compiled."""
    for diagnostic in found:
        if diagnostic.span.file in {document.name, ""}:
            yield diagnostic
        else:
            here = Related("in this map, which builds on that file", document.span(("map", "id")))
            yield replace(diagnostic, related=(*diagnostic.related, here))


def has_errors(found: Iterable[Diagnostic]) -> bool:
    """Whether one of them is an error."""
    return any(diagnostic.severity is Severity.ERROR for diagnostic in found)


def _ordered(found: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(sorted(found, key=lambda diagnostic: (diagnostic.span, diagnostic.rule)))
