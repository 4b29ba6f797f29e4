"""Grids to a draft: which of them have registers, what their columns say, and what became of their rows."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Any

from regscribe.draft import Draft, Recognised
from regscribe.importers.table.bit_rows import gathered
from regscribe.importers.table.cells.detect import detect
from regscribe.importers.table.choices import Choices
from regscribe.importers.table.column_words import NEXT, asked, pairs_of
from regscribe.importers.table.columns import Column, recognise, texts_below
from regscribe.importers.table.corrections import BY_USER, corrected
from regscribe.importers.table.grid import Grid, TableError
from regscribe.importers.table.header import Header, at_row, find, without
from regscribe.importers.table.headings import AT, IGNORE, fold
from regscribe.importers.table.layout import Layout, lay_out
from regscribe.importers.table.registers import Made, made_of
from regscribe.importers.table.whole import Whole, whole_of
from regscribe.importers.table.workbooks import ALL
from regscribe.model import Diagnostic

STDIN = "stdin"
"""What the command calls a source that has no name."""

SHOWN = 3
"""Rows that are shown where no header is found."""


@dataclass(frozen=True, slots=True)
class Page:
    """A grid with its header and columns."""

    grid: Grid
    header: Header
    columns: tuple[Column, ...]

    @property
    def title(self) -> str:
        """The name of the sheet; empty for other sources."""
        row = self.grid.rows[0]
        return row.where.removeprefix("sheet ").rpartition(", ")[0] if row.letters else ""


def draft_of(grids: Sequence[Grid], choices: Choices, name: str) -> Draft:
    """Make the draft. Raises TableError where no header is found, or several sheets have one and none was chosen."""
    pages = [page for grid in grids if grid.rows and (page := _page(grid, choices)) is not None]
    if not pages:
        raise _no_header(grids, choices, name)
    if len(pages) > 1 and not choices.sheets:
        titles = ", ".join(f"`{page.title}` ({len(page.grid.rows)} rows)" for page in pages)
        message = (
            f"{name} has several sheets with registers, {titles}: choose with --sheet, or all with --sheet '{ALL}'"
        )
        raise TableError(message)
    for text in choices.corrections:
        pages = _corrected(pages, text)
    drafts = [_drafted(page, choices) for page in pages]
    read = {page.grid.rows[0].where for page in pages}
    passed = [grid for grid in grids if grid.rows and grid.rows[0].where not in read]
    return Draft(
        entries=tuple(entry for draft in drafts for entry in draft.entries),
        head=_head(drafts, name),
        groups={group: keys for draft in drafts for group, keys in draft.groups.items()},
        title=PurePath(name).stem if name != STDIN else "",
        stated=(*(text for draft in drafts for text in draft.stated), *_passed_over(passed)),
        findings=tuple(one for draft in drafts for one in draft.findings),
        recognised=tuple(one for draft in drafts for one in draft.recognised),
        settings=_settings(drafts, pages, choices),
    )


def _settings(drafts: Sequence[Draft], pages: Sequence[Page], choices: Choices) -> dict[str, str]:
    """The options by which the next list is read as this one was; of several sheets those alone that count for all."""
    found = {"sheet": "\n".join(choices.sheets or [page.title for page in pages])}
    found["cell"] = "\n".join(choices.corrections)
    if len(pages) == 1:
        found |= {**drafts[0].settings, "columns": "\n".join(_pairs(pages[0]))}
    return {name: text for name, text in found.items() if text}


def _pairs(page: Page) -> Iterator[str]:
    """What each column says, by its heading, or by its letter or number where the heading tells too little."""
    folded = [fold(heading) for heading in page.header.headings]
    for column in page.columns:
        if column.role:
            own = fold(column.heading)
            alone = own and folded.count(own) == 1 and not NEXT.search(column.heading)
            yield f"{column.role}={' '.join(column.heading.split()) if alone else column.called}"


def _head(drafts: Sequence[Draft], name: str) -> dict[str, Any]:
    units = {unit: keys for draft in drafts for unit, keys in draft.head.get("units", {}).items()}
    manual = {"manual": {"title": PurePath(name).name}} if name != STDIN else {}
    return {**manual, **({"units": units} if units else {})}


def _passed_over(grids: Sequence[Grid]) -> Iterator[str]:
    for grid in grids:
        yield f"{grid.rows[0].where.rpartition(', ')[0]} has no header of a list of registers and was passed over"


def _page(grid: Grid, choices: Choices) -> Page | None:
    """A grid with its columns; None where no header is found. Raises TableError for columns that are not there."""
    named = [heading for _, heading in pairs_of(choices.columns) if heading != IGNORE]
    if choices.header == "none":
        header: Header | None = without(grid)
    elif choices.header:
        header = at_row(grid, int(choices.header))
    else:
        header = find(grid, named)
    if header is None:
        return None
    columns = recognise(grid, header, asked(choices.columns, header.headings, first=grid.rows[0].first))
    return Page(grid, header, columns)


def _corrected(pages: Sequence[Page], text: str) -> list[Page]:
    """The pages with one cell corrected, in each that has it. Raises TableError where none has."""
    found, wrong = [], []
    for page in pages:
        try:
            found.append(replace(page, grid=corrected(page.grid, page.header, page.columns, text)))
        except TableError as error:
            found.append(page)
            wrong.append(error)
    if len(wrong) == len(pages):
        raise wrong[0]
    return found


def _no_header(grids: Sequence[Grid], choices: Choices, name: str) -> TableError:
    if choices.header:
        return TableError(f"--header {choices.header}: {name} has no such row, or it is empty")
    rows = [row for grid in grids for row in grid.rows[:SHOWN]][:SHOWN]
    shown = "; ".join(f"{row.where}: {' | '.join(cell[:20] for cell in row.cells[:8])}" for row in rows)
    return TableError(
        f"{name}: no row looks like the header of a list of registers (it begins: {shown}); say which row it is with "
        "--header, or with --header none and --columns at=1,name=2 which columns there are"
    )


def _drafted(page: Page, choices: Choices) -> Draft:
    if all(column.role != AT for column in page.columns):
        known = ", ".join(f"`{column.heading or column.called}`" for column in page.columns)
        message = f"no column has the addresses, of {known}: say with --columns at=.. which one it is"
        raise TableError(message)
    layout = lay_out(page.grid, page.header, page.columns)
    whole = whole_of(layout.items, page.columns, choices, page.title)
    made, counted = made_of(layout.items, whole, choices, page.grid)
    entries = gathered(made)
    detected = detect([one.detected for one in made if one.detected is not None])
    units = {unit: keys for one in made for unit, keys in one.declared.items()}
    return Draft(
        entries=entries,
        head={"units": units} if units else {},
        groups={entry.group: {"source": source} for entry in entries} if (source := _source(page)) else {},
        stated=(*_stated(page, layout, whole, made, choices), *filter(None, [counted])),
        findings=(*page.grid.findings, *layout.findings, *detected, *_unread(page)),
        recognised=tuple(Recognised(*column.shown) for column in page.columns),
        settings={"base": choices.base or whole.base},
    )


def _source(page: Page) -> str:
    """Where the registers stand, for the docs; empty where the source has no name."""
    name = PurePath(page.grid.name).name if page.grid.name != STDIN else ""
    return f"sheet {page.title}" if page.title else name


def _unread(page: Page) -> Iterator[Diagnostic]:
    """Columns with something in them that nobody understands, with what to write to keep them."""
    filled = [any(cells) for cells in texts_below(page.grid, page.header)]
    for column in page.columns:
        if not column.role and filled[column.index]:
            heading = f"`{column.heading}`" if column.heading else "without a heading"
            message = f"column {column.called}, {heading}, is not understood and not read"
            advice = f'--columns description="{column.heading or column.called}" keeps its texts, ROLE=.. reads it'
            row = page.grid.rows[max(page.header.first, 0)]
            yield replace(page.grid.warn("column", message, row), help=advice)


def _stated(page: Page, layout: Layout, whole: Whole, made: Sequence[Made], choices: Choices) -> Iterator[str]:
    where = f"sheet {page.title}: " if page.title else ""
    yield from (text for text in page.grid.stated if text.endswith(BY_USER))
    yield from (f"{where}{text}" for text in whole.stated)
    if assumed := sum(one.order_assumed for one in made):
        rows = "1 register" if assumed == 1 else f"{assumed} registers"
        yield (
            f"{where}nothing states the order of the words of {rows}: the highest first (ABCD) is assumed; check one, "
            "--word-order little is the other"
        )
    doubtful = sum(remark.code == "range-unclear" for one in made for remark in one.entry.remarks)
    if doubtful and not choices.ranges:
        yield f"{where}{doubtful} of the ranges are unclear; what they count, --ranges stored or --ranges value says"
    if "access" not in whole.headings and choices.access is None:
        yield f"{where}no column says whether registers can be written: all are read only here (--access)"
    if layout.headers:
        rows = "1 row, which is" if layout.headers == 1 else f"{layout.headers} rows, which are"
        yield f"{where}the header is repeated in {rows} passed over"
