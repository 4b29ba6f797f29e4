"""Finds the columns of the export in the header of a table; docs/evidence.md lists their other names."""

import re
from collections.abc import Sequence
from difflib import get_close_matches
from typing import NamedTuple

from regscribe.evidence.table import Table, TableError
from regscribe.export.csv import COLUMNS

SYNONYMS = {
    "models": "model",
    "path": "id",
    "parameter": "name",
    "wire_address": "address",
    "addr": "address",
    "alias": "aliases",
    "rw": "access",
    "r_w": "access",
    "units": "unit",
    "min": "minimum",
    "max": "maximum",
    "factory_default": "default",
    "enum": "values",
    "flags": "bits",
    "source": "section",
}
"""Other names that a header may use, folded (see `fold`), with the column of the export that they mean."""

KEYS = ("map", "model", "space", "address", "id", "kind")
"""Columns that tell which register a row is about."""

PLACES = frozenset({"map", "model"})
"""Columns that are equal in every pair of matched rows, so there is nothing to compare."""


class Columns(NamedTuple):
    """The columns in use of a table: index in its rows by name of the export, and the names of those to compare."""

    at: dict[str, int]
    compared: tuple[str, ...]


def fold(name: str) -> str:
    """Return a header in lower case, every run of other characters than letters and digits as `_`."""
    return re.sub(r"\W+|_+", "_", name.casefold()).strip("_")


def choose(table: Table, wanted: Sequence[str], notations: Sequence[str]) -> Columns:
    """Find the columns of the export in the header of a table; `notations` are further ways to write the address.

    `wanted` names the columns to compare, `name` or `name=header` where the table calls it otherwise; none: all that
    the table has, and then every header must be known. Raises TableError for unknown, missing or doubled columns.
    """
    known = _known(notations)
    if not wanted and known.keys().isdisjoint(map(fold, table.header)):
        heads = ", ".join(f"`{head[:40]}`" for head in table.header[:6])
        message = (
            f"{table.name}: none of {heads} is the name of a column: the first line must name the columns, for example "
            f"address,name,access; known are {', '.join(COLUMNS)}"
        )
        raise TableError(message)
    requested = _requested(wanted, known)
    at = _places(table, requested, known)
    if missing := [f"`{head}`" for name, head in requested.items() if name not in at]:
        message = f"{table.name} has no column {', '.join(missing)}: it has {', '.join(dict.fromkeys(table.header))}"
        raise TableError(message)
    compared = tuple(name for name in (requested or at) if name not in PLACES)
    return Columns(at, compared)


def _known(notations: Sequence[str]) -> dict[str, str]:
    """The names that a header may use, folded, with the columns that they mean."""
    known = {fold(name): fold(name) for name in (*COLUMNS, *notations)}
    known |= {f"{fold(name)}_address": fold(name) for name in notations}
    return known | {name: column for name, column in SYNONYMS.items() if name not in known}


def _requested(wanted: Sequence[str], known: dict[str, str]) -> dict[str, str]:
    """The columns that are asked for, each with its header in the table."""
    requested: dict[str, str] = {}
    for item in wanted:
        name, _, head = map(str.strip, item.partition("="))
        if fold(name) not in known:
            message = f"there is no column `{name}`{_meant(name, known)}"
            raise TableError(message)
        requested[known[fold(name)]] = head or name
    return requested


def _places(table: Table, requested: dict[str, str], known: dict[str, str]) -> dict[str, int]:
    """Index of each column in use; without `requested`, every header that has something below it must be known."""
    at: dict[str, int] = {}
    for index, head in enumerate(table.header):
        name = _name_of(head, requested, known)
        if name in at:
            message = f"{table.name}: `{table.header[at[name]]}` and `{head}` both are the column `{name}`: drop one"
            raise TableError(message)
        if name:
            at[name] = index
        elif not requested and (head or any(row.cells[index].strip() for row in table.rows)):
            message = (
                f"{table.name}: there is no column `{head}`{_meant(head, known)}; choose the columns to compare with "
                f"--columns (name=header where the table calls it otherwise)"
            )
            if not head:
                column = f"{table.name}: column {index + 1}"
                message = f"{column} has no name in the header, but content: name it or choose with --columns"
            raise TableError(message)
    return at


def _name_of(head: str, requested: dict[str, str], known: dict[str, str]) -> str:
    """Return the column of the export that a header means; empty for one that is not used."""
    for name, wanted in requested.items():
        if fold(head) == fold(wanted):
            return name
    name = known.get(fold(head), "")
    if not requested:
        return name
    if name in requested and known.get(fold(requested[name])) == name:
        return name  # requested by another of its names
    return name if name in KEYS and name not in requested else ""


def _meant(name: str, known: dict[str, str]) -> str:
    near = get_close_matches(fold(name), known, n=1)
    return f"; did you mean `{near[0]}`?" if near else f"; there are {', '.join(dict.fromkeys(known.values()))}"
