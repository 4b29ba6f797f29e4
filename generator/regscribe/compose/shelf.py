"""The other files of a map: found by id in the same `maps` folder, read once, checked for their shape."""

import hashlib
import os
from dataclasses import dataclass, field
from pathlib import Path

from regscribe import schema, source
from regscribe.compose.findings import Findings, meant
from regscribe.compose.rules import NO_FILE, OTHER_ID, WRONG_FILE
from regscribe.compose.tree import in_file, key_place, text
from regscribe.source import Document, Node

MAP, LIBRARY = "map", "library"
ENDINGS = {MAP: ".yaml", LIBRARY: ".library.yaml"}
"""How the files of both kinds end; the kind is also the top-level key that tells them apart."""


@dataclass(frozen=True, slots=True)
class File:
    """One file as read: its tree, in which each place knows the file, its id and its path."""

    id: str
    path: Path
    root: Node


@dataclass(slots=True)
class Shelf:
    """The folder that ids are looked up in, and what was read from it: the SHA-256 of each file by path."""

    folder: Path
    findings: Findings
    hashes: dict[Path, str] = field(default_factory=dict)
    known: dict[Path, File | None] = field(default_factory=dict)

    def find(self, node: Node, kind: str) -> File | None:
        """The map or library whose id stands at `node`; None, with the reason among the findings, if there is none."""
        path = self.folder / f"{node.value}{ENDINGS[kind]}"
        if not os.path.isfile(path):  # noqa: PTH113 - Path.is_file raises where a folder may not be read
            where = source.display_name(path)
            advice = meant(str(node.value), self._ids(kind))
            self.findings.add(NO_FILE, f"there is no {kind} `{node.value}`: no file {where}", node.place, advice)
            return None
        if path not in self.known:
            self.known[path] = self._read(path, node, kind)
        return self.known[path]

    def _read(self, path: Path, node: Node, kind: str) -> File | None:
        document, found = source.load(path)
        if document is not None:
            self.hashes[path] = document.content_hash
            found = schema.validate(document)
        if document is None or found:
            self.findings.diagnostics += found
            return None
        return self._checked(document, path, node, kind)

    def _checked(self, document: Document, path: Path, node: Node, kind: str) -> File | None:
        root = in_file(document.root, document.name)
        if kind not in document.data:
            other = next(each for each in ENDINGS if each != kind)
            message = f"`{node.value}` is a {other}, a {kind} is needed here"
            advice = "name it under `uses`" if other == LIBRARY else "name it under `extends`"
            self.findings.add(WRONG_FILE, message, node.place, advice, (f"the {other}", key_place(root, other)))
            return None
        own = root.child(kind)
        called = own.child("id") if own else None
        if called is not None and called.value != node.value:
            message = f"the file of `{node.value}` calls itself `{called.value}`"
            advice = "correct the id in it, or the name of the file"
            self.findings.add(OTHER_ID, message, node.place, advice, ("it says so here", called.place))
            return None
        return File(text(called), path, root)

    def _ids(self, kind: str) -> list[str]:
        """The ids of all files of a kind in the folder."""
        paths = sorted(self.folder.glob(f"*/*{ENDINGS[kind]}"))
        names = [path.relative_to(self.folder).as_posix() for path in paths]
        return [
            name.removesuffix(ENDINGS[kind]) for name in names if kind == LIBRARY or not name.endswith(ENDINGS[LIBRARY])
        ]

    def content_hash(self, own: str) -> str:
        """One hash for a file and all others that were read for it."""
        return hashlib.sha256("\n".join((own, *self.hashes.values())).encode()).hexdigest()


def folder_of(path: Path, map_id: str) -> Path:
    """The folder that ids count from: the one above maker/family.yaml, else the folder of the file itself."""
    parts = Path(map_id).parts
    for place in (path, path.absolute()):
        named = (*place.parts[:-1], place.name.removesuffix(ENDINGS[MAP]))
        if named[-len(parts) :] == parts and len(place.parents) >= len(parts):
            return place.parents[len(parts) - 1]
    return path.parent
