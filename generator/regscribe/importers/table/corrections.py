"""Cells that the user corrects: by the name of the row and the heading of the column, or by their place."""

import re
from collections.abc import Sequence
from dataclasses import replace
from difflib import get_close_matches

from regscribe.importers.table.columns import Column
from regscribe.importers.table.grid import Grid, TableError, number_of
from regscribe.importers.table.header import Header
from regscribe.importers.table.headings import fold

BY_PLACE = re.compile(r"\s*([A-Za-z]{1,3})([1-9][0-9]{0,6})\s*=(.*)", re.DOTALL)
BY_NAME = re.compile(r"\s*(.*\S)\s*/\s*([^=/]*[^=/\s])\s*=(.*)", re.DOTALL)


BY_USER = ", as you said"
"""Ends what is stated of a cell."""


def corrected(grid: Grid, header: Header, columns: Sequence[Column], text: str) -> Grid:
    """Return the grid with one cell corrected, which is stated. Raises TableError where it is not there."""
    if found := BY_PLACE.fullmatch(text):
        return _by_place(grid, text, *found.groups())
    if found := BY_NAME.fullmatch(text):
        return _by_name(grid, header, columns, text, *found.groups())
    message = f"--cell {text}: write NAME / HEADING = TEXT, or B7 = TEXT"
    raise TableError(message)


def _by_place(grid: Grid, text: str, column: str, line: str, new: str) -> Grid:
    at = number_of(column)
    rows = [index for index, row in enumerate(grid.rows) if row.line == int(line)]
    index = -1 if at is None or not rows else at - grid.rows[rows[0]].first
    if not 0 <= index < grid.width:
        message = f"--cell {text}: the table has no such cell"
        raise TableError(message)
    return _set(grid, rows, index, new, f"cell {column.upper()}{line}")


def _by_name(
    grid: Grid, header: Header, columns: Sequence[Column], text: str, name: str, heading: str, new: str
) -> Grid:
    headings = {fold(column.heading): column for column in columns if column.heading}
    if fold(heading) not in headings:
        known = {key: column.heading for key, column in headings.items()}
        message = f"--cell {text}: the table has no column `{heading}`{_near(fold(heading), known)}"
        raise TableError(message)
    column = headings[fold(heading)]
    named = next((one.index for one in columns if one.role == "name"), -1)
    names = {index: fold(row.cell(named)) for index, row in enumerate(grid.rows) if index > header.last}
    rows = [index for index, own in names.items() if own == fold(name)]
    if not rows:
        known = {own: grid.rows[index].cell(named) for index, own in names.items() if own}
        message = f"--cell {text}: no row is called `{name}`{_near(fold(name), known)}"
        raise TableError(message)
    return _set(grid, rows, column.index, new, f"cell {column.heading} of `{name}`")


def _near(text: str, known: dict[str, str]) -> str:
    found = get_close_matches(text, known, n=1, cutoff=0.4)
    return f"; did you mean `{' '.join(known[found[0]].split())}`?" if found else ""


def _set(grid: Grid, rows: Sequence[int], column: int, new: str, called: str) -> Grid:
    changed = list(grid.rows)
    for index in rows:
        cells = [*changed[index].cells, *[""] * (column + 1 - len(changed[index].cells))]
        cells[column] = new.strip()
        changed[index] = replace(changed[index], cells=tuple(cells), repeated=changed[index].repeated - {column})
    stated = f"{called} is read as `{new.strip()}`{BY_USER}"
    return replace(grid, rows=tuple(changed), stated=(*grid.stated, stated))
