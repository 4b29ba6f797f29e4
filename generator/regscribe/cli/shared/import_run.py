"""The steps of an import: what a source and a mapping say becomes a draft, a text that passes `check`, and files."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from regscribe import files, plugins, source
from regscribe.cli.shared.failure import unwritten
from regscribe.cli.shared.import_source import check, check_at, id_for
from regscribe.cli.shared.map_heads import head_of
from regscribe.cli.shared.output_file import make_folder, save
from regscribe.draft import Draft, Outcome
from regscribe.draft.differences import Change, Note
from regscribe.draft.fixes import fixed
from regscribe.draft.mapping import ImportMapping, begun
from regscribe.draft.mapping import stored as store_mapping
from regscribe.draft.merge import merge, stored
from regscribe.draft.settle import settle
from regscribe.draft.text import Written
from regscribe.files import FileError
from regscribe.model import Diagnostic, Severity, Span
from regscribe.plugins import OptionError
from regscribe.source import Document

BYTE_ORDER_MARK = "\ufeff"

IMPORTED = "<import>"
"""What the text of a map is called that is no file yet."""

NOTHING = Written("", {})


@dataclass(slots=True)
class Run:
    """One import: what it was given, and what became of it; `text` is the map, None where nothing is to be written."""

    form: str
    name: str
    options: Mapping[str, str]
    mapping: ImportMapping
    mapping_path: Path | None
    draft: Draft = field(default_factory=Draft)
    found: tuple[Diagnostic, ...] = ()
    notes: tuple[Note, ...] = ()
    text: str | None = None
    written: Written = NOTHING

    def read(self, data: bytes) -> None:
        """Read the source and follow the mapping. Raises PluginError and OptionError."""
        draft = plugins.read(self.form, data, self.name, self.options)
        if not draft.failed:
            draft = fixed(draft, self.mapping.skip, self.mapping.fixes, str(self.mapping_path))
        self.draft, self.found = draft, draft.findings

    def settle(self, map_id: str | None, out: Path | None, *, merging: bool) -> None:
        """Make the text of the map. Raises OptionError and FileError where it cannot be written where it should."""
        if out is not None and out.exists() != merging:
            message = (
                f"{out} does not exist: leave --merge out for the first import"
                if merging
                else f"{out} exists; nothing was changed. Choose another name for the map, or --merge into it"
            )
            raise OptionError(message)
        if self.draft.failed:
            return
        head = head_of(map_id or id_for(self.draft, out, self.name), title=self.draft.title, maker=self.draft.maker)
        self.draft, written, checked = settle(self.draft, head, check)
        if not any(entry.keys is not None for entry in self.draft.entries):
            self.found = (*self.draft.findings, _nothing(self.name))
            return
        self.found = (*self.draft.findings, *_errors(checked))
        if self.draft.failed or len(self.found) > len(self.draft.findings):
            return
        self.written = written
        self.text = self._merged(out) if merging and out is not None else written.text

    def _merged(self, out: Path) -> str | None:
        """The text of the map with what the list changed; None where `check` refuses it."""
        if self.mapping.imported is None:
            message = (
                f"{self.mapping_path} does not say what the last import said: import the old list once more into a new "
                "map with --save-mapping, and merge with that mapping"
            )
            raise OptionError(message)
        raw = _raw(out)
        ours, wrong = source.load(out)
        if ours is None:
            self.found = (*self.found, *wrong)
            return None
        merged = merge(self.mapping.imported, _document(self.written.text), ours)
        checked = _errors(check_at(merged.text, out))
        self.notes, self.found = tuple(map(self._placed, merged.notes)), (*self.found, *checked)
        return None if checked else _like(merged.text, ours.text, raw, out)

    def _placed(self, note: Note) -> Note:
        """The note with the place in the source, where it is of a row that the map does not have yet."""
        owner = self.written.owners.get(note.place.line)
        return replace(note, place=owner.place) if note.place.file == IMPORTED and owner is not None else note

    def save_map(self, out: Path, *, merging: bool) -> None:
        """Write the map, a new file unless it is merged into. Raises Failure."""
        make_folder(out.parent)
        save(out, self.text or "", new=not merging)

    def save_mapping(self, path: Path, *, imported: bool) -> None:
        """Write the mapping, with what was imported if the map was written. Raises Failure."""
        own = self.mapping.own or begun(self.form, self.name, {**self.options, **self.draft.settings})
        if imported:
            with unwritten(files.UnwrittenError):
                store_mapping(path, own, stored(_document(self.written.text)))
        else:
            save(path, own)


def code_of(run: Run) -> int:
    """The exit code: 1 where something was left out, or kept as a person had it, or nothing could be imported."""
    failed = any(one.severity is Severity.ERROR for one in run.found)
    left_out = any(entry.outcome is Outcome.LEFT_OUT for entry in run.draft.each)
    return int(failed or left_out or any(note.change is Change.KEPT for note in run.notes))


def _nothing(name: str) -> Diagnostic:
    message = "no row of it became a register, so no map is written; the reasons stand with the rows"
    return Diagnostic("import/nothing", message, Span(name))


def _errors(found: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    return tuple(one for one in found if one.severity is Severity.ERROR)


def _document(text: str) -> Document:
    document, wrong = source.parse(text, name=IMPORTED)
    assert document is not None, wrong  # noqa: S101 - it passed `check`
    return document


def _raw(path: Path) -> str:
    """The text of a map with its own line ends and byte order mark. Raises FileError."""
    try:
        return path.read_bytes().decode()
    except OSError as error:
        message = f"{path} cannot be read: {error.strerror or error}"
        raise FileError(message) from None
    except UnicodeDecodeError:
        message = f"{path} is no UTF-8"
        raise FileError(message) from None


def _like(text: str, read: str, raw: str, path: Path) -> str:
    """The text with the byte order mark and the line ends that the file has. Raises FileError for mixed ones."""
    mark = BYTE_ORDER_MARK if raw.startswith(BYTE_ORDER_MARK) else ""
    for ends in ("\n", "\r\n", "\r"):
        if mark + read.replace("\n", ends) == raw:
            return mark + text.replace("\n", ends)
    message = f"{path} has line ends of different kinds: save it with one kind, and merge again"
    raise FileError(message)
