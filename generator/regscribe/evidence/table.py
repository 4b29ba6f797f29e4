"""A table of CSV as people and spreadsheets write it: header and rows with their lines, or a clear refusal."""

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass

BYTE_ORDER_MARK = b"\xef\xbb\xbf"
UTF_16_MARKS = (b"\xff\xfe", b"\xfe\xff")
ARCHIVE = b"PK\x03\x04"
"""What a workbook (.xlsx, .ods) starts with."""

SEPARATORS = ",;\t"
MOST_BYTES = 64 * 1024 * 1024
"""Far beyond any device: 100,000 rows of the export take 40 MB."""


class TableError(Exception):
    """The table cannot be compared; the message says where, why and what to do."""


@dataclass(frozen=True, slots=True)
class TableRow:
    """The cells of one row, as many as the header has, and the line of the file on which the row starts."""

    line: int
    cells: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Table:
    """A table whose first row names the columns; rows without any content are left out."""

    name: str
    header: tuple[str, ...]
    rows: tuple[TableRow, ...]


def read(content: bytes, name: str) -> Table:
    """Read UTF-8 (with or without byte order mark), separated by commas, semicolons or tabs.

    A first line `sep=;` is obeyed. Raises TableError for another encoding, broken quotes, rows of another length than
    the header, a file without rows.
    """
    lines = list(_rows(_text(content, name), name))
    if not lines:
        message = f"{name} is empty: its first line must name the columns, for example address,name,access"
        raise TableError(message)
    head, *body = lines
    header = tuple(map(str.strip, head.cells))
    while header and not header[-1]:
        header = header[:-1]
    if not body:
        message = f"{name} has a header in line {head.line} and no row after it"
        raise TableError(message)
    for row in body:
        if len(row.cells) < len(header) or any(cell.strip() for cell in row.cells[len(header) :]):
            message = (
                f"{name}:{row.line}: this row has {len(row.cells)} cells and the header has {len(header)}: quote a "
                "cell that holds a separator, and write empty cells too"
            )
            raise TableError(message)
    return Table(name, header, tuple(TableRow(row.line, row.cells[: len(header)]) for row in body))


def _text(content: bytes, name: str) -> str:
    if len(content) > MOST_BYTES:
        message = f"{name} has {len(content)} bytes, more than the {MOST_BYTES} that a table may have"
        raise TableError(message)
    if content.startswith(ARCHIVE):
        message = f"{name} is a workbook and no CSV: save the sheet as CSV in UTF-8"
        raise TableError(message)
    if content.startswith(UTF_16_MARKS) or b"\0" in content:
        message = f"{name} is encoded as UTF-16 or no text at all (it holds NUL bytes): save it as CSV in UTF-8"
        raise TableError(message)
    try:
        return content.removeprefix(BYTE_ORDER_MARK).decode()
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        message = (
            f"{name}:{line}: the byte 0x{content[error.start]:02X} is no UTF-8; the file is probably encoded as "
            "Latin-1 or Windows-1252: save it as CSV in UTF-8"
        )
        raise TableError(message) from None


def _rows(text: str, name: str) -> Iterator[TableRow]:
    """Yield the rows that have any content; a quoted cell may hold line ends."""
    first, _, rest = text.partition("\n")
    hint = first.strip().strip('"')
    has_hint = hint.lower().startswith("sep=") and len(hint) == len("sep=;")
    separator = hint[-1] if has_hint else max(SEPARATORS, key=first.count)  # a comma where the header has none
    reader = csv.reader(io.StringIO(rest if has_hint else text, newline=""), delimiter=separator, strict=True)
    before = int(has_hint)
    line = before + 1
    try:
        for cells in reader:
            if any(cell.strip() for cell in cells):
                yield TableRow(line, tuple(cells))
            line = before + reader.line_num + 1
    except csv.Error as error:
        message = (
            f"{name}:{line}: this row is no CSV ({error}): put a cell that holds a separator, a quote or a line end "
            "into quotes, and double the quotes in it"
        )
        raise TableError(message) from None
