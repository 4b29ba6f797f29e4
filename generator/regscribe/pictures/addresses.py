"""The address spaces of a family as a map: rows of addresses, cells by group, a strip for the region of each view."""

from collections import Counter

from regscribe.emit.markdown import alt_text
from regscribe.emit.markdown.context import SPACES
from regscribe.emit.words import listed, span_words
from regscribe.model import RegisterMap
from regscribe.pictures.address_rows import AddressRow, AddressSection, Fold, Grid, choose, layout, sections
from regscribe.pictures.address_use import address_uses
from regscribe.pictures.cell_style import Looks, draw, looks
from regscribe.pictures.drawing import MARGIN, PLAIN, SMALL, WIDTH, Box, Canvas, Drawing, DrawnLine, Text
from regscribe.pictures.legend import legend
from regscribe.pictures.text_width import shorten, width

LEFT = MARGIN + 52
"""Where a row begins, behind its first address."""

HEIGHT = 26
FOLDED = 20
"""Heights of a row and of a fold."""

FEW = 20
"""A row of this many columns has a number above each, a longer one above every fifth."""

MOST_FORMULAS = 3

Rows = tuple[AddressRow | Fold, ...]


def addresses(register_map: RegisterMap) -> Drawing:
    """Draw the address spaces of a map."""
    uses = address_uses(register_map)
    styles = looks(register_map, uses)
    made = sections(register_map, uses)
    grid = choose(made)
    layouts = [layout(section, grid) for section in made]
    canvas = Canvas()
    title = f"Address space of {register_map.title}"
    unit = "a cell is one address" if grid.scale == 1 else f"a cell stands for {grid.scale} addresses"
    address = "the address before a row plus the number above a column is the zero-based wire address"
    remark = f"Each row has {grid.step} addresses, {unit}; {address}. The letter in a cell names its group."
    canvas.head(title, (remark,))
    cells = [cell for rows in layouts for row in rows if isinstance(row, AddressRow) for cell in row.cells]
    legend(canvas, styles, cells)
    several = Counter(section.space for section in made)
    for section, rows in zip(made, layouts, strict=True):
        _section(canvas, _heading(section, several=several[section.space] > 1), rows, grid, styles)
    return canvas.finish(title, alt_text.addresses(register_map))


def _section(canvas: Canvas, heading: str, rows: Rows, grid: Grid, styles: Looks) -> None:
    canvas.y += 24
    canvas.text(Text(MARGIN, canvas.y, heading, bold=True), WIDTH - 2 * MARGIN)
    canvas.y += 8
    last_cells = [row.cells[-1] for row in rows if isinstance(row, AddressRow)]
    if last_cells:
        canvas.y += 10
        for column in range(0, max(cell.column + cell.span for cell in last_cells), 1 if grid.columns <= FEW else 5):
            middle = LEFT + _cell_width(grid) * (column + 0.5)
            canvas.add(Text(middle, canvas.y, f"+{column * grid.scale}", SMALL, "middle", "dim"))
        canvas.y += 4
    for row in rows:
        if isinstance(row, AddressRow):
            _row(canvas, row, grid, styles)
        else:
            _fold(canvas, row, grid)


def _heading(section: AddressSection, *, several: bool) -> str:
    if not several:
        return SPACES[section.space]
    types = list(dict.fromkeys(use.type for use in section.uses))
    formulas = list(dict.fromkeys(use.formula for use in section.uses if not use.alias))
    view = f"view {section.view}" if section.view else ""
    rule = f"at {listed(formulas)}" if formulas != ["n"] and 0 < len(formulas) <= MOST_FORMULAS else ""
    parts = [f"{SPACES[section.space]} {section.first} to {section.last}", view, listed(types), rule]
    return ", ".join(part for part in parts if part)


def _cell_width(grid: Grid) -> float:
    return (WIDTH - MARGIN - LEFT) // grid.columns


def _row(canvas: Canvas, row: AddressRow, grid: Grid, styles: Looks) -> None:
    wide = _cell_width(grid)
    canvas.add(Text(LEFT - 8, canvas.y + HEIGHT - 8, str(row.first), PLAIN, "end", "dim"))
    for cell in row.cells:
        left = LEFT + wide * cell.column
        if cell.uses:
            box = Box(left, canvas.y, wide * cell.span, HEIGHT, "")
            words = styles.tip(cell.uses, cell.first, cell.last)
            draw(canvas, box, styles.look(cell.uses), 12 if grid.columns <= FEW else 9, words)
        else:
            words = f"{cell.first} to {cell.last}: {cell.kind or 'no register'}"
            style = cell.kind or "empty"
            canvas.add(Box(left + 1, canvas.y + 1, wide * cell.span - 2, HEIGHT - 2, style, words, radius=1))
    canvas.y += HEIGHT


def _fold(canvas: Canvas, fold: Fold, grid: Grid) -> None:
    """Draw a break: a jagged line on both sides of what is left out."""
    middle = canvas.y + FOLDED / 2
    right = LEFT + _cell_width(grid) * grid.columns
    words = "; ".join(f"{span_words(low, high)}: {kind or 'no register'}" for kind, low, high in fold)
    shown = shorten(words, right - LEFT - 120, SMALL + 1)
    half = width(shown, SMALL + 1) / 2 + 10
    centre = (LEFT + right) / 2
    canvas.add(_jagged(LEFT, centre - half, middle), _jagged(centre + half, right, middle))
    canvas.add(Text(centre, middle + 3.5, shown, SMALL + 1, "middle", "dim"))
    canvas.y += FOLDED


def _jagged(left: float, right: float, y: float) -> DrawnLine:
    count = max(int((right - left) // 6), 1)
    step = (right - left) / count
    return DrawnLine(tuple((left + step * n, y + (2 if n % 2 else -2)) for n in range(count + 1)))
