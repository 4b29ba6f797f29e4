"""The files of a map to one document: the map that it extends, the libraries that it uses, and itself.

`compose` takes a document whose shape is right and gives one whose shape is to be validated again: a plain map, in
which each value still knows the file that it stands in. A map that stands alone passes unchanged.
"""

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path

from regscribe.compose.extend import extended
from regscribe.compose.file_loader import FileLoader, LoadedFile
from regscribe.compose.findings import CYCLE, OTHER_ID, RULES, ComposeFindings
from regscribe.compose.libraries import as_map, left_out, with_libraries
from regscribe.compose.numbering import Numbering, writes_numbers
from regscribe.compose.tree import at, cut, elements, in_file, members, text
from regscribe.map_files import ENDINGS, LIBRARY, MAP, folder_of
from regscribe.model import Diagnostic, Override
from regscribe.source import Document, SourceNode, Texts

__all__ = ["RULES", "Composed", "as_map", "compose", "is_library", "misplaced"]

COMPOSING = ("extends", "uses", "renumber", "drop", "override")
"""Top-level keys that have done their work when a map is composed."""

DEEPEST = 16
"""Maps that may stand between a map and the one that all of them build on."""


@dataclass(frozen=True, slots=True)
class Composed:
    """The document of all files, None if there are diagnostics; what it was made of, with the SHA-256 of each file.

    `libraries` are the documents of `uses`. `shipped` are the ids of those files that come with regscribe. `empty` are
    the paths where a file would have counted before one of `files`, had there been one.
    """

    document: Document | None
    diagnostics: tuple[Diagnostic, ...] = ()
    extends: str = ""
    uses: tuple[str, ...] = ()
    overrides: tuple[Override, ...] = ()
    files: tuple[tuple[Path, str], ...] = ()
    empty: tuple[Path, ...] = ()
    libraries: tuple[Document, ...] = ()
    shipped: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class _Part:
    """A map of the chain as far as it is composed, and the libraries in it."""

    root: SourceNode
    libraries: tuple[LoadedFile, ...] = ()
    overrides: tuple[Override, ...] = ()


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


def compose(document: Document, path: Path, unsaved: Texts | None = None) -> Composed:
    """The map of `document`, which lies at `path`, with all that it builds on; `unsaved` as in `source.load`."""
    plain = members(document.root).keys().isdisjoint(COMPOSING) and not writes_numbers(document.root)
    if plain and not left_out(document.root):
        return Composed(document)
    findings = ComposeFindings()
    numbering = Numbering(findings, {})
    root = numbering.on_the_wire(in_file(document.root, document.name))
    own = LoadedFile(text(at(root, (MAP, "id"))), path, root)
    loader = FileLoader(folder_of(path, own.id), findings, numbering, unsaved or {})
    part = _build(own, loader, (own,))
    files = tuple(loader.hashes.items())
    if part is None or findings.diagnostics:
        return Composed(None, tuple(sorted(findings.diagnostics, key=lambda found: found.span)), files=files)
    part = replace(part, root=numbering.with_notations(part.root))
    hashes = "\n".join((document.content_hash, *loader.hashes.values()))
    content_hash = hashlib.sha256(hashes.encode()).hexdigest() if files else document.content_hash
    return Composed(
        replace(document, data=part.root.value, root=part.root, content_hash=content_hash),
        extends=text(root.child("extends")),
        uses=tuple(library.id for library in part.libraries),
        overrides=part.overrides,
        files=files,
        empty=tuple(sorted(loader.empty)),
        libraries=tuple(
            Document(one.path.name, "", one.root.value, loader.hashes[one.path], one.root) for one in part.libraries
        ),
        shipped=tuple(file.id for file in filter(None, loader.known.values()) if file.shipped),
    )


def _build(file: LoadedFile, loader: FileLoader, chain: tuple[LoadedFile, ...]) -> _Part | None:
    """Compose one map of a chain of extensions, the deepest first; None if something that it needs is missing."""
    base = _base(file, loader, chain)
    below = base.libraries if base else ()
    inherited = {library.id for library in below}
    uses = [node for node in elements(file.root.child("uses")) if text(node) not in inherited]
    libraries = [loader.find(node, LIBRARY, file) for node in uses]
    found = list(filter(None, libraries))
    if len(found) < len(libraries) or (file.root.child("extends") and base is None):
        return None
    own = with_libraries(file.root, found, loader.findings)
    every = (*below, *found)
    if base is None:
        return _Part(cut(own, *COMPOSING), every)
    root, overrides = extended(base.root, own, loader.findings)
    return _Part(cut(root, *COMPOSING), every, overrides)


def _base(file: LoadedFile, loader: FileLoader, chain: tuple[LoadedFile, ...]) -> _Part | None:
    """The map that one extends, composed; where maps extend each other, an error at the map that is compiled."""
    node = file.root.child("extends")
    found = loader.find(node, MAP, file) if node else None
    if found is None:
        return None
    if len(chain) <= DEEPEST and all(found.path.resolve() != each.path.resolve() for each in chain):
        return _build(found, loader, (*chain, found))
    names = " -> ".join([*(each.id for each in chain), found.id])
    steps = [(each.id, each.root.child("extends") or each.root) for each in chain]
    others = [(f"`{name}` extends `{text(step)}`", step.place) for name, step in steps[1:]]
    message = f"maps extend each other, or too many: {names}"
    loader.findings.add(CYCLE, message, steps[0][1].place, "let one stand alone", *others)
    return None
