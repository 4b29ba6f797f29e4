"""Addresses in every notation: which one, and from what it counts, is decided once for the whole column."""

from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear
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
    `assumed`: nothing in the table shows from what the addresses count, so a person must check one of them.
    """

    notation: str
    evidence: str
    cells: tuple[Address | Unclear | None, ...]
    assumed: bool = False


def parse_addresses(
    columns: Sequence[Column],
    *,
    spaces: Sequence[Space | None] = (),
    base: str = "",
) -> AddressColumn:
    """Read one column of addresses, or several of the same registers (hexadecimal and decimal, or one apart).

    `spaces` are those that other columns say, row by row. `base` is what the user says: `0` or `1` (from what the
    numbers count), `modicon` (40001 is the first holding register), `hex` or `decimal`, several joined by commas.
    """
    cells = tuple(Address(int(text)) if text.isdecimal() else Unclear(text) for text in columns[0].texts)
    return AddressColumn("decimal", "", cells, assumed=not (spaces or base))


def base_words() -> tuple[str, ...]:
    """The words that `base` of `parse_addresses` takes."""
    return ("0", "1", "modicon", "hex", "decimal")
