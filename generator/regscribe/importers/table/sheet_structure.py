"""What a sheet says beside its values: merged cells, hidden rows and columns, formulas that were never calculated."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import IO
from xml.etree.ElementTree import Element

from defusedxml.ElementTree import iterparse

from regscribe.importers.table.grid import MOST_ROWS, Lines, TableError, letters, number_of, too_many

MOST_LINES = 1_048_576
"""The last row of a sheet."""

MOST_MERGED = 100_000


@dataclass(frozen=True, slots=True)
class Area:
    """Cells from one corner to the other, both included; rows count from 1, columns from 0."""

    top: int
    left: int
    bottom: int
    right: int


@dataclass(slots=True)
class Structure:
    """What a sheet says beside its values; `unvalued` are cells with a formula and no result."""

    merged: list[Area] = field(default_factory=list)
    hidden_rows: list[int] = field(default_factory=list)
    hidden_columns: list[str] = field(default_factory=list)
    unvalued: list[str] = field(default_factory=list)


def structure(part: IO[bytes], sheet: str, name: str, lines: Lines) -> Structure:
    """Read the XML of a sheet, piece by piece; `lines` are those that count.

    Raises TableError for rows where no sheet has any, and for more of them than are read.
    """
    found = Structure()
    filled = 0
    for element in _elements(part):
        kind = element.tag.rpartition("}")[2]
        if kind == "row":
            number = _row(element, found, sheet)
            filled += len(element) > 0 and lines[0] <= number <= lines[1] and _has_values(element)
            if filled > MOST_ROWS:
                raise too_many(name, f"sheet {sheet}, row {number}", number)
        elif kind == "mergeCell" and (area := area_of(element.get("ref", ""))):
            found.merged.append(area)
        elif kind == "col" and element.get("hidden") in {"1", "true"}:
            first, last = int(element.get("min", "1")), int(element.get("max", "1"))
            found.hidden_columns += [letters(number - 1) for number in range(first, min(last, first + 50) + 1)]
    if len(found.merged) > MOST_MERGED:
        message = f"sheet {sheet} has {len(found.merged)} merged areas, more than the {MOST_MERGED} that are read"
        raise TableError(message)
    return found


def _elements(part: IO[bytes]) -> Iterator[Element]:
    """The elements of interest when they are whole; what was seen is forgotten."""
    path: list[Element] = []
    for event, element in iterparse(part, events=("start", "end")):
        if event == "start":
            path.append(element)
            continue
        path.pop()
        if element.tag.endswith(("}row", "}mergeCell", "}col")):
            yield element
            if path:
                path[-1].remove(element)


def _has_values(element: Element) -> bool:
    return any(child.tag.endswith(("}v", "}is")) for cell in element for child in cell)


def _row(element: Element, found: Structure, sheet: str) -> int:
    """Keep what a row says, and return its number."""
    number = element.get("r", "")
    if number.isdecimal() and int(number) > MOST_LINES:
        message = f"sheet {sheet} has a row {number}, and a sheet ends with row {MOST_LINES}: the workbook is broken"
        raise TableError(message)
    if element.get("hidden") in {"1", "true"} and number.isdecimal():
        found.hidden_rows.append(int(number))
    for cell in element:
        parts = {child.tag.rpartition("}")[2]: child.text for child in cell}
        if "f" in parts and not parts.get("v") and "is" not in parts:
            found.unvalued.append(cell.get("r", "?"))
    return int(number) if number.isdecimal() else 0


def area_of(text: str) -> Area | None:
    """The cells that `A5:H20` names, also `5:20`, `A:H` and `B7` alone; None for other texts."""
    begin, colon, end = text.replace("$", "").strip().partition(":")
    first, last = _corner(begin), _corner(end if colon else begin)
    if first is None or last is None:
        return None
    (top, left), (bottom, right) = first, last
    area = Area(top or 1, left or 0, bottom or MOST_LINES, MOST_LINES if right is None else right)
    return area if area.top <= area.bottom and area.left <= area.right else None


def _corner(text: str) -> tuple[int | None, int | None] | None:
    """Row and column of a corner, None for the one that it does not say; None for other texts."""
    name = text.rstrip("0123456789")
    row = text[len(name) :]
    column = number_of(name) if name else None
    if not text or (name and column is None) or (row and not 1 <= int(row[:9]) <= MOST_LINES):
        return None
    return (int(row[:9]) if row else None), column
