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
from regscribe.source import Document, Texts


@dataclass(frozen=True, slots=True)
class Compiled:
    """A compiled file: its map, None after an error and of a library, and all diagnostics in the file's order.

    `files` are all files that the map was made of, its own first, each with the SHA-256 of its bytes; `empty` are paths
    where a file would have been taken first, had there been one.
    """

    path: Path
    map: RegisterMap | None
    diagnostics: tuple[Diagnostic, ...] = ()
    files: tuple[tuple[Path, str], ...] = ()
    empty: tuple[Path, ...] = ()


def compile_map(path: Path, unsaved: Texts | None = None) -> Compiled:
    """Read, validate, compose, lower and check the map at `path`; what is wrong is in the diagnostics.

    `unsaved` are texts that count instead of files: of the map itself and of those that it builds on.
    """
    found: list[Diagnostic] = []
    with _without_garbage_collection():
        compiled = _compile(path, found, unsaved)
    return replace(compiled, diagnostics=tuple(sorted(found, key=lambda one: (one.span, one.rule))))


@contextmanager
def _without_garbage_collection() -> Iterator[None]:
    """Search for no cycles while trees grow: they have none, and nearly all of them stays."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


def _compile(path: Path, found: list[Diagnostic], unsaved: Texts | None) -> Compiled:
    """Run the phases one after the other, each of which adds to `found`; the result has no diagnostics yet."""
    without_map = Compiled(path, None)
    document, syntax = source.load(path, unsaved=unsaved)
    found += syntax
    if document is None or has_errors(found):
        return without_map
    found += schema.validate(document)
    if has_errors(found):
        return without_map
    if compose.is_library(document):
        found += _check_library(document, path)
        return without_map
    composed = compose.compose(document, path, unsaved)
    found += composed.diagnostics
    if composed.document is not None and composed.document is not document:
        found += schema.validate(composed.document)
    if composed.document is None or has_errors(found):
        return without_map
    register_map, checked = _lower_and_check(composed.document, composed)
    found += _with_origin(checked, document)
    if register_map is None:
        return without_map
    files = ((path, document.content_hash), *composed.files)
    return Compiled(path, register_map, files=files, empty=composed.empty)


def _lower_and_check(document: Document, composed: compose.Composed) -> tuple[RegisterMap | None, list[Diagnostic]]:
    register_map, found = lower.lower(document)
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
    """Check a library alone: what it refers to must be in it, except what each map adds."""
    alone, misread = compose.as_map(document)
    _, found = lower.lower(alone)
    found = [*misread, *(diagnostic for diagnostic in found if diagnostic.rule not in DEPENDS_ON_MAP)]
    return [*compose.misplaced(document, path), *found]


def _with_origin(found: Iterable[Diagnostic], document: Document) -> Iterable[Diagnostic]:
    """Add to diagnostics in other files which map was being compiled."""
    for diagnostic in found:
        if diagnostic.span.file in {document.name, ""}:
            yield diagnostic
        else:
            here = Related("in this map, which builds on that file", document.span(("map", "id")))
            yield replace(diagnostic, related=(*diagnostic.related, here))


def has_errors(found: Iterable[Diagnostic]) -> bool:
    """Whether one of them is an error."""
    return any(diagnostic.severity is Severity.ERROR for diagnostic in found)
