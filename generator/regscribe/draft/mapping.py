"""The mapping file of an import: the options, rows to skip, corrections, and what the last import said.

What a person wrote in it stays byte for byte; what the last import said stands below a comment at its end.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from regscribe.draft.map_registers import MapRegister
from regscribe.draft.merge import restored
from regscribe.files import OneLine, dump, read, save

LANGUAGE = "import"
CODE = re.compile(r"-?[0-9]{1,20}")

MARK = "# What the last import said: `regscribe import --merge` compares the next list with it. Not to be edited."
"""Begins the part of the file that each import writes anew."""


@dataclass(frozen=True, slots=True)
class Row:
    """A row of the source, as a person names it: by its place in the report, its address and space, or its name."""

    row: str = ""
    at: int | None = None
    space: str = ""
    name: str = ""
    reason: str = ""
    set: Mapping[str, Any] = field(default_factory=dict)

    def __str__(self) -> str:
        """What a message calls it."""
        at = f"{self.space or 'holding'} {self.at}" if self.at is not None else ""
        return ", ".join(filter(None, (self.row, at, f"`{self.name}`" if self.name else "")))


@dataclass(frozen=True, slots=True)
class ImportMapping:
    """A mapping file as read; `own` is the text that a person may have written."""

    importer: str = ""
    options: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    skip: tuple[Row, ...] = ()
    fixes: tuple[Row, ...] = ()
    imported: tuple[MapRegister, ...] | None = None
    own: str = ""


def load(path: Path) -> ImportMapping:
    """Read a mapping file. Raises FileError with line and column of each mistake."""
    document = read(path, language=LANGUAGE, what="mapping of an import")
    data = document.data
    imported = data.get("imported")
    return ImportMapping(
        importer=data["importer"],
        options={name: _texts(value) for name, value in data.get("options", {}).items()},
        skip=tuple(_row(row) for row in data.get("skip", ())),
        fixes=tuple(_row(row) for row in data.get("fixes", ())),
        imported=None if imported is None else restored(imported),
        own=document.text.split(MARK)[0].rstrip() + "\n",
    )


def _texts(value: object) -> tuple[str, ...]:
    return tuple(map(str, value)) if isinstance(value, list) else (str(value),)


def _row(row: Mapping[str, Any]) -> Row:
    return Row(
        row=row.get("row", ""),
        at=row.get("at"),
        space=row.get("space", ""),
        name=row.get("name", ""),
        reason=row.get("reason", ""),
        set=_coded(row.get("set", {})),
    )


def _coded(value: Any) -> Any:  # noqa: ANN401 - plain values of YAML
    """The value with codes of enums and numbers of bits as numbers, not as the texts that a document has."""
    if isinstance(value, Mapping):
        return {int(key) if CODE.fullmatch(key) else key: _coded(inner) for key, inner in value.items()}
    return value


def begun(importer: str, source: str, options: Mapping[str, str]) -> str:
    """The text of a new mapping file; options with several values, one in each line, become lists."""
    lists = {name: text.split("\n") for name, text in options.items() if text}
    plain = {name: texts[0] if len(texts) == 1 else texts for name, texts in lists.items()}
    head: dict[str, Any] = {"format": 1, "importer": importer, "source": source}
    return dump({**head, **({"options": plain} if plain else {})})


def stored(path: Path, own: str, imported: Sequence[Mapping[str, Any]]) -> None:
    """Write a mapping file: what a person wrote, and below it what an import said. Raises FileError."""
    rows = [OneLine({**row, "register": _flat(row["register"])}) for row in imported]
    save(path, f"{own}\n{MARK}\n{dump({'imported': rows})}")


def _flat(value: Any) -> Any:  # noqa: ANN401 - plain values of YAML
    if isinstance(value, Mapping):
        return OneLine({key: _flat(inner) for key, inner in value.items()})
    return [_flat(inner) for inner in value] if isinstance(value, list) else value
