"""What a column of addresses says, as a whole and row by row."""

from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.address_rule import Rule
from regscribe.model import Space


@dataclass(frozen=True, slots=True)
class Address:
    """One cell: the wire address, and what else the text says.

    `space` is None where the text does not say it; `count` is the registers of a range, 0 where none stands; `bits` are
    the lowest and the highest bit of `1234.5`.
    """

    at: int
    space: Space | None = None
    count: int = 0
    bits: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class Column:
    """A column of texts with its heading."""

    header: str
    texts: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class AddressColumn:
    """The addresses of all rows (None: the cell is empty).

    `notation` names how they are written, `evidence` says in a sentence why they are read so and how to say otherwise.
    `assumed`: nothing in the table shows from what the addresses count, so a person must check one of them. `words` are
    those of `base` by which the next version of the table is read alike; empty where the texts say it themselves.
    """

    notation: str
    evidence: str
    cells: tuple[Address | Unclear | None, ...]
    assumed: bool = False
    words: str = ""


@dataclass(frozen=True, slots=True)
class Reading:
    """A column as it reads alone: its texts, the rule, the addresses that follow, and the printed numbers."""

    header: str
    texts: tuple[str, ...]
    rule: Rule
    cells: tuple[Address | Unclear | None, ...]
    numbers: tuple[int | None, ...]
