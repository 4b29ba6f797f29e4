"""Backups as text: YAML that people read and compare line by line, checked against its JSON Schema when read."""

from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

from regscribe import files
from regscribe.files import FileError, OneLine, dump, read
from regscribe.tools.settings.backup import FORMAT, Backup, BackupError, BackupOrigin, Saved

_HEAD = "Settings of a device, written by regscribe; `regscribe restore` writes them back."


def to_text(backup: Backup) -> str:
    """A backup as YAML; BackupError if parsing it would give another backup."""
    origin = backup.origin
    head = {
        "map": origin.map_id,
        "map_sha256": origin.map_sha256,
        "model": origin.model,
        "unit": origin.unit,
        "link": origin.link,
        "taken": origin.taken,
        "identification": {path: _entry(saved) for path, saved in origin.identification.items()},
    }
    settings = {
        group: {path: _entry(saved) for path, saved in members.items()} for group, members in backup.groups.items()
    }
    text = dump({"format": FORMAT, "backup": head, "settings": settings}, remarks=(_HEAD,))
    try:
        kept = _backup(files.parse(text, language="backup", what="backup").data)
    except FileError as error:
        message = f"the settings cannot be kept, because what was to be written cannot be read back: {error}"
        raise BackupError(message) from None
    if kept != backup:
        lost = [path for path, saved in backup.settings() if dict(kept.settings()).get(path) != saved]
        message = f"the settings cannot be kept: read back, {', '.join(lost) or 'the head'} would be something else"
        raise BackupError(message)
    return text


def _entry(saved: Saved) -> OneLine:
    given: dict[str, object] = {"unit": saved.unit, "error": saved.error, "raw": list(saved.raw), "stays": saved.stays}
    given["absent"] = dict(saved.absent)
    value = {} if saved.value is None else {"value": saved.value}
    return OneLine(value | {key: what for key, what in given.items() if what})


def save(path: Path, text: str) -> None:
    """Write the text of a backup, whole or not at all; BackupError where that fails (a full disk)."""
    try:
        files.save(path, text)
    except FileError as error:
        raise BackupError(str(error)) from None


def load(path: Path) -> Backup:
    """The backup in a file. Raises BackupError with line and column of each mistake."""
    try:
        return _backup(read(path, language="backup", what="backup").data)
    except FileError as error:
        raise BackupError(str(error)) from None


def _backup(data: Mapping[str, Any]) -> Backup:
    head = data["backup"]
    origin = BackupOrigin(
        map_id=head["map"],
        map_sha256=head["map_sha256"],
        model=head["model"],
        unit=head["unit"],
        link=head.get("link", ""),
        taken=head.get("taken", ""),
        identification={path: _saved(entry) for path, entry in (head.get("identification") or {}).items()},
    )
    groups = {
        group: {path: _saved(entry) for path, entry in (members or {}).items()}
        for group, members in (data["settings"] or {}).items()
    }
    return Backup(origin=origin, groups=groups)


def _saved(entry: Mapping[str, Any]) -> Saved:
    value = entry.get("value")
    value = float(value) if isinstance(value, Decimal) else value
    return Saved(**{**entry, "value": value, "raw": tuple(entry.get("raw", ()))})
