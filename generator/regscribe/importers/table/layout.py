"""Tells registers from all other rows of a table: titles of sections, continued rows, footnotes, headers once more."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from regscribe.importers.table.columns import Column
from regscribe.importers.table.contents import is_address
from regscribe.importers.table.grid import Grid, Row
from regscribe.importers.table.header import Header
from regscribe.importers.table.headings import AT, IGNORE
from regscribe.model import Diagnostic

LONGEST_TITLE = 80
FOOTNOTE = re.compile(r"(?:[*†‡]|\(?\d\)|\d\.\s|[Nn]ote|NOTE|Hinweis|Anm|Remarque|注).*|.*[.;]$", re.DOTALL)
"""How footnotes begin or end, which titles of sections do not."""

PAGE = re.compile(r"(?:[Pp]age|PAGE|[Ss]eite|[Pp][aá]gina)\s+\d.*")
"""The number of a page, which is neither a title nor an address."""

CODE = re.compile(r"\d{1,5}\s*=\s*(?!\d*[.,]\d)\S.*")
"""A code with its label, but no `1 = 0.1 A`."""

JOINED = frozenset({"values", "bits", "description", "range"})
"""Columns whose cells go on in the rows below."""


@dataclass(frozen=True, slots=True)
class Item:
    """A row of a register: its cells by role, the title of the section above it, and the rows that continue it."""

    row: Row
    cells: dict[str, str]
    section: str = ""
    more: tuple[Row, ...] = ()
    lost: tuple[str, ...] = ()

    def __getitem__(self, role: str) -> str:
        """The text under a role; empty where there is none."""
        return self.cells.get(role, "")


@dataclass(slots=True)
class Layout:
    """The rows of registers, what was passed over, and faults of the rows."""

    items: list[Item] = field(default_factory=list)
    headers: int = 0
    sections: int = 0
    findings: list[Diagnostic] = field(default_factory=list)


def lay_out(grid: Grid, header: Header, columns: Sequence[Column]) -> Layout:
    """Sort the rows below the header."""
    found = Layout()
    section: Row | None = None
    used = True
    for row in grid.rows[header.last + 1 :]:
        if header.repeated_by(row, grid):
            found.headers += 1
        elif used and found.items and (code := _code(row, columns)):
            found.items[-1] = _with_code(found.items[-1], row, code)
        elif (title := _title(row, columns)) is not None:
            if section is not None and not used:
                found.findings.append(_stray(grid, section))
            section, used = (row, False) if _is_section(title) else (section, used)
            if section is not row:
                found.findings.append(_stray(grid, row))
        elif found.items and _continues(row, found.items[-1], columns):
            found.items[-1] = _continued(found.items[-1], row, columns)
        else:
            found.sections += bool(section is not None and not used)
            used = True
            found.items.append(_item(row, section, columns))
    if section is not None and not used:
        found.findings.append(_stray(grid, section))
    return found


def _title(row: Row, columns: Sequence[Column]) -> str | None:
    """The text of a row that says one thing only; None for others, and for an address alone."""
    own = {cell for at, cell in enumerate(row.cells) if cell and at not in row.repeated}
    if len(own) != 1:
        return None
    (text,) = own
    roles = {column.role for column in columns if row.cell(column.index) and column.index not in row.repeated}
    if (roles <= JOINED and roles) or (
        AT in roles and len(roles) == 1 and is_address(text) and not PAGE.fullmatch(text)
    ):
        return None
    return " ".join(text.split())


def _code(row: Row, columns: Sequence[Column]) -> str:
    """The code that a row says alone in a column that is not for it, as wrapped texts do; empty if there is none."""
    own = [at for at, cell in enumerate(row.cells) if cell and at not in row.repeated]
    if len(own) != 1 or any(column.index == own[0] and column.role in JOINED for column in columns):
        return ""
    return row.cells[own[0]] if CODE.fullmatch(row.cells[own[0]]) else ""


def _with_code(item: Item, row: Row, code: str) -> Item:
    role = "values" if item["values"] else "description"
    cells = item.cells | {role: f"{item[role]}\n{code}".strip()}
    return replace(item, cells=cells, more=(*item.more, row))


def _is_section(title: str) -> bool:
    return len(title) <= LONGEST_TITLE and not FOOTNOTE.fullmatch(title) and not PAGE.fullmatch(title)


def _stray(grid: Grid, row: Row) -> Diagnostic:
    text = " ".join(next(cell for cell in row.cells if cell).split())
    message = f"this row is no register and the title of none: `{text[:100]}`"
    return grid.warn("note", message, row, "read it: it may say something of registers")


def _item(row: Row, section: Row | None, columns: Sequence[Column]) -> Item:
    title = " ".join(next(filter(None, section.cells)).split()) if section is not None else ""
    return Item(row, _cells(row, columns), title)


def _cells(row: Row, columns: Sequence[Column]) -> dict[str, str]:
    """Texts by role; columns of one role are joined, but for addresses, whose columns are read apart."""
    found: dict[str, list[str]] = {}
    for column in columns:
        if column.role not in {"", IGNORE, AT} and (text := row.cell(column.index)):
            found.setdefault(column.role, []).append(text)
    return {role: "\n".join(dict.fromkeys(texts)) for role, texts in found.items()}


def _continues(row: Row, before: Item, columns: Sequence[Column]) -> bool:
    """Whether a row says more of the register above: it has neither address nor name of its own."""
    own = {column.role for column in columns if row.cell(column.index) and column.index not in row.repeated}
    if AT in own or "bit" in own:
        return False
    repeated_name = all(
        row.cell(column.index) == before.row.cell(column.index) for column in columns if column.role == "name"
    )
    return bool(own & JOINED) and ("name" not in own or repeated_name)


def _continued(item: Item, row: Row, columns: Sequence[Column]) -> Item:
    cells, lost = dict(item.cells), list(item.lost)
    for column in columns:
        text = row.cell(column.index)
        if not text or column.index in row.repeated or column.role in {"", IGNORE, AT}:
            continue
        before = cells.get(column.role, "")
        if column.role in JOINED:
            cells[column.role] = f"{before}\n{text}".strip()
        elif not before:
            cells[column.role] = text
        elif text != before:
            lost.append(f"{row.where} says `{text[:60]}` too")
    return replace(item, cells=cells, more=(*item.more, row), lost=tuple(lost))
