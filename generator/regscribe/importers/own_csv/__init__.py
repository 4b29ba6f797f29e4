"""The importer of CSV: a table of registers, in the columns of the export, becomes the groups of a new map.

A cell that states a plain value becomes a key. What is said in words only (a limit that depends) is left out and told;
a register whose scale is said so is raw, and one whose place, type, order or condition is, is left out.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from regscribe.draft import Draft, Entry, Remark, refused
from regscribe.draft.numbers import unscaled
from regscribe.emit.words import one_line
from regscribe.evidence.columns import choose
from regscribe.evidence.table import TableError
from regscribe.evidence.table import read as read_table
from regscribe.files import OneLine
from regscribe.importers.own_csv.further import NEEDED, SCALING, more
from regscribe.importers.own_csv.keys import KEYS, Cells
from regscribe.model import Span
from regscribe.model.identifiers import snake
from regscribe.plugins import Likeness, Option

name = "csv"
summary = "a table of registers in the columns of the export"
options: tuple[Option, ...] = ()

PASSED_OVER = frozenset({"map", "model", "id", "words", "group", "unit_id", "more"})
"""Columns that follow from the place of a register, from other columns, or are read apart."""

NO_REGISTERS = {"command": "a command", "computed": "a computed value"}
"""Kinds of rows that are no registers, in words."""

CRUCIAL = frozenset({"space", "type", "access", "kind", "bits", "file", "queue", "block", "page", "exists"}) | NEEDED
"""What says where a number stands, how, and when: without it the number would be a wrong one."""

MOST_TEXT = 60
"""Characters of a cell that are shown."""

IDS = re.compile(r"[a-z][a-z0-9_]{0,79}")

OWN = frozenset({"map", "model", "id", "address", "access", "kind", "views"})
"""Columns of the export that no other table has together."""

Row = tuple[int, Cells]
"""The line of a row, and its cells by column."""


def likeness(data: bytes, name: str) -> Likeness:  # noqa: ARG001 - the contract of importers
    """Surely the export, by the names of its columns."""
    head = data[:4096].partition(b"\n")[0].decode(errors="replace")
    cells = {cell.strip().strip('"').lower() for cell in re.split(r"[,;\t]", head.lstrip("\ufeff"))}
    return Likeness.SURE if cells >= OWN else Likeness.NO


def read(data: bytes, name: str, options: Mapping[str, str]) -> Draft:  # noqa: ARG001 - as above
    """Return the models and groups, and of each row what was left out; refused where the table is none."""
    try:
        rows = _rows(data, name)
        return _draft(rows, name)
    except (TableError, ValueError) as error:
        return refused(name, str(error), rule="csv")


def _rows(data: bytes, file: str) -> list[Row]:
    """Read the table. Raises TableError where registers cannot be made of it."""
    table = read_table(data, file)
    columns = choose(table, (), ())
    if missing := {"address", "name", "access"} - columns.at.keys():
        lacking = f"{file} has no column {', '.join(sorted(missing))}"
        message = f"{lacking}: a register needs an address, a name and its access"
        raise TableError(message)
    return [(row.line, {column: row.cells[at].strip() for column, at in columns.at.items()}) for row in table.rows]


def _draft(rows: Sequence[Row], file: str) -> Draft:
    """Return the draft: rows that differ in their model alone are one register of several models."""
    models = dict.fromkeys(map(_model, (cells for _, cells in rows)))
    units = {_group(cells): unit for _, cells in rows if (unit := cells.get("unit_id", "")).isdecimal()}
    entries: dict[tuple[str, str], Entry] = {}
    having: dict[tuple[str, str], dict[str, None]] = {}
    for line, cells in rows:
        entry = _entry(line, cells, file)
        key = entry.group, repr(entry.keys or line)
        entries.setdefault(key, entry)
        having.setdefault(key, {})[_model(cells)] = None
    return Draft(
        entries=tuple(_of_models(entry, having[key], len(models)) for key, entry in entries.items()),
        head={"models": {model: OneLine() for model in models}},
        groups={group: {"unit_id": int(unit)} for group, unit in units.items()},
    )


def _of_models(entry: Entry, models: Mapping[str, None], every: int) -> Entry:
    if entry.keys is None or len(models) == every:
        return entry
    return replace(entry, keys={**entry.keys, "models": list(models)})


def _model(cells: Cells) -> str:
    return cells.get("model", "") or "Basic"


def _group(cells: Cells) -> str:
    """The name of the group; registers at a unit id of their own are in one of their own."""
    unit = cells.get("unit_id", "")
    return (cells.get("group", "") or "Registers") + (f" at unit {unit}" if unit else "")


def _entry(line: int, cells: Cells, file: str) -> Entry:
    entry = Entry(name=cells["name"], place=Span(file, line, 1, line, 1), group=_group(cells))
    if cells.get("kind") in NO_REGISTERS:
        return replace(entry, remarks=(Remark(cells["kind"], f"{NO_REGISTERS[cells['kind']]} is not read back"),))
    if not re.fullmatch(r"[0-9]{1,5}", cells["address"]) or not cells["name"]:
        return replace(entry, remarks=(Remark("address-unclear", f"no decimal address: {_shown(cells['address'])}"),))
    keys, in_words = _register(cells)
    if wrong := CRUCIAL & in_words.keys():
        told = ", ".join(f"{column} {_shown(in_words[column])}" for column in sorted(wrong))
        return replace(entry, remarks=(Remark("place-unclear", f"the number hangs on what is in words: {told}"),))
    if "scale" in in_words or str(in_words.get("transmitted", "")).startswith(SCALING):
        keys = unscaled(keys)
    if "write" in in_words:
        keys["access"] = "r"
    return replace(entry, keys=keys, remarks=tuple(_left_out(*one) for one in in_words.items()))


def _register(cells: Cells) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the keys of a register, and the columns and further keys that say something in words only."""
    keys: dict[str, Any] = {"at": int(cells["address"]), "name": cells["name"]}
    in_words: dict[str, str] = {}
    if IDS.fullmatch(cells.get("id", "")) and cells["id"] != snake(cells["name"]):
        keys["id"] = cells["id"]
    for column, text in cells.items():
        if column in PASSED_OVER or not text.strip("{}"):
            continue
        found = KEYS[column](cells) if column in KEYS else None
        if found is None:
            in_words[column] = text
        else:
            keys |= found
    further, others = more(cells.get("more", ""))
    return keys | further, in_words | {key: str(value) for key, value in others.items()}


def _left_out(column: str, text: str) -> Remark:
    meant = {"scale": "; the number is raw", "write": "; read only here"}.get(column, "")
    return Remark(f"{column.replace('_', '-')}-in-words", f"left out: {column} {_shown(text)}{meant}", todo=True)


def _shown(text: str) -> str:
    return f"`{one_line(text)[:MOST_TEXT]}`"
