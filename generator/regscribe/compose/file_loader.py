"""The other files of a map: found by id in its `maps` folder or among those shipped, read once, checked in shape."""

from dataclasses import dataclass, field
from pathlib import Path

from regscribe import schema, source
from regscribe.compose.findings import NO_FILE, OTHER_ID, WRONG_FILE, ComposeFindings
from regscribe.compose.numbering import Numbering
from regscribe.compose.tree import in_file, key_place, text
from regscribe.map_files import ENDINGS, LIBRARY, ids_in, is_file, shipped
from regscribe.source import Document, SourceNode


@dataclass(frozen=True, slots=True)
class LoadedFile:
    """One file as read: its tree, in which each place knows the file, its id and its path; whether it was shipped."""

    id: str
    path: Path
    root: SourceNode
    shipped: bool = False


@dataclass(slots=True)
class FileLoader:
    """The folders that ids are looked up in, and what was read from them: the SHA-256 of each file by path.

    `empty` are the paths at which a file was looked for in vain: one that appears there would count from then on.
    `folder` is that of the map itself, `unsaved` what an editor holds instead of files.
    What comes with regscribe is looked for after it, and knows nothing of it.
    """

    folder: Path
    findings: ComposeFindings
    numbering: Numbering
    unsaved: source.Texts = field(default_factory=dict)
    shipped: Path = field(default_factory=shipped)
    hashes: dict[Path, str] = field(default_factory=dict)
    empty: set[Path] = field(default_factory=set)
    known: dict[Path, LoadedFile | None] = field(default_factory=dict)

    def find(self, node: SourceNode, kind: str, asker: LoadedFile) -> LoadedFile | None:
        """The map or library whose id stands at `node`; None, with the reason among the findings, if there is none."""
        places = [self.shipped] if asker.shipped else [self.folder, self.shipped]
        paths = [folder / f"{node.value}{ENDINGS[kind]}" for folder in places]
        found = [path for path in paths if path in self.unsaved or is_file(path)]
        self.empty.update(paths[: paths.index(found[0])] if found else paths)
        if not found:
            where = source.display_name(paths[0])
            message = f"there is no {kind} `{node.value}`: no file {where}, and none comes with regscribe"
            self.findings.unknown(NO_FILE, message, node, ids_in(places, kind))
            return None
        path = found[0]
        if path not in self.known:
            self.known[path] = self._read(path, node, kind)
        return self.known[path]

    def _read(self, path: Path, node: SourceNode, kind: str) -> LoadedFile | None:
        document, found = source.load(path, unsaved=self.unsaved)
        if document is not None:
            self.hashes[path] = document.content_hash
            found = schema.validate(document)
        if document is None or found:
            self.findings.diagnostics += found
            return None
        return self._checked(document, path, node, kind)

    def _checked(self, document: Document, path: Path, node: SourceNode, kind: str) -> LoadedFile | None:
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
        shipped = path.is_relative_to(self.shipped) and self.folder.resolve() != self.shipped.resolve()
        return LoadedFile(text(called), path, self.numbering.on_the_wire(root), shipped)
