"""Sheets to the bytes of a workbook: typed cells, no formulas, and nothing of the clock."""

import io
import re
import zipfile
from collections.abc import Sequence
from datetime import datetime
from typing import TYPE_CHECKING, Any, NamedTuple

from regscribe.export.device.names import Names
from regscribe.export.xlsx.columns import COLUMNS, Column, Content, Line
from regscribe.visible import safe_lines

if TYPE_CHECKING:
    from openpyxl import Workbook

LONGEST = 32_767
"""Characters of a cell."""

LONGEST_TITLE = 31
FORBIDDEN = re.compile(r"[\[\]:*?/\\']")
"""What the title of a sheet must not have."""

DATE = (1980, 1, 1, 0, 0, 0)
"""The earliest date of an archive; every part has it, so that the same maps give the same bytes."""

CHANGED = re.compile(rb"(<dcterms:(created|modified)[^>]*>)[^<]*(</dcterms:\2>)")


class Sheet(NamedTuple):
    """A sheet: its title, and a line for each row."""

    title: str
    lines: Sequence[Line]


class Cut(NamedTuple):
    """A cell that was too long: of which model and register, which fact, and where it was cut."""

    model: str
    path: str
    fact: str
    length: int


def workbook(sheets: Sequence[Sheet], title: str) -> tuple[bytes, list[Cut]]:
    """Return the bytes of a workbook, and the cells that were cut."""
    from openpyxl import Workbook  # noqa: PLC0415 - 200 ms that only workbooks need

    book, cut, names = Workbook(write_only=True), list[Cut](), Names(" ")
    book.properties.title, book.properties.creator = safe_lines(title)[:LONGEST], "regscribe"
    for sheet in sheets:
        _fill(book, sheet, names.give(_title(sheet.title)), cut)
    data = io.BytesIO()
    book.save(data)
    return _reproducible(data.getvalue()), cut


def _title(text: str) -> str:
    return FORBIDDEN.sub("_", safe_lines(" ".join(text.split())))[: LONGEST_TITLE - 4] or "model"


def _fill(book: "Workbook", sheet: Sheet, title: str, cut: list[Cut]) -> None:
    from openpyxl.styles import Alignment, Font, PatternFill  # noqa: PLC0415 - as above
    from openpyxl.utils import get_column_letter  # noqa: PLC0415 - as above

    into: Any = book.create_sheet(title)
    columns = [one for one in COLUMNS if one.always or any(one.content(line) is not None for line in sheet.lines)]
    for place, column in enumerate(columns, 1):
        into.column_dimensions[get_column_letter(place)].width = column.width
    into.freeze_panes = "C2"
    into.auto_filter.ref = f"A1:{get_column_letter(len(columns))}{len(sheet.lines) + 1}"
    heads = [_cell(into, column.heading) for column in columns]
    for head in heads:
        head.font, head.fill = Font(bold=True), PatternFill("solid", fgColor="FFDDDDDD")
        head.alignment = Alignment(wrap_text=True, vertical="top")
    into.append(heads)
    for line in sheet.lines:
        into.append([_content(into, column, line, cut) for column in columns])


def _content(into: Any, column: Column, line: Line, cut: list[Cut]) -> Any:  # noqa: ANN401 (openpyxl's sheet and cell)
    value = column.content(line)
    if not isinstance(value, str):
        return _cell(into, value)
    text = safe_lines(value)
    if len(text) > LONGEST:
        cut.append(Cut(line.model.name, line.row.id, column.fact, LONGEST))
    return _cell(into, text[:LONGEST])


def _cell(into: Any, value: Content) -> Any:  # noqa: ANN401 (openpyxl's sheet and cell)
    """A number as a number, a text as a text, whatever it begins with."""
    from openpyxl.cell import WriteOnlyCell  # noqa: PLC0415 - as above

    cell: Any = WriteOnlyCell(into, None)
    if isinstance(value, str):
        cell._value, cell.data_type = value, "s"  # noqa: SLF001 - the setter takes `=1+1` for a formula
        cell.quotePrefix = value.startswith(("=", "+", "-", "@"))  # stays a text when somebody edits it
    else:
        cell.value = value
    return cell


def _reproducible(data: bytes) -> bytes:
    """The same archive, every part of it with the same date."""
    made = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as new:
        for part in old.infolist():
            content = old.read(part)
            if part.filename == "docProps/core.xml":
                date = datetime(*DATE).isoformat().encode()  # noqa: DTZ001 - the zone follows
                content = CHANGED.sub(rb"\g<1>" + date + rb"Z\g<3>", content)
            entry = zipfile.ZipInfo(part.filename, DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            new.writestr(entry, content)
    return made.getvalue()
