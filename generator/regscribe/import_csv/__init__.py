"""The importer of CSV: a table of registers, in the columns of the export, becomes the groups of a new map.

What a cell says outright becomes a key. What it says otherwise (a scale under a condition, a limit in words) is left
out and told, never guessed.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from regscribe.emit.words import one_line
from regscribe.evidence import TableError
from regscribe.evidence import read as read_table
from regscribe.evidence.columns import choose
from regscribe.files import OneLine, dump
from regscribe.import_csv.keys import KEYS, Cells
from regscribe.model import Diagnostic, Severity, Span
from regscribe.model.identifiers import snake

name = "csv"
summary = "a table of registers in the columns of the export"

PASSED_OVER = frozenset({"map", "model", "id", "words", "views", "group"})
"""Columns that are told by the place of a register, or that follow from others."""

MOST_TEXT = 60
"""Characters of a cell that are shown."""

IDS = re.compile(r"[a-z][a-z0-9_]{0,79}")


@dataclass(slots=True)
class _Left:
    """What is left out: what it is, and the lines where it stands."""

    file: str
    lines: dict[str, list[int]] = field(default_factory=dict)

    def findings(self) -> tuple[Diagnostic, ...]:
        return tuple(
            Diagnostic(
                name, f"left out: {what} ({_count(lines)})", Span(self.file, lines[0]), severity=Severity.WARNING
            )
            for what, lines in self.lines.items()
        )


def _count(lines: list[int]) -> str:
    return "1 row" if len(lines) == 1 else f"{len(lines)} rows"


def read(data: bytes, name: str) -> tuple[str, tuple[Diagnostic, ...]]:
    """Return models and groups as YAML, and what was left out; an error where the table is none."""
    try:
        table = read_table(data, name)
        columns = choose(table, (), ())
    except TableError as error:
        return "", (_error(str(error), Span(name)),)
    if missing := {"address", "name", "access"} - columns.names:
        message = (
            f"{name} has no column {', '.join(sorted(missing))}: a register needs an address, a name and its access"
        )
        return "", (_error(message, Span(name)),)
    left = _Left(name)
    rows = [(row.line, {column: row.cells[at].strip() for column, at in columns.at}) for row in table.rows]
    try:
        text = dump(_body(rows, left))
    except ValueError as error:
        return "", (_error(str(error), Span(name)),)
    return text, left.findings()


def _error(message: str, span: Span) -> Diagnostic:
    return Diagnostic(name, message, span)


def _body(rows: Sequence[tuple[int, Cells]], left: _Left) -> dict[str, Any]:
    """Return the map without its head: rows that differ in their model alone are one register of several models."""
    models = dict.fromkeys(map(_model, (cells for _, cells in rows)))
    groups: dict[str, dict[str, dict[str, Any]]] = {}
    having: dict[tuple[str, str], dict[str, None]] = {}
    for line, cells in rows:
        if cells.get("kind") == "command":
            left.lines.setdefault("commands", []).append(line)
            continue
        group, register = cells.get("group", "") or "Registers", _register(line, cells, left)
        groups.setdefault(group, {})[repr(register)] = register
        having.setdefault((group, repr(register)), {})[_model(cells)] = None
    for (group, key), some in having.items():
        if len(some) < len(models):
            groups[group][key]["models"] = list(some)
    return {
        "models": {model: OneLine() for model in models},
        "groups": [
            {"id": _id(group), "name": group, "registers": [OneLine(one) for one in registers.values()]}
            for group, registers in groups.items()
        ],
    }


def _model(cells: Cells) -> str:
    return cells.get("model", "") or "Basic"


def _id(group: str) -> str:
    found = snake(group)
    return found if IDS.fullmatch(found) else f"group_{found}"


def _register(line: int, cells: Cells, left: _Left) -> dict[str, Any]:
    if not re.fullmatch(r"[0-9]{1,5}", cells["address"]) or not cells["name"]:
        message = f"{left.file}:{line}: a row needs a decimal address and a name, for example 40,Setpoint"
        raise ValueError(message)
    register: dict[str, Any] = {"at": int(cells["address"]), "name": cells["name"]}
    if IDS.fullmatch(cells.get("id", "")) and cells["id"] != snake(cells["name"]):
        register["id"] = cells["id"]
    for column, text in cells.items():
        if column in PASSED_OVER or not text.strip("{}"):
            continue
        keys = KEYS[column](cells) if column in KEYS else None
        if keys is None:
            left.lines.setdefault(f"{column} `{one_line(text)[:MOST_TEXT]}`", []).append(line)
        else:
            register |= keys
    return register
