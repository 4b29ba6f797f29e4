"""Tables of any origin as rows of texts, each with its place in people's words."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from regscribe.model import Diagnostic, Severity, Span
from regscribe.visible import INVISIBLE

RULE = "table"
"""Begins the ids of what is found in a table."""

MOST_ROWS = 20_000
"""Most rows with content that are read: more registers than a map may have values for."""

MOST_CHARACTERS = 32_767
"""Most characters of a cell: what a spreadsheet can hold."""

MOST_COLUMNS = 500


class TableError(Exception):
    """A source that no table can be read of; the message says where, why and what to do."""

    def __init__(self, message: str, line: int = 1) -> None:
        super().__init__(message)
        self.line = line


@dataclass(frozen=True, slots=True)
class Row:
    """One row: its number (a line, a row of a sheet, a row of a page), its place in words, and its cells.

    `repeated` are the columns whose cell was merged with the one above, so that it says the same thing once more.
    `letters`: whether columns are called by letters, as in a spreadsheet, where the cells begin with column `first`.
    """

    line: int
    where: str
    cells: tuple[str, ...]
    repeated: frozenset[int] = frozenset()
    letters: bool = False
    first: int = 0

    def place(self, column: int) -> str:
        """The place of a cell: `sheet Registers, cell B7`; `line 7, column 2`."""
        if self.letters:
            sheet = self.where.rpartition(", ")[0]
            return f"{sheet}, cell {letters(self.first + column)}{self.line}"
        return f"{self.where}, column {column + 1}"

    def cell(self, column: int) -> str:
        """The text of a cell; empty where the row is shorter."""
        return self.cells[column] if 0 <= column < len(self.cells) else ""


@dataclass(frozen=True, slots=True)
class Grid:
    """The rows of a source that have content, how they were read, and what is wrong with the source."""

    name: str
    rows: tuple[Row, ...]
    stated: tuple[str, ...] = ()
    findings: tuple[Diagnostic, ...] = ()

    @property
    def width(self) -> int:
        """Columns of the widest row."""
        return max((len(row.cells) for row in self.rows), default=0)

    def span(self, row: Row) -> Span:
        """The place of a row for diagnostics."""
        return Span(self.name, row.line, 1, row.line, 1)

    def warn(self, code: str, message: str, row: Row, help_text: str = "") -> Diagnostic:
        """A fault of the source at a row."""
        return Diagnostic(
            f"{RULE}/{code}", f"{row.where}: {message}", self.span(row), help_text, severity=Severity.WARNING
        )


Lines = tuple[int, int]
"""The first and the last row that are to be read."""

ALL_LINES: Lines = 1, 1 << 31


def grid_of(name: str, rows: Iterable[Row], stated: Sequence[str] = (), *, lines: Lines = ALL_LINES) -> Grid:
    """Collect the rows that have content, without blanks around cells and without characters that nobody sees.

    Raises TableError for what is beyond bounds.
    """
    kept: list[Row] = []
    cleaned = 0
    for row in rows:
        if not lines[0] <= row.line <= lines[1]:
            if row.line > lines[1]:
                break
            continue
        cells = tuple(map(_visible, row.cells))
        cleaned += sum(len(cell) < len(raw.strip()) for cell, raw in zip(cells, row.cells, strict=True))
        while cells and not cells[-1]:
            cells = cells[:-1]
        if not cells:
            continue
        _check(row, cells, len(kept), name)
        kept.append(replace(row, cells=cells))
    said = [f"characters that nobody sees are taken out of {cleaned} cells"] if cleaned else []
    return Grid(name, tuple(kept), (*stated, *said))


def _visible(text: str) -> str:
    """A text without blanks around it and without invisible characters; lines and tabs stay."""
    return INVISIBLE.sub(lambda found: found[0] if found[0] in "\n\t" else "", text).strip()


def _check(row: Row, cells: Sequence[str], before: int, name: str) -> None:
    if before >= MOST_ROWS:
        raise too_many(name, row.where, row.line)
    if len(cells) > MOST_COLUMNS:
        message = f"{row.where} has {len(cells)} cells; a list of registers has at most {MOST_COLUMNS} columns"
        raise TableError(message, row.line)
    longest = max(range(len(cells)), key=lambda at: len(cells[at]))
    if len(cells[longest]) > MOST_CHARACTERS:
        message = (
            f"{row.place(longest)} has {len(cells[longest])} characters, more than the {MOST_CHARACTERS} that a cell "
            "may have: shorten it, or leave its column out"
        )
        raise TableError(message, row.line)


def too_many(name: str, where: str, line: int) -> TableError:
    """The error for a source with more rows than are read."""
    return TableError(
        f"{name} has more than {MOST_ROWS} rows with content, up to {where}: no device has so many registers; choose a "
        "part with --range, or split the list",
        line,
    )


def letters(column: int) -> str:
    """The letters of a column that counts from 0: A, B, .., Z, AA."""
    text = ""
    column += 1
    while column:
        column, rest = divmod(column - 1, 26)
        text = chr(ord("A") + rest) + text
    return text


def number_of(text: str) -> int | None:
    """The column, from 0, that letters name; None for other texts."""
    if not (text.isascii() and text.isalpha() and len(text) <= 3):  # noqa: PLR2004 - a sheet ends with XFD
        return None
    column = 0
    for letter in text.upper():
        column = column * 26 + ord(letter) - ord("A") + 1
    return column - 1
