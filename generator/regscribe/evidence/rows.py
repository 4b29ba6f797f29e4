"""The rows of a map and of a table in one form: what each says of one register of one model."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field

from regscribe.emit.words import one_line
from regscribe.evidence.cell_compare import problem
from regscribe.evidence.columns import Columns, fold
from regscribe.evidence.differences import Location
from regscribe.evidence.table import Table, TableError, TableRow
from regscribe.export.csv import rows
from regscribe.model import Notation, RegisterMap, Space

NO_REGISTERS = frozenset({"command", "computed"})
MOST_PROBLEMS = 10
"""Faults of a table that one error lists."""

STRETCH = re.compile(r"\s*([0-9]{1,9})(?:\.0+)?\s*(?:(?:\.\.|-|\u2013)\s*([0-9]{1,9})\s*)?")
MOST_ADDRESSES = 1_000_000
"""Beyond every notation: Modicon's six digits end before."""

SILENT = frozenset({"", "-", "\u2013", "unused", "notused", "reserved"})
"""Names, letters alone, of a row that says that there is no register."""

ELSEWHERE = ("block", "page", "unit_id", "file", "queue")
"""Columns of registers whose address alone says nothing: they are found by their id."""

Spot = tuple[str, int]
"""Address space (empty: any) and wire address."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedRow:
    """One row of one model: the spots where it may stand (several if the table leaves the space open) and its cells."""

    model: str
    id: str
    spots: tuple[Spot, ...]
    cells: dict[str, str] = field(hash=False)
    aliases: tuple[Spot, ...] = ()
    line: int = 0

    @property
    def is_command(self) -> bool:
        """Whether it is a command or a computed value and no register."""
        return self.cells.get("kind", "").strip() in NO_REGISTERS

    @property
    def is_silent(self) -> bool:
        """Whether a row of a table says that there is no register (a hyphen for a name)."""
        name = re.sub(r"[\s_]+", "", self.cells.get("name", "named").casefold())
        return name in SILENT and not self.id

    @property
    def place(self) -> Location:
        """The entry as a comparison reports it."""
        space, address = self.spots[0] if self.spots else (self.cells.get("space", ""), "")
        name = one_line(self.cells.get("name", ""))
        return Location(model=self.model, space=space, address=str(address), id=self.id, name=name, line=self.line)


def of_map(register_map: RegisterMap) -> Iterator[ComparedRow]:
    """Yield a row for each register and command of each model, with its address in every notation, too."""
    for row in rows([register_map]):
        space, elsewhere = row.space, any(getattr(row, name) for name in ELSEWHERE)
        spots = ((space, int(row.address)),) if row.address and not elsewhere else ()
        aliases = tuple((space, int(alias)) for alias in row.aliases.split() if not elsewhere)
        printed = {
            fold(notation.name): str(spots[0][1] + notation.offset)
            for notation in register_map.notations
            if spots and notation.space.value == space
        }
        cells = printed | row._asdict()
        yield ComparedRow(model=row.model, id=row.id, spots=spots, cells=cells, aliases=aliases)


def of_table(table: Table, columns: Columns, register_map: RegisterMap, model: str) -> Iterator[ComparedRow]:
    """Yield an entry for each model of each row; without a column `model` every row is about `model`.

    Rows of another map are left out. Raises TableError, naming every row concerned, for cells that cannot be read and
    rows that do not tell which register they are about.
    """
    faults: list[str] = []
    for row in table.rows:
        cells = {name: row.cells[index] for name, index in columns.at.items()}
        if cells.get("map", register_map.id).strip() != register_map.id:
            continue
        found: list[str] = []
        rows_of_models = _entries(row, cells, register_map, model, found)
        faults += [f"{table.name}:{row.line}: {fault}" for fault in found]
        if not found:
            yield from rows_of_models
    if faults:
        more = f"\nand {len(faults) - MOST_PROBLEMS} more" if len(faults) > MOST_PROBLEMS else ""
        raise TableError("\n".join(faults[:MOST_PROBLEMS]) + more)


def _entries(
    row: TableRow, cells: dict[str, str], register_map: RegisterMap, model: str, faults: list[str]
) -> list[ComparedRow]:
    """Return an entry for each model and address of a row; what is wrong with it goes to `faults`."""
    faults += [f"column {name}: {fault}" for name, text in cells.items() if (fault := problem(name, text))]
    stands = _stands(cells, register_map.notations, faults)
    models = _models(cells, register_map, model, faults)
    path = cells.get("id", "").strip()
    if not stands and not path and not faults:
        faults.append("there is neither an address nor an id, so nothing tells which register this is")
    return [
        ComparedRow(model=name, id=path, spots=spots, cells={**cells, **written}, line=row.line)
        for name in models
        for written, spots in stands or [({}, ())]
    ]


Stand = tuple[dict[str, str], tuple[Spot, ...]]
"""One address of a row, as it is written (by column), and the places that it may mean."""


def _stands(cells: dict[str, str], notations: Sequence[Notation], faults: list[str]) -> list[Stand]:
    """Return where a row may stand, for each of its addresses: wire addresses, or those of a notation of the map."""
    space = cells.get("space", "").strip().casefold()
    if space not in {"", *Space}:
        faults.append(f"column space: `{space[:60]}` is none of {', '.join(Space)}")
    if any(cells.get(name, "").strip() for name in ELSEWHERE):
        return []
    names = ["address", *(notation.name for notation in notations)]
    filled = next((name for name in names if cells.get(fold(name), "").strip()), None)
    if filled is None:
        return []
    name = fold(filled)
    offsets = _offsets(name, space, notations)
    if not offsets:
        faults.append(f"column {name}: the map has no notation {filled} for the space {space}")
        return []
    return [
        ({name: str(written)}, tuple((own, written - offset) for own, offset in offsets))
        for written in _addresses(name, cells[name], faults)
    ]


def _offsets(column: str, space: str, notations: Sequence[Notation]) -> list[tuple[str, int]]:
    """What the address in a column counts from, in each space that it may mean."""
    if column == "address":
        return [(space, 0)]
    return [
        (one.space.value, one.offset)
        for one in notations
        if fold(one.name) == column and space in {"", one.space.value}
    ]


def _addresses(column: str, text: str, faults: list[str]) -> Iterable[int]:
    """Return the address, or every address of a stretch `16..28`."""
    ends = STRETCH.fullmatch(text)
    first, last = (int(ends[1]), int(ends[2] or ends[1])) if ends else (0, -1)
    if first <= last < MOST_ADDRESSES:
        return range(first, last + 1)
    faults.append(f"column {column}: `{one_line(text)[:60]}` is neither a decimal address nor a stretch like 16..28")
    return ()


def _models(cells: dict[str, str], register_map: RegisterMap, model: str, faults: list[str]) -> list[str]:
    """Return the models that a row is about: one name, or several separated by commas, semicolons or blanks.

    A name may hold separators itself: the coarsest split counts of which all parts are models, else the finest.
    """
    if "model" not in cells:
        return [model]
    known = {one_line(one.name) for one in register_map.models}
    separators = (r"$^", r"\s*[,;]\s*", r"[,;\s]+")
    splits = [list(filter(None, re.split(separator, one_line(cells["model"])))) for separator in separators]
    parts = next((parts for parts in splits if parts and known.issuperset(parts)), splits[-1])
    if not parts:
        faults.append("the cell of the column model is empty: name the models that have this register")
    return list(dict.fromkeys(part for part in parts if model in {"", part}))
