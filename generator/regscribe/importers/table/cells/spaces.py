"""Address spaces, as a column says them: by function codes, by words, by the leading digit."""

from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear
from regscribe.model import Space


@dataclass(frozen=True, slots=True)
class SpaceCell:
    """The space of a row, and the function codes that the cell names, if it names some."""

    space: Space
    functions: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class SpaceColumn:
    """The spaces of all rows (None: the cell is empty), with a sentence that says how bare digits are read."""

    evidence: str
    cells: tuple[SpaceCell | Unclear | None, ...]


def parse_spaces(texts: Sequence[str], header: str = "") -> SpaceColumn:
    """Read a column that says where registers are: `03`, `FC4`, `0x03/0x06`, `Holding`, `Input Register`, `4x`."""
    words = {"holding": Space.HOLDING, "input": Space.INPUT, "coil": Space.COIL, "discrete": Space.DISCRETE}
    found = (words.get(text.strip().lower()) for text in texts)
    return SpaceColumn(header, tuple(SpaceCell(one) if one else None for one in found))


def parse_space(text: str) -> SpaceCell | Unclear | None:
    """Read the space that words say, of a section's title or a sheet's name; None where they say none."""
    return parse_spaces((text,)).cells[0]
