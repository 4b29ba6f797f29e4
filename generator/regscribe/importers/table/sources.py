"""Files of all kinds to grids, cut to the part that is to be read."""

from collections.abc import Sequence
from dataclasses import replace

from regscribe.importers.table.archive import is_workbook
from regscribe.importers.table.choices import Choices
from regscribe.importers.table.delimited import read as read_text
from regscribe.importers.table.grid import ALL_LINES, Grid, Row, TableError
from regscribe.importers.table.sheet_structure import Area

PDF = b"%PDF-"
SAMPLE = 8192
"""Bytes of a text that are looked at to see whether it is a table."""


def is_pdf(data: bytes) -> bool:
    """Whether bytes are a PDF; some programs write a few before its mark."""
    return PDF in data[:1024]


def grids_of(data: bytes, name: str, choices: Choices) -> tuple[list[Grid], Sequence[str]]:
    """Read the tables of a file, with what is to be said of how. Raises TableError."""
    stated: Sequence[str] = ()
    lines = (choices.cells.top, choices.cells.bottom) if choices.cells is not None else ALL_LINES
    if is_workbook(data):
        from regscribe.importers.table.workbooks import read as read_workbook  # noqa: PLC0415 - openpyxl takes 200 ms

        grids, stated = read_workbook(data, name, choices.sheets, lines)
        stated = [*stated, *(text for grid in grids for text in grid.stated)]
    elif is_pdf(data):
        from regscribe.importers.table.pdf_tables import read as read_pdf  # noqa: PLC0415 - an extra

        grids, stated = read_pdf(data, name, choices.pages, choices.area, headless=choices.header == "none")
        stated = [*stated, *(text for grid in grids for text in grid.stated)]
    else:
        grids = [read_text(data, name, encoding=choices.encoding, delimiter=choices.delimiter, lines=lines)]
        stated = grids[0].stated
    if choices.cells is not None:
        grids = [cut(grid, choices.cells) for grid in grids]
    if not any(grid.rows for grid in grids):
        message = f"{name} has no rows" + (" in the range that is to be read" if choices.cells else ": it is empty")
        raise TableError(message)
    return grids, stated


def sample(data: bytes, name: str) -> Grid:
    """The first rows of a text, for a look at them. Raises TableError for what is no text."""
    head = data[:SAMPLE]
    whole = head if len(data) <= SAMPLE else head[: head.rfind(b"\n") + 1] or head
    return read_text(whole, name)


def cut(grid: Grid, area: Area) -> Grid:
    """The part of a grid that lies in an area of a sheet; of a text its lines and columns."""
    rows = [
        replace(
            row,
            cells=row.cells[area.left : area.right + 1],
            repeated=frozenset(at - area.left for at in row.repeated if area.left <= at <= area.right),
            first=row.first + area.left,
        )
        for row in grid.rows
        if area.top <= row.line <= area.bottom
    ]
    return replace(grid, rows=tuple(filter(_filled, rows)))


def _filled(row: Row) -> bool:
    return any(row.cells)
