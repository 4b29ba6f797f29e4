"""The legend of the address map: every group with its letter, and what outlines, hatching and marks mean."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil

from regscribe.model import Access
from regscribe.pictures.address_rows import Cell
from regscribe.pictures.cell_style import MANY, OTHERWISE, SEVERAL, Look, Looks, draw, set_words
from regscribe.pictures.drawing import MARGIN, PLAIN, WIDTH, Box, Canvas, Text
from regscribe.pictures.text_width import clean, width, wrap

COLUMNS = 3
LINE = 24
SAMPLE = 34
"""Height of an entry and width of its sample."""

SMALLER = 10
"""Font size of a text that is too long: of this size two lines fit."""

MOST_GROUPS = 300
"""Groups that are listed by name."""

ACCESS = {
    Access.READ_WRITE: "filled: read and write",
    Access.READ: "outline: read only",
    Access.WRITE: "with a bar: write only",
}
HATCHES = {"unused": "unused: reads 0, refuses writes", "reserved": "reserved by the manual", "": "no register"}
MARKS = {
    MANY: "other sets of models",
    OTHERWISE: "another register on other models",
    SEVERAL: "registers of several groups",
}
"""What outlines, hatching and marks mean, in the order of the legend."""


@dataclass(frozen=True, slots=True)
class LegendEntry:
    """A sample (a cell, a hatched box or a mark alone) with its meaning."""

    text: str
    look: Look | None = None
    hatch: str = ""
    mark: str = ""


def legend(canvas: Canvas, looks: Looks, cells: Sequence[Cell]) -> None:
    """Draw the entries of everything that occurs in the cells, groups first."""
    used = [looks.look(cell.uses) for cell in cells if cell.uses]
    kinds = {cell.kind for cell in cells if not cell.uses}
    _block(canvas, list(_groups(looks)))
    hatches = [LegendEntry(text, hatch=kind or "empty") for kind, text in HATCHES.items() if kind in kinds]
    _block(canvas, [*_shapes(looks, used), *hatches])
    _block(canvas, list(_marks(looks, used)))


def _groups(looks: Looks) -> Iterator[LegendEntry]:
    names = list(looks.groups.values())
    yield from (LegendEntry(name, Look(number)) for number, name in enumerate(names[:MOST_GROUPS]))
    if len(names) > MOST_GROUPS:
        yield LegendEntry(f"and {len(names) - MOST_GROUPS} more groups", mark=MANY)


def _shapes(looks: Looks, used: Sequence[Look]) -> Iterator[LegendEntry]:
    access = {look.access for look in used}
    sample = used[0].group if looks.groups and used else 0
    yield from (LegendEntry(text, Look(sample, one)) for one, text in ACCESS.items() if one in access)
    aliases = [look for look in used if look.alias]
    if aliases:
        yield LegendEntry("dashed, round: alias", Look(sample, aliases[0].access, alias=True))


def _marks(looks: Looks, used: Sequence[Look]) -> Iterator[LegendEntry]:
    words = {mark: set_words(names, looks.models) for names, mark in looks.sets.items() if mark != MANY}
    marks = {look.mark for look in used}
    yield from (LegendEntry(text, mark=mark) for mark, text in (words | MARKS).items() if mark in marks)


def _block(canvas: Canvas, entries: Sequence[LegendEntry]) -> None:
    """Draw entries in columns, read down the first column, then the next."""
    if not entries:
        return
    rows = ceil(len(entries) / COLUMNS)
    column = (WIDTH - 2 * MARGIN) / COLUMNS
    for number, entry in enumerate(entries):
        x = MARGIN + column * (number // rows)
        _entry(canvas, entry, x, canvas.y + LINE * (number % rows), column - SAMPLE - 14)
    canvas.y += LINE * rows + 6


def _entry(canvas: Canvas, entry: LegendEntry, x: float, y: float, room: float) -> None:
    box = Box(x, y, SAMPLE, LINE - 2, "")
    if entry.look:
        draw(canvas, box, entry.look, 11)
    elif entry.hatch:
        canvas.add(Box(x + 1, y + 1, SAMPLE - 2, LINE - 4, entry.hatch))
    else:
        canvas.add(Text(x + SAMPLE - 4, y + 14, entry.mark, PLAIN, "end", bold=True))
    text = clean(entry.text)
    size = PLAIN if width(text, PLAIN) <= room else SMALLER
    lines = wrap(text, room, size, lines=2)
    for number, line in enumerate(lines):
        base = y + (15 if len(lines) == 1 else 9 + 12 * number)
        canvas.text(Text(x + SAMPLE + 8, base, line, size, tip=text if lines != (text,) else ""), room)
