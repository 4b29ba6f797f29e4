"""The files of a map as they are while it is written: the map itself, and those that it builds on."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from regscribe.compose.tree import elements, text
from regscribe.language_server.tolerant import read
from regscribe.map_files import ENDINGS, IMPORT, LIBRARY, MAP, folder_of, is_file, kind_of, shipped
from regscribe.source import SourceNode, SourcePlace
from regscribe.source.utf8 import normalise

MOST_BYTES = 2_000_000
"""Larger files are not looked into: no map is."""


class Spot(NamedTuple):
    """A place in a file."""

    file: Path
    place: SourcePlace


class MapText(NamedTuple):
    """A file with its text and the tree of it."""

    path: Path
    text: str
    root: SourceNode

    @property
    def is_map(self) -> bool:
        """Whether it is a map or a library."""
        known = self.root.members or {}
        return (MAP in known or LIBRARY in known) and kind_of(self.path.name) != IMPORT

    @property
    def id(self) -> str:
        """The id of the map or library."""
        head = self.root.child(MAP) or self.root.child(LIBRARY)
        return text(head.child("id")) if head else ""


@dataclass(slots=True)
class Files:
    """Texts that an editor holds, and files; each text is read once."""

    unsaved: dict[Path, str] = field(default_factory=dict)
    read: dict[Path, MapText] = field(default_factory=dict)

    def text_of(self, path: Path) -> str | None:
        """The text of a file, with line feeds as its line ends; None if there is none."""
        if path in self.unsaved:
            return normalise(self.unsaved[path])
        try:
            if path.stat().st_size > MOST_BYTES:
                return None
            return normalise(path.read_bytes().decode("utf-8-sig", "replace"))
        except (OSError, ValueError):
            return None

    def get(self, path: Path) -> MapText | None:
        """A file with its tree, read anew if its text has changed."""
        found, known = self.text_of(path), self.read.get(path)
        if found is None:
            return None
        if known is None or known.text != found:
            known = self.read[path] = MapText(path, found, read(found))
        return known

    def project(self, path: Path) -> tuple[MapText, ...]:
        """A file and all that it builds on, as far as there is."""
        found: dict[Path, MapText] = {}
        waiting = [path]
        while waiting:
            own = self.get(waiting.pop())
            if own is None or own.path in found:
                continue
            found[own.path] = own
            waiting += [target for _, target in bases(own, self.unsaved)]
        return tuple(found.values())


def folders(own: MapText) -> tuple[Path, Path]:
    """The folders that ids in a file are looked up in."""
    return folder_of(own.path, own.id.removesuffix("/")) if own.id else own.path.parent.parent, shipped()


def bases(own: MapText, unsaved: Mapping[Path, str]) -> list[tuple[SourceNode, Path]]:
    """What a file extends and uses: where it says so, and the file."""
    extended = own.root.child("extends")
    named = [(extended, MAP)] if extended else []
    named += [(node, LIBRARY) for node in elements(own.root.child("uses"))]
    found = []
    for node, kind in named:
        paths = [folder / f"{node.value}{ENDINGS[kind]}" for folder in folders(own)]
        there = [path for path in paths if path in unsaved or is_file(path)]
        found += [(node, there[0])] if there else []
    return found
