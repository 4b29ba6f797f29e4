"""Finds the row that names the columns, also below notes, and when two rows name them together."""

from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.importers.table.grid import Grid, Row
from regscribe.importers.table.headings import AT, INSIDE, fold, meaning

SEARCHED = 300
"""Rows in which the header is looked for."""

LONGEST = 60
"""Characters of a heading; a longer cell is a note."""

FEWEST = 3
"""What a header must score: an address and something else, one of them by a known heading."""

SHORT = frozenset(
    {"dec", "hex", "min", "max", "decimal", "hexadecimal", "minimum", "maximum", "low", "high", "von", "bis"}
)
"""Words of a second row of headings, below a first one (`Address`, `Range`)."""


@dataclass(frozen=True, slots=True)
class Header:
    """The headings, and the first and the last row of the grid that have them (-1: none has)."""

    headings: tuple[str, ...]
    first: int
    last: int

    def repeated_by(self, row: Row, grid: Grid) -> bool:
        """Whether a row says the headings again."""
        if self.first < 0:
            return False
        return any(
            _folded(row.cells) == _folded(grid.rows[own].cells) for own in range(self.first, self.last + 1)
        ) or _folded(row.cells) == _folded(self.headings)


def without(grid: Grid) -> Header:
    """The header of a table that has none: its columns have no names."""
    return Header(("",) * grid.width, -1, -1)


def at_row(grid: Grid, line: int) -> Header | None:
    """The header in a row that the user names by its number; None if there is no such row."""
    for index, row in enumerate(grid.rows):
        if row.line == line:
            return _grown(grid, index)
    return None


def find(grid: Grid, named: Sequence[str] = ()) -> Header | None:
    """The header of a grid; None if no row names the columns. `named` are headings that the user says."""
    wanted = {fold(name) for name in named} - {""}
    scores = [_score(row, wanted) for row in grid.rows[:SEARCHED]]
    best = max(scores, default=0)
    return _grown(grid, scores.index(best)) if best >= FEWEST else None


def _score(row: Row, wanted: set[str]) -> int:
    """How much a row looks like one of headings: 2 for each known one, 1 for one that has a known word."""
    found: dict[str, int] = {}
    said = 0
    for cell in row.cells:
        if len(cell) > LONGEST or not cell:
            continue
        role, unsure = meaning(cell)
        if role:
            found[role] = max(found.get(role, 0), 2 if unsure < INSIDE else 1)
        said += fold(cell) in wanted
    if AT not in found and not said:
        return 0
    return 10 * said + (sum(found.values()) if len(found) > 1 or said else 0)


def _grown(grid: Grid, index: int) -> Header:
    """The header with what stands in the row above or below it, if that belongs to it."""
    rows = grid.rows
    first = last = index
    if index + 1 < len(rows) and _below(rows[index], rows[index + 1]):
        last = index + 1
    elif index > 0 and _above(rows[index - 1], rows[index]):
        first = index - 1
    width = max(grid.width, len(rows[index].cells))
    headings = tuple(_joined(rows[first].cell(at), rows[last].cell(at)) for at in range(width))
    return Header(headings, first, last)


def _below(upper: Row, lower: Row) -> bool:
    """Whether the lower row divides headings of the upper one: nothing but headings, one at least of the short ones."""
    cells = [(at, cell) for at, cell in enumerate(lower.cells) if cell and at not in lower.repeated]
    divided = any(set(fold(cell).split()) & SHORT for _, cell in cells)
    return divided and _adjacent(upper, lower) and all(meaning(cell)[0] for _, cell in cells)


def _above(upper: Row, lower: Row) -> bool:
    """Whether the upper row has the headings that the lower one lacks, or those that its short words divide."""
    if not _adjacent(upper, lower) or len({cell for cell in upper.cells if cell}) < 2:  # noqa: PLR2004 - a title is one
        return False
    if any(len(cell) > LONGEST or cell.replace(".", "").isdecimal() for cell in upper.cells):
        return False
    lacking = any(cell and not lower.cell(at) for at, cell in enumerate(upper.cells))
    divided = any(fold(cell) in SHORT for cell in lower.cells)
    return (lacking or divided) and any(meaning(cell)[0] for cell in upper.cells)


def _adjacent(upper: Row, lower: Row) -> bool:
    """Whether nothing stands between two rows; rows of a page have one number."""
    return lower.line - upper.line in {0, 1}


def _joined(upper: str, lower: str) -> str:
    parts = dict.fromkeys(" ".join(text.split()) for text in (upper, lower) if text)
    return " ".join(parts)


def _folded(cells: Sequence[str]) -> list[str]:
    folded = [fold(cell) for cell in cells]
    while folded and not folded[-1]:
        folded.pop()
    return folded
