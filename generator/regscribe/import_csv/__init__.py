"""The importer of CSV: a table of registers, in the columns of the export, becomes the groups of a new map.

A cell that states a plain value becomes a key. Any other (a scale under a condition, a limit in words) is left out
and reported, never guessed.
"""

import re
from collections.abc import Sequence
from typing import Any

from regscribe.emit.words import one_line
from regscribe.evidence.columns import choose
from regscribe.evidence.table import TableError
from regscribe.evidence.table import read as read_table
from regscribe.files import OneLine, dump
from regscribe.import_csv.further import more
from regscribe.import_csv.keys import KEYS, Cells
from regscribe.model import Diagnostic, Severity, Span
from regscribe.model.identifiers import snake

name = "csv"
summary = "a table of registers in the columns of the export"

PASSED_OVER = frozenset({"map", "model", "id", "words", "group", "unit_id", "more"})
"""Columns that follow from the place of a register, from other columns, or are read apart."""

NO_REGISTERS = {"command": "commands", "computed": "computed values"}
"""Kinds of rows that are no registers, in words."""

MOST_TEXT = 60
"""Characters of a cell that are shown."""

IDS = re.compile(r"[a-z][a-z0-9_]{0,79}")


Row = tuple[int, Cells]
"""The line of a row, and its cells by column."""

LeftOut = dict[str, list[int]]
"""What is left out, each with the lines of its rows."""


def read(data: bytes, name: str) -> tuple[str, tuple[Diagnostic, ...]]:
    """Return models and groups as YAML, and what was left out; an error where the table is none."""
    left: LeftOut = {}
    try:
        text = dump(_body(_rows(data, name), name, left))
    except (TableError, ValueError) as error:
        return "", (_diagnostic(str(error), Span(name), Severity.ERROR),)
    counts = {what: "1 row" if len(lines) == 1 else f"{len(lines)} rows" for what, lines in left.items()}
    return text, tuple(
        _diagnostic(f"left out: {what} ({counts[what]})", Span(name, lines[0]), Severity.WARNING)
        for what, lines in left.items()
    )


def _diagnostic(message: str, span: Span, severity: Severity) -> Diagnostic:
    return Diagnostic(name, message, span, severity=severity)


def _rows(data: bytes, file: str) -> list[Row]:
    """Read the table. Raises TableError where registers cannot be made of it."""
    table = read_table(data, file)
    columns = choose(table, (), ())
    if missing := {"address", "name", "access"} - columns.at.keys():
        lacking = f"{file} has no column {', '.join(sorted(missing))}"
        message = f"{lacking}: a register needs an address, a name and its access"
        raise TableError(message)
    return [(row.line, {column: row.cells[at].strip() for column, at in columns.at.items()}) for row in table.rows]


def _body(rows: Sequence[Row], file: str, left: LeftOut) -> dict[str, Any]:
    """Return the map without its head: rows that differ in their model alone are one register of several models."""
    models = dict.fromkeys(map(_model, (cells for _, cells in rows)))
    groups: dict[tuple[str, str], dict[str, dict[str, Any]]] = {}
    having: dict[tuple[tuple[str, str], str], dict[str, None]] = {}
    for line, cells in rows:
        if cells.get("kind") in NO_REGISTERS:
            left.setdefault(NO_REGISTERS[cells["kind"]], []).append(line)
            continue
        group = cells.get("group", "") or "Registers", cells.get("unit_id", "")
        register = _register(line, cells, file, left)
        groups.setdefault(group, {})[repr(register)] = register
        having.setdefault((group, repr(register)), {})[_model(cells)] = None
    for (group, key), some in having.items():
        if len(some) < len(models):
            groups[group][key]["models"] = list(some)
    return {
        "models": {model: OneLine() for model in models},
        "groups": [
            {"id": _id(group), "name": group}
            | ({"unit_id": int(unit)} if unit.isdecimal() else {})
            | {"registers": [OneLine(one) for one in registers.values()]}
            for (group, unit), registers in groups.items()
        ],
    }


def _model(cells: Cells) -> str:
    return cells.get("model", "") or "Basic"


def _id(group: str) -> str:
    found = snake(group)
    return found if IDS.fullmatch(found) else f"group_{found}"


def _register(line: int, cells: Cells, file: str, left: LeftOut) -> dict[str, Any]:
    if not re.fullmatch(r"[0-9]{1,5}", cells["address"]) or not cells["name"]:
        message = f"{file}:{line}: a row needs a decimal address and a name, for example 40,Setpoint"
        raise ValueError(message)
    register: dict[str, Any] = {"at": int(cells["address"]), "name": cells["name"]}
    if IDS.fullmatch(cells.get("id", "")) and cells["id"] != snake(cells["name"]):
        register["id"] = cells["id"]
    for column, text in cells.items():
        if column in PASSED_OVER or not text.strip("{}"):
            continue
        keys = KEYS[column](cells) if column in KEYS else None
        if keys is None:
            left.setdefault(f"{column} `{one_line(text)[:MOST_TEXT]}`", []).append(line)
        else:
            register |= keys
    keys, in_words = more(cells.get("more", ""))
    for key, value in in_words.items():
        left.setdefault(f"{key} `{one_line(str(value))[:MOST_TEXT]}`", []).append(line)
    return register | keys
