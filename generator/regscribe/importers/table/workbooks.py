"""Workbooks (.xlsx): the values of their sheets as they were last calculated; nothing in them is ever evaluated."""

import datetime as dt
import io
import warnings
import zipfile
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING, Any

from regscribe.importers.table.archive import opened
from regscribe.importers.table.grid import ALL_LINES, Grid, Lines, Row, TableError, grid_of, letters
from regscribe.importers.table.sheet_findings import findings_of
from regscribe.importers.table.sheet_structure import Area, structure

if TYPE_CHECKING:
    from openpyxl.reader.excel import ExcelReader

UNVALUED = "=?"
"""What stands for a formula that was never calculated: no cell of a register, so nobody takes it for an empty one."""

ALL = "*"
"""The name that stands for all visible sheets."""


@dataclass(frozen=True, slots=True)
class Sheet:
    """A sheet of a workbook: its name, whether it is hidden, and the part of the archive that holds it."""

    name: str
    hidden: bool
    part: str


def read(data: bytes, name: str, wanted: Sequence[str] = (), lines: Lines = ALL_LINES) -> tuple[list[Grid], list[str]]:
    """Read the sheets that are wanted, by name or number, or all visible ones, and say which were passed over.

    Raises TableError for what is no workbook, is protected, or is beyond bounds, and for sheets that are not there.
    """
    with opened(data, name) as archive, _readable(name):
        from openpyxl.reader.excel import ExcelReader  # noqa: PLC0415 - 200 ms that only workbooks need

        reader = ExcelReader(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
        reader.read()
        sheets = _sheets(reader)
        chosen = _chosen(sheets, wanted, name)
        grids = [_grid(reader, archive, sheet, name, lines) for sheet in chosen]
    hidden = [sheet.name for sheet in sheets if sheet.hidden and sheet not in chosen]
    return grids, [f"sheet {sheet} is hidden and was not read; --sheet reads it" for sheet in hidden]


@contextmanager
def _readable(name: str) -> Iterator[None]:
    """Turn what a broken workbook makes the library raise into a TableError."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of styles and extensions, which are of no interest
            yield
    except TableError:
        raise
    except ImportError:
        message = "reading a workbook needs openpyxl: install regscribe anew, or save the sheet as CSV"
        raise TableError(message) from None
    except Exception as error:  # noqa: BLE001 - openpyxl raises whatever it stumbles upon
        what = f"{type(error).__name__}: {error}".split("\n")[0][:200]
        message = f"{name} is a broken workbook ({what}): open it and save it anew, or as CSV"
        raise TableError(message) from None


def _sheets(reader: "ExcelReader") -> list[Sheet]:
    return [
        Sheet(sheet.name, sheet.state != "visible", relation.target)
        for sheet, relation in reader.parser.find_sheets()
        if "chartsheet" not in relation.Type and relation.target in reader.valid_files
    ]


def _chosen(sheets: Sequence[Sheet], wanted: Sequence[str], name: str) -> list[Sheet]:
    visible = [sheet for sheet in sheets if not sheet.hidden]
    if not wanted or ALL in wanted:
        if not visible:
            message = f"{name} has no visible sheet; hidden are {_names(sheets) or 'none'}: choose with --sheet"
            raise TableError(message)
        return visible
    found = []
    for text in wanted:
        sheet = next((sheet for sheet in sheets if sheet.name.strip().casefold() == text.strip().casefold()), None)
        if sheet is None and text.isdecimal() and 1 <= int(text[:6]) <= len(sheets):
            sheet = sheets[int(text[:6]) - 1]
        if sheet is None:
            message = f"--sheet {text}: {name} has no such sheet; it has {_names(sheets)}"
            raise TableError(message)
        found.append(sheet)
    return list(dict.fromkeys(found))


def _names(sheets: Iterable[Sheet]) -> str:
    return ", ".join(f"`{sheet.name}`" for sheet in sheets)


def _grid(reader: "ExcelReader", archive: zipfile.ZipFile, sheet: Sheet, name: str, lines: Lines) -> Grid:
    with archive.open(sheet.part) as part:
        said = structure(part, sheet.name, name, lines)
    rows = _Filled(said.merged).rows(_rows(reader, sheet, frozenset(said.unvalued)))
    grid = grid_of(name, rows, lines=lines)
    return Grid(name, grid.rows, grid.stated, findings_of(grid, said, sheet.name))


def _rows(reader: "ExcelReader", sheet: Sheet, unvalued: frozenset[str]) -> Iterator[Row]:
    page = reader.wb[sheet.name]
    page.reset_dimensions()  # some programs write wrong ones, and rows beyond them would be lost
    for number, row in enumerate(page.iter_rows(), 1):
        cells = tuple("" if cell.value is None else _text(cell.value, cell) for cell in row)
        if unvalued:
            cells = tuple(_or_formula(cell, f"{letters(at)}{number}" in unvalued) for at, cell in enumerate(cells))
        yield Row(number, f"sheet {sheet.name}, row {number}", cells, letters=True)


def _or_formula(cell: str, unvalued: bool) -> str:  # noqa: FBT001 - a plain function of two facts
    return UNVALUED if unvalued else cell


def _text(value: object, cell: Any) -> str:  # noqa: ANN401 - one of several kinds of cells
    """The value of a cell as it shows it: numbers exactly as they are stored, as percents where they are shown so."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int | float):
        text = str(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(value)  # noqa: PLR2004 - exact below
        return f"{(Decimal(text) * 100).normalize():f} %" if "%" in str(cell.number_format) else text
    if isinstance(value, dt.datetime | dt.date | dt.time):
        return value.isoformat(" ") if isinstance(value, dt.datetime) else value.isoformat()
    return str(value)


class _Filled:
    """Gives every cell of a merged area the text of its first one."""

    def __init__(self, merged: Iterable[Area]) -> None:
        self._waiting = sorted(merged, key=lambda area: -area.top)
        self._open: list[tuple[Area, str]] = []

    def rows(self, rows: Iterable[Row]) -> Iterator[Row]:
        """The rows with filled cells; those from above are told as `repeated`."""
        for row in rows:
            self._open = [(area, text) for area, text in self._open if area.bottom >= row.line]
            while self._waiting and self._waiting[-1].top <= row.line:
                area = self._waiting.pop()
                self._open.append((area, row.cell(area.left) if area.top == row.line else ""))
            yield self._filled(row) if self._open else row

    def _filled(self, row: Row) -> Row:
        cells = list(row.cells)
        repeated = set()
        for area, text in self._open:
            right = min(area.right, area.left + 500)
            cells += [""] * (right + 1 - len(cells))
            for column in range(area.left, right + 1):
                cells[column] = text
                if area.top < row.line:
                    repeated.add(column)
        return Row(row.line, row.where, tuple(cells), frozenset(repeated), row.letters, row.first)
