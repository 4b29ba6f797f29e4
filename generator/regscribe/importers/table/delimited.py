"""Tables in texts: cells separated by commas, semicolons, tabs or bars, or aligned by blanks as on a clipboard."""

import csv
import io
import re
from collections import Counter
from collections.abc import Iterator, Sequence

from regscribe.importers.table.grid import ALL_LINES, MOST_CHARACTERS, Grid, Lines, Row, TableError, grid_of
from regscribe.importers.table.texts import decode

NAMES = {",": "commas", ";": "semicolons", "\t": "tabs", "|": "bars"}
"""What separates cells, with what messages call it."""

WORDS = {"comma": ",", "semicolon": ";", "tab": "\t", "\\t": "\t", "bar": "|", "pipe": "|", "blanks": " "}
"""Words for separators that a shell does not swallow."""

MOST_ALIGNED = 60
"""Columns of a table that is aligned by blanks and has empty cells."""

Span = tuple[int, int, str]
"""Where a cell begins and ends in its line, and its text."""

SAMPLE = 200
"""Lines that are looked at to find the separator."""

GAP = re.compile(r"\S+(?:\s\S+)*")
"""A cell of a table that is aligned by blanks: words with one blank between them."""


def read(data: bytes, name: str, *, encoding: str = "", delimiter: str = "", lines: Lines = ALL_LINES) -> Grid:
    """Read the table in a text; raises TableError for what is no text, broken quotes, and what is beyond bounds."""
    text, stated = decode(data, name, encoding)
    text = text.replace("\r\n", "\n").replace("\r", "\n")
    separator, before = _separator(text, delimiter)
    rows = _aligned(text) if separator == " " else _rows(text, separator, before, name)
    how = "aligned by two or more blanks" if separator == " " else f"separated by {NAMES.get(separator, separator)}"
    return grid_of(name, rows, (f"{stated}; its cells are {how}",), lines=lines)


def _separator(text: str, wanted: str) -> tuple[str, int]:
    """What separates cells, and how many lines are passed over (one that tells the separator)."""
    hint = re.match(r'"?sep=(.)"?[ \t;,]*\n', text, re.IGNORECASE)
    separator = WORDS.get(wanted, wanted) or (hint[1] if hint else "") or _likely(text)
    if len(separator) != 1:
        message = f"--delimiter {wanted}: a separator is one character, or one of {', '.join(WORDS)}"
        raise TableError(message)
    return separator, int(bool(hint))


def _likely(text: str) -> str:
    """The separator that splits the most lines into an equal number of cells; blanks where none does."""
    lines = [line for line in text.split("\n", SAMPLE + 1)[:SAMPLE] if line.strip()]
    best = max(NAMES, key=lambda separator: _evenness(lines, separator))
    return best if _evenness(lines, best) >= _evenness(lines, " ") and _evenness(lines, best)[0] else " "


def _evenness(lines: Sequence[str], separator: str) -> tuple[int, int]:
    """How many cells are in lines of the commonest number of cells (above one), and how many such lines there are."""
    counts = Counter(len(GAP.findall(line)) if separator == " " else _cells(line, separator) for line in lines)
    counts = Counter({cells: lines for cells, lines in counts.items() if cells > 1})
    if not counts:
        return 0, 0
    cells, often = max(counts.items(), key=lambda one: (one[1] * (one[0] - 1), one[0]))
    return often * (cells - 1), often


def _cells(line: str, separator: str) -> int:
    """Number of cells of a line, whose quoted cells may hold separators."""
    return re.sub(r'"[^"]*"', "", line).count(separator) + 1


def _rows(text: str, separator: str, before: int, name: str) -> Iterator[Row]:
    csv.field_size_limit(max(csv.field_size_limit(), MOST_CHARACTERS * 4))
    body = text.split("\n", before)[-1] if before else text
    reader = csv.reader(io.StringIO(body, newline=""), delimiter=separator, strict=True)
    line = before + 1
    try:
        for cells in reader:
            if cells:
                yield Row(line, f"line {line}", tuple(cells))
            line = before + reader.line_num + 1
    except csv.Error as error:
        message = f"{name}:{line}: {_reason(error, body, line - before)}"
        raise TableError(message, line) from None


def _reason(error: csv.Error, body: str, line: int) -> str:
    if "field larger" in str(error):
        return (
            f"a cell of this row has more than {csv.field_size_limit()} characters: a quote is probably not closed; "
            f"a cell may have {MOST_CHARACTERS}"
        )
    last = body.count("\n")
    until = f" up to line {last}" if "unexpected end" in str(error) and last > line else ""
    return (
        f"the quotes of this row are broken{until} ({error}): put a cell that holds a separator, a quote or a line end "
        "into quotes, and double the quotes in it"
    )


def _aligned(text: str) -> Iterator[Row]:
    """Rows aligned by blanks: a cell belongs to the column of the fullest line whose place it shares, or is nearest."""
    lines = text.expandtabs().split("\n")
    found = [[(one.start(), one.end(), one[0]) for one in GAP.finditer(line)] for line in lines]
    columns = max(found, key=len, default=[])
    for line, cells in enumerate(found, 1):
        if len(cells) != len(columns) > MOST_ALIGNED:
            message = f"line {line} has {len(cells)} cells aligned by blanks and another line {len(columns)}: use tabs"
            raise TableError(message, line)
        texts = [cell for _, _, cell in cells] if len(cells) == len(columns) else _placed(cells, columns)
        yield Row(line, f"line {line}", tuple(texts))


def _placed(cells: Sequence[Span], columns: Sequence[Span]) -> list[str]:
    """The cells of a line that has fewer of them than there are columns, each in its column."""
    row = [""] * len(columns)
    for start, end, cell in cells:
        distances = [_distance(start, end, column) for column in columns]
        at = distances.index(min(distances))
        row[at] = f"{row[at]} {cell}".strip()
    return row


def _distance(start: int, end: int, column: Span) -> int:
    """Blanks between a cell and a column; below 0 where they overlap."""
    return max(column[0] - end, start - column[1])
