"""What a comparison finds: frozen values, printed by the CLI alone."""

from collections import Counter
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Location:
    """A row of one side: its model, where it stands, and its line in the table (0: it is of a map).

    `address` is a decimal wire address, or empty where the row gives none.
    """

    model: str
    space: str
    address: str
    id: str
    name: str
    line: int = 0


@dataclass(frozen=True, slots=True)
class CellDifference:
    """One cell that differs: `ours` is what the map says, `theirs` what the table (or the second map) says."""

    place: Location
    column: str
    ours: str
    theirs: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """A map held against a table or another map.

    `columns` are those that were compared, `matched` the rows of the table that have their counterpart in the map;
    `notes` are remarks that count as no difference.
    """

    ours: str
    theirs: str
    columns: tuple[str, ...]
    matched: int
    only_ours: tuple[Location, ...] = ()
    only_theirs: tuple[Location, ...] = ()
    differences: tuple[CellDifference, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def equal(self) -> bool:
        """Whether nothing differs."""
        return not (self.only_ours or self.only_theirs or self.differences)

    @property
    def counts(self) -> dict[str, int]:
        """How many cells differ, by column, in the order of the columns; columns without a difference are left out."""
        found = Counter(difference.column for difference in self.differences)
        return {column: found[column] for column in self.columns if found[column]}
