"""The files of a map to one document: the map that it extends, the libraries that it uses, and itself.

`compose` takes a document whose shape is right and gives one whose shape is to be validated again: a plain map, in
which each value still knows the file that it stands in. A map that stands alone passes unchanged.
"""

from dataclasses import dataclass, replace
from pathlib import Path

from regscribe.compose.extend import extended
from regscribe.compose.file_loader import FileLoader, LoadedFile
from regscribe.compose.findings import ComposeFindings
from regscribe.compose.libraries import as_map, with_libraries
from regscribe.compose.rules import CYCLE, OTHER_ID, RULES
from regscribe.compose.tree import cut, elements, in_file, members, text
from regscribe.map_files import ENDINGS, LIBRARY, MAP, folder_of
from regscribe.model import Diagnostic, Override
from regscribe.source import Document, SourceNode

__all__ = ["RULES", "Composed", "as_map", "compose", "is_library", "misplaced"]

COMPOSING = ("extends", "uses", "renumber", "drop", "override")
"""Top-level keys that have done their work when a map is composed."""


DEEPEST = 16
"""Maps that may stand between a map and the one that all of them build on."""


@dataclass(frozen=True, slots=True)
class Composed:
    """The document of all files, None if there are diagnostics; what it was made of, with the SHA-256 of each file.

    `base` is where the map that it extends lies, `renumber` the chapters that have another number here, `libraries`
    are the documents of `uses`. `shipped` are the ids of those files that come with regscribe. `empty` are the paths
    where a file would have counted before one of `files`, had there been one.
    """

    document: Document | None
    diagnostics: tuple[Diagnostic, ...] = ()
    extends: str = ""
    uses: tuple[str, ...] = ()
    overrides: tuple[Override, ...] = ()
    files: tuple[tuple[Path, str], ...] = ()
    empty: tuple[Path, ...] = ()
    base: Path | None = None
    renumber: tuple[tuple[str, str], ...] = ()
    libraries: tuple[Document, ...] = ()
    shipped: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class _Part:
    """A map of the chain as far as it is composed, where it lies, and the libraries in it."""

    root: SourceNode
    path: Path
    libraries: tuple[LoadedFile, ...] = ()
    overrides: tuple[Override, ...] = ()
    base: Path | None = None


def is_library(document: Document) -> bool:
    """Whether the file is a library and no map."""
    return isinstance(document.data, dict) and LIBRARY in document.data


def misplaced(library: Document, path: Path) -> list[Diagnostic]:
    """What is wrong with the name of a library's file: no map finds it under another than its id."""
    name = str(library.data[LIBRARY]["id"]).rpartition("/")[2] + ENDINGS[LIBRARY]
    if path.name == name:
        return []
    message = f"the library `{library.data[LIBRARY]['id']}` stands in {path.name}, where no map finds it"
    return [Diagnostic(OTHER_ID, message, library.span((LIBRARY, "id")), f"call the file {name}, or correct the id")]


def compose(document: Document, path: Path) -> Composed:
    """The map of `document`, which lies at `path`, with all that it builds on."""
    root = document.root
    null = any(command.value is None for command in ((root.child("commands") or root).members or {}).values())
    if is_library(document) or not (null or any(root.child(key) for key in COMPOSING)):
        return Composed(document)
    findings = ComposeFindings()
    root = in_file(root, document.name)
    about = root.child(MAP) or root
    own = LoadedFile(text(about.child("id")), path, root)
    shelf = FileLoader(folder_of(path, own.id), findings)
    part = _build(own, shelf, (own,))
    files = tuple(shelf.hashes.items())
    if part is None or findings.diagnostics:
        return Composed(None, tuple(sorted(findings.diagnostics, key=lambda found: found.span)), files=files)
    content_hash = shelf.content_hash(document.content_hash) if files else document.content_hash
    whole = replace(document, data=part.root.value, root=part.root, content_hash=content_hash)
    return Composed(
        whole,
        extends=text(root.child("extends")),
        uses=tuple(library.id for library in part.libraries),
        overrides=part.overrides,
        files=files,
        empty=tuple(sorted(shelf.empty)),
        base=part.base,
        renumber=tuple((old, text(new)) for old, new in members(root.child("renumber")).items()),
        libraries=tuple(_document(library, shelf) for library in part.libraries),
        shipped=tuple(file.id for file in shelf.known.values() if file is not None and file.shipped),
    )


def _document(library: LoadedFile, shelf: FileLoader) -> Document:
    return Document(library.path.name, "", library.root.value, shelf.hashes[library.path], library.root)


def _build(file: LoadedFile, shelf: FileLoader, chain: tuple[LoadedFile, ...]) -> _Part | None:
    """Compose one map of a chain of extensions, the deepest first; None if something that it needs is missing."""
    base = _base(file, shelf, chain)
    known = base.libraries if base else ()
    names = {library.id for library in known}
    wanted = [node for node in elements(file.root.child("uses")) if text(node) not in names]
    libraries = [shelf.find(node, LIBRARY, file) for node in wanted]
    if (file.root.child("extends") and base is None) or None in libraries:
        return None
    found = [library for library in libraries if library is not None]
    own = with_libraries(file.root, found, shelf.findings)
    every = (*known, *found)
    if base is None:
        return _Part(_plain(own), file.path, every)
    root, overrides = extended(base.root, own, shelf.findings)
    return _Part(_plain(root), file.path, every, overrides, base.path)


def _base(file: LoadedFile, shelf: FileLoader, chain: tuple[LoadedFile, ...]) -> _Part | None:
    node = file.root.child("extends")
    found = shelf.find(node, MAP, file) if node else None
    if node is None or found is None:
        return None
    if len(chain) > DEEPEST or any(found.path.resolve() == each.path.resolve() for each in chain):
        _refuse_cycle(found, shelf, chain)
        return None
    return _build(found, shelf, (*chain, found))


def _refuse_cycle(found: LoadedFile, shelf: FileLoader, chain: tuple[LoadedFile, ...]) -> None:
    """Report the circle at the map that is compiled, with each further step of it."""
    names = " -> ".join([*(each.id for each in chain), found.id])
    steps = [(each.id, each.root.child("extends") or each.root) for each in chain]
    others = [(f"`{name}` extends `{text(step)}`", step.place) for name, step in steps[1:]]
    shelf.findings.add(
        CYCLE, f"maps extend each other, or too many: {names}", steps[0][1].place, "let one stand alone", *others
    )


def _plain(root: SourceNode) -> SourceNode:
    for key in COMPOSING:
        root = cut(root, key) if root.child(key) is not None else root
    return root
