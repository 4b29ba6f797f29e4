"""What an editor has open, what was found in it, and the maps that it compiles to."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from regscribe.language_server.files import Files, MapText, folders
from regscribe.model import Diagnostic, RegisterMap
from regscribe.pipeline import Compiled, compile_map
from regscribe.source import display_name


@dataclass(slots=True)
class Session:
    """The open files, and for each its findings and the last map that it compiled to, with the text of that time.

    `found` are the findings by the file whose compilation found them. `rounds` count the changes of each open file.
    """

    files: Files = field(default_factory=Files)
    found: dict[Path, tuple[Diagnostic, ...]] = field(default_factory=dict)
    compiled: dict[Path, tuple[RegisterMap, str]] = field(default_factory=dict)
    rounds: dict[Path, int] = field(default_factory=dict)
    shown: set[Path] = field(default_factory=set)

    def set_text(self, path: Path, text: str) -> None:
        """Take the text that the editor holds of a file."""
        self.files.unsaved[path] = text
        self.rounds[path] = self.rounds.get(path, 0) + 1

    def close(self, path: Path) -> None:
        """Forget a file that the editor has closed: what is on the disk counts again."""
        self.files.unsaved.pop(path, None)
        self.rounds[path] = self.rounds.get(path, 0) + 1
        self.found.pop(path, None)
        self.compiled.pop(path, None)

    def touched_by(self, path: Path) -> list[Path]:
        """The open maps and libraries that a change of a file concerns: itself, and those that build on it."""
        return [
            one
            for one in self.files.unsaved
            if one == path or any(each.path == path for each in self.files.project(one))
        ]

    def snapshot(self) -> Mapping[Path, str]:
        """The texts of all open files, for a compilation beside the editor."""
        return dict(self.files.unsaved)

    def take(self, path: Path, compiled: Compiled, text: str) -> None:
        """Keep the result of a compilation."""
        self.found[path] = compiled.diagnostics
        if compiled.map is not None:
            self.compiled[path] = compiled.map, text

    def findings_in(self, path: Path) -> list[Diagnostic]:
        """What all compilations found in a file, each once."""
        own = display_name(path)
        every = (one for found in self.found.values() for one in found if one.span.file == own)
        return list({(one.rule, one.span, one.message): one for one in every}.values())

    def to_show(self) -> set[Path]:
        """The files that have findings, or had some when they were shown last."""
        named = {one.span.file for found in self.found.values() for one in found}
        known = {one.path for each in self.found for one in self.files.project(each)}
        return {path for path in known if display_name(path) in named} | self.shown | {*self.found}

    def map_of(self, path: Path, *, exactly: bool = False) -> RegisterMap | None:
        """The last map that a file compiled to, of a library that of one of its users; `exactly`: of its text now."""
        found = self.compiled.get(path)
        if found is None and not exactly:
            users = (one for one in self.compiled if any(each.path == path for each in self.files.project(one)))
            found = next((self.compiled[one] for one in users), None)
        if found is None or (exactly and found[1] != self.files.unsaved.get(path)):
            return None
        return found[0]

    def all_maps(self, path: Path) -> list[MapText]:
        """The open maps, and those that lie in the same folders as a file."""
        file = self.files.get(path)
        folder = folders(file)[0] if file else path.parent
        paths = {*self.files.unsaved, *folder.glob("*/*.yaml")}
        found = (self.files.get(one) for one in sorted(paths))
        return [one for one in found if one is not None and one.is_map]


def compile_text(path: Path, unsaved: Mapping[Path, str], file: MapText) -> Compiled:
    """Compile a file as the editor holds it; what is no map is empty."""
    return compile_map(path, unsaved) if file.is_map else Compiled(path, None)
