"""Backups as text: YAML that people read and compare line by line, checked against its JSON Schema when read."""

from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import Any

import yaml

from regscribe import schema, source
from regscribe.settings.saved import FORMAT, Backup, BackupError, Origin, Saved

MOST_ERRORS = 5
MOST_BYTES = 8_000_000
"""A backup of the largest device has 200 kB; a file beyond this is none."""

_HEAD = "# Settings of a device, written by regscribe; `regscribe restore` writes them back.\n"


class _Dumper(yaml.SafeDumper):
    """One setting a line, texts in quotes that a YAML 1.2 reader would take for something else."""

    def ignore_aliases(self, data: object) -> bool:  # noqa: ARG002 (pyyaml's signature)
        """No anchors: equal values stay readable."""
        return True


class _Line(dict[str, Any]):
    """A mapping that stands on one line."""


def _line(dumper: yaml.SafeDumper, data: _Line) -> yaml.Node:
    return dumper.represent_mapping("tag:yaml.org,2002:map", data.items(), flow_style=True)


def _text(dumper: yaml.SafeDumper, data: str) -> yaml.Node:
    plain = _stays_text(data)
    return dumper.represent_scalar("tag:yaml.org,2002:str", data, style=None if plain else '"')


def _stays_text(data: str) -> bool:
    try:
        return isinstance(source.resolve(data), str)
    except source.NumberFormError:
        return False


_Dumper.add_representer(_Line, _line)
_Dumper.add_representer(str, _text)


def to_text(backup: Backup) -> str:
    """A backup as YAML."""
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
    data = {"format": FORMAT, "backup": head, "settings": settings}
    body: str = yaml.dump(data, Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=1 << 20)
    return _HEAD + body


def _entry(saved: Saved) -> _Line:
    entry = _Line()
    if saved.value is not None:
        entry["value"] = saved.value
    for key, value in (("unit", saved.unit), ("error", saved.error)):
        if value:
            entry[key] = value
    if saved.raw:
        entry["raw"] = list(saved.raw)
    if saved.stays:
        entry["stays"] = saved.stays
    return entry


def load(path: Path) -> Backup:
    """The backup in a file; BackupError says with line and column what is wrong with one that is none."""
    try:
        size = path.stat().st_size
    except OSError as error:
        message = f"{path} cannot be read: {error.strerror}"
        raise BackupError(message) from None
    if size > MOST_BYTES:
        message = f"{path} has {size} bytes: a backup has at most {MOST_BYTES}"
        raise BackupError(message)
    document, found = source.load(path)
    if document is not None:
        found = schema.validate(document, language="backup")
    if document is None or found:
        lines = [f"{one.span}: {one.message}{f' ({one.help})' if one.help else ''}" for one in found[:MOST_ERRORS]]
        more = [f"and {len(found) - MOST_ERRORS} more"] if len(found) > MOST_ERRORS else []
        raise BackupError("\n".join([f"{path} is no backup:", *lines, *more]))
    return _backup(document.data)


def _backup(data: Mapping[str, Any]) -> Backup:
    head = data["backup"]
    origin = Origin(
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
    return Saved(
        value=float(value) if isinstance(value, Decimal) else value,
        unit=entry.get("unit", ""),
        raw=tuple(entry.get("raw", ())),
        stays=entry.get("stays", ""),
        error=entry.get("error", ""),
    )
