"""Tables of a PDF, as their ruled lines show them; joined over the pages below the header of the first."""

import io
import logging
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from regscribe.importers.table.grid import Grid, Row, TableError, grid_of
from regscribe.importers.table.header import find

if TYPE_CHECKING:
    from pdfplumber.page import Page

MOST_PAGES = 400
"""Pages that are read without being named: a second or so each."""

Area = tuple[float, float, float, float]


@dataclass(frozen=True, slots=True)
class Found:
    """One table of a page."""

    page: int
    rows: tuple[Row, ...]

    @property
    def width(self) -> int:
        """Columns of the table."""
        return max(len(row.cells) for row in self.rows)


def read(
    data: bytes, name: str, pages: Sequence[int], area: Area | None, *, headless: bool = False
) -> tuple[list[Grid], list[str]]:
    """Read the tables of the named pages, or of all; `headless`: the list has no row that names its columns.

    Raises TableError for what is no PDF, is protected, or has no tables, and for two lists of different columns.
    """
    with _readable(name):
        pdfplumber = _library()
        with pdfplumber.open(io.BytesIO(data)) as document:
            numbers = _numbers(len(document.pages), pages, name)
            found = [table for number in numbers for table in _tables(document.pages[number - 1], number, area)]
    if not found:
        raise _none(name, numbers, area)
    return _joined(found, name, headless=headless)


def _library() -> Any:  # noqa: ANN401 - a module without types
    try:
        import pdfplumber  # noqa: PLC0415 - an extra, and half a second
    except ImportError:
        message = 'reading a PDF needs pdfplumber: pip install "regscribe[pdf]"; or copy the table and import it from -'
        raise TableError(message) from None
    logging.getLogger("pdfminer").setLevel(logging.CRITICAL)  # it warns of fonts
    return pdfplumber


@contextmanager
def _readable(name: str) -> Iterator[None]:
    """Turn whatever the libraries raise for a broken file into a TableError."""
    try:
        yield
    except TableError:
        raise
    except Exception as error:  # noqa: BLE001 - pdfminer raises whatever its parser stumbles upon
        kinds = f"{type(error).__name__} {type(error.__cause__).__name__} {error!r}"
        if "Password" in kinds or "Encrypt" in kinds:
            message = f"{name} is protected by a password: print it into a PDF without one, and import that"
        else:
            message = f"{name} is a broken PDF ({type(error).__name__}: {str(error)[:100]}): print it into a PDF anew"
        raise TableError(message) from None


def _numbers(last: int, pages: Sequence[int], name: str) -> Sequence[int]:
    if wrong := [number for number in pages if number > last]:
        message = f"--pages {wrong[0]}: {name} has {last} pages"
        raise TableError(message)
    if not pages and last > MOST_PAGES:
        message = f"{name} has {last} pages: name those with the list of registers, --pages 12-20"
        raise TableError(message)
    return pages or range(1, last + 1)


def _tables(page: "Page", number: int, area: Area | None) -> Iterator[Found]:
    """The tables of a page, from top to bottom; what was read of the page is forgotten."""
    row = 0
    part = page.crop(area, strict=False) if area is not None else page
    for table in part.extract_tables():
        rows = []
        for cells in table:
            row += 1
            rows.append(Row(number, f"page {number}, row {row}", tuple(cell or "" for cell in cells)))
        if any(any(map(str.strip, one.cells)) for one in rows):
            yield Found(number, tuple(rows))
    page.close()


def _joined(found: Sequence[Found], name: str, *, headless: bool) -> tuple[list[Grid], list[str]]:
    """One grid of the first table with a header and of those like it that follow; others are told by page.

    Without headers (`headless`, or because none is found) those as wide as most rows are read.
    """
    headed = [] if headless else [table for table in found if find(grid_of(name, table.rows)) is not None]
    start = found.index(headed[0]) if headed else 0
    width = headed[0].width if headed else _usual_width(found)
    _check_one_list(headed)
    taken = [table for table in found[start:] if table.width == width]
    pages = _pages(taken)
    stated = [f"the tables of pages {_listed(pages)} are read as one"] if len(pages) > 1 else []
    stated += [f"a table on page {table.page} has no header and is passed over" for table in found[:start]]
    stated += list(_other_widths(found[start:], width))
    return [grid_of(name, (row for table in taken for row in table.rows))], stated


def _usual_width(found: Sequence[Found]) -> int:
    """The columns that most rows have."""
    rows = Counter({table.width: 0 for table in found})
    for table in found:
        rows[table.width] += len(table.rows)
    return rows.most_common(1)[0][0]


def _check_one_list(headed: Sequence[Found]) -> None:
    """Raise TableError where two lists of registers have different columns."""
    for table in headed:
        if table.width != headed[0].width:
            message = (
                f"the list of registers on page {table.page} has {table.width} columns, and that on page "
                f"{headed[0].page} has {headed[0].width}: choose the pages of one list with --pages, or a part of each "
                "with --area"
            )
            raise TableError(message, table.page)


def _other_widths(found: Sequence[Found], width: int) -> Iterator[str]:
    """What is said of the tables that have other columns than the list, those of one width together."""
    for other in sorted({table.width for table in found} - {width}):
        tables = [table for table in found if table.width == other]
        pages = _pages(tables)
        words = "page" if len(pages) == 1 else "pages"
        yield (
            f"{sum(len(table.rows) for table in tables)} rows of tables on {words} {_listed(pages)} have {other} "
            f"columns, not the {width} of the list, and are passed over: if they are registers, read them "
            f"by themselves with --pages {','.join(map(str, pages))} --header none --columns at=1,name=2"
        )


def _pages(tables: Sequence[Found]) -> list[int]:
    return list(dict.fromkeys(table.page for table in tables))


def _listed(pages: Sequence[int]) -> str:
    return ", ".join(map(str, pages))


def _none(name: str, pages: Sequence[int], area: Area | None) -> TableError:
    where = f"its pages {pages[0]} to {pages[-1]}" if len(pages) > 1 else f"its page {pages[0]}" if pages else "it"
    part = " in that area" if area is not None else ""
    return TableError(
        f"{name}: {where} has no table with ruled lines{part}: copy the table out of the PDF and import it from "
        "standard input (regscribe import -), or into a spreadsheet"
    )
