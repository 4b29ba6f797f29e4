"""The address spaces of a family as a map: rows of addresses, cells by group, a strip for the region of each view."""

from collections import Counter
from collections.abc import Iterable

from regscribe.emit.markdown import alt_text
from regscribe.emit.markdown.context import SPACES
from regscribe.emit.words import listed, span_words
from regscribe.model import RegisterMap
from regscribe.pictures.address_rows import AddressRow, AddressSection, Cell, Fold, Grid, choose, layout, sections
from regscribe.pictures.address_use import places, unused
from regscribe.pictures.cell_style import Looks, draw, looks, tip
from regscribe.pictures.drawing import MARGIN, PLAIN, SMALL, WIDTH, Box, Canvas, Drawing, DrawnLine, Text, TextStyle
from regscribe.pictures.legend import legend
from regscribe.pictures.text_width import shorten, width

LABEL = 52
"""Room for the address before a row."""

HEIGHT = 26
FOLDED = 20
"""Heights of a row and of a fold."""

FEW = 20
"""A row of this many columns has a number above each, a longer one above every fifth."""

MOST_FORMULAS = 3

Rows = tuple[AddressRow | Fold, ...]


def addresses(register_map: RegisterMap) -> Drawing:
    """Draw the address spaces of a map."""
    found = looks(register_map)
    made = sections(places(register_map), unused(register_map), register_map.reserved)
    grid = choose(made)
    rows = {section: layout(section, grid) for section in made}
    canvas = Canvas()
    title = f"Address space of {register_map.title}"
    canvas.head(title, _remarks(grid))
    _legend(canvas, found, rows.values())
    several = Counter(section.space for section in made)
    for section in made:
        _section(canvas, section, rows[section], grid, found, several=several[section.space] > 1)
    return canvas.finish(title, alt_text.addresses(register_map))


def _legend(canvas: Canvas, found: Looks, sections: Iterable[Rows]) -> None:
    cells = [cell for rows in sections for row in rows if isinstance(row, AddressRow) for cell in row.cells]
    used = [found.look(cell.places) for cell in cells if cell.places]
    legend(canvas, found, used, [cell.kind for cell in cells if not cell.places])


def _remarks(grid: Grid) -> tuple[str, ...]:
    unit = "a cell is one address" if grid.scale == 1 else f"a cell stands for {grid.scale} addresses"
    address = "the address before a row plus the number above a column is the zero-based wire address"
    return (f"Each row has {grid.step} addresses, {unit}; {address}. The letter in a cell names its group.",)


def _section(
    canvas: Canvas,
    section: AddressSection,
    rows: Rows,
    grid: Grid,
    found: Looks,
    *,
    several: bool,
) -> None:
    canvas.y += 24
    room = WIDTH - 2 * MARGIN
    canvas.text(_heading(section, several=several), MARGIN, canvas.y, room, TextStyle(bold=True))
    canvas.y += 8
    _numbers(canvas, grid, max((_end(row) for row in rows if isinstance(row, AddressRow)), default=0))
    for row in rows:
        if isinstance(row, AddressRow):
            _row(canvas, row, grid, found)
        else:
            _fold(canvas, row, grid)


def _heading(section: AddressSection, *, several: bool) -> str:
    if not several:
        return SPACES[section.space]
    types = list(dict.fromkeys(place.type for place in section.places))
    formulas = list(dict.fromkeys(place.formula for place in section.places if not place.alias))
    view = f"view {section.view}" if section.view else ""
    rule = f"at {listed(formulas)}" if formulas != ["n"] and 0 < len(formulas) <= MOST_FORMULAS else ""
    parts = [f"{SPACES[section.space]} {section.first} to {section.last}", view, listed(types), rule]
    return ", ".join(part for part in parts if part)


def _cell_width(grid: Grid) -> float:
    return (WIDTH - 2 * MARGIN - LABEL) // grid.columns


def _end(row: AddressRow) -> int:
    return row.cells[-1].column + row.cells[-1].span


def _numbers(canvas: Canvas, grid: Grid, columns: int) -> None:
    """Draw the numbers above the columns that the section has."""
    if not columns:
        return
    wide = _cell_width(grid)
    canvas.y += 10
    for column in range(0, columns, 1 if grid.columns <= FEW else 5):
        middle = MARGIN + LABEL + wide * (column + 0.5)
        canvas.add(Text(middle, canvas.y, f"+{column * grid.scale}", SMALL, "middle", "dim"))
    canvas.y += 4


def _row(canvas: Canvas, row: AddressRow, grid: Grid, found: Looks) -> None:
    wide = _cell_width(grid)
    label = Text(MARGIN + LABEL - 8, canvas.y + HEIGHT - 8, str(row.first), PLAIN, "end", "dim")
    canvas.add(label)
    for cell in row.cells:
        box = Box(MARGIN + LABEL + wide * cell.column, canvas.y, wide * cell.span, HEIGHT, "")
        _cell(canvas, cell, box, grid, found)
    canvas.y += HEIGHT


def _cell(canvas: Canvas, cell: Cell, box: Box, grid: Grid, found: Looks) -> None:
    if cell.places:
        words = tip(cell.places, cell.first, cell.last, found.groups, found.models)
        draw(canvas, box, found.look(cell.places), 12 if grid.columns <= FEW else 9, words)
    else:
        style = cell.kind or "empty"
        words = f"{cell.first} to {cell.last}: {cell.kind or 'no register'}"
        canvas.add(Box(box.x + 1, box.y + 1, box.width - 2, box.height - 2, style, words, radius=1))


def _fold(canvas: Canvas, fold: Fold, grid: Grid) -> None:
    """Draw a break: a jagged line on both sides of what is left out."""
    left, middle = MARGIN + LABEL, canvas.y + FOLDED / 2
    right = left + _cell_width(grid) * grid.columns
    words = shorten(_fold_words(fold), right - left - 120, SMALL + 1)
    half = width(words, SMALL + 1) / 2 + 10
    centre = (left + right) / 2
    canvas.add(_jagged(left, centre - half, middle), _jagged(centre + half, right, middle))
    canvas.add(Text(centre, middle + 3.5, words, SMALL + 1, "middle", "dim"))
    canvas.y += FOLDED


def _fold_words(fold: Fold) -> str:
    return "; ".join(f"{span_words(low, high)}: {kind or 'no register'}" for kind, low, high in fold.stretches)


def _jagged(left: float, right: float, y: float) -> DrawnLine:
    count = max(int((right - left) // 6), 1)
    step = (right - left) / count
    return DrawnLine(tuple((left + step * n, y + (2 if n % 2 else -2)) for n in range(count + 1)))
