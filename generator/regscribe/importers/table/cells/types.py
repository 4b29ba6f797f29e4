"""Wire types, as people write them; words that mean different widths to different people are read in a dialect."""

from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear
from regscribe.model import WireType
from regscribe_runtime.values.wire_types import Order


@dataclass(frozen=True, slots=True)
class Dialect:
    """How wide the words are that mean different widths to different people; None: not known, so they are unclear.

    `uint` stands for UINT, `int` for INT, `long` for LONG and ULONG, `byte` for BYTE, `word` for WORD, in bits.
    `characters`: whether the number of a text (`string[6]`) counts characters and no registers.
    """

    int_bits: int | None = None
    uint_bits: int | None = None
    long_bits: int | None = 32
    byte_bits: int | None = None
    word_bits: int | None = 16
    characters: bool | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class TypeCell:
    """The type that a cell says.

    `type` is None where it says an order, a sign or a kind alone. `words` are the registers that it takes, 0 if not
    said (a text without length). Orders are None where the cell says none. `kind` is `flags`, `enum`, `boolean` or
    `version`, where a word says so.
    """

    type: WireType | None = None
    words: int = 0
    word_order: Order | None = None
    byte_order: Order | None = None
    kind: str = ""
    encoding: str = ""
    signed: bool | None = None


@dataclass(frozen=True, slots=True)
class DialectChoice:
    """The dialect of a table, with a sentence for each word that it decides, and the evidence."""

    dialect: Dialect
    stated: tuple[str, ...]


def parse_type(text: str, dialect: Dialect, *, size: str = "", gap: int = 0) -> TypeCell | Unclear | None:
    """Read the cells of type and size of one row (`U16`, `UDINT swapped`, `STRING(16)`; `2 words`, `32 bit`).

    `gap` is the distance to the next register of the space, 0 if not known.
    """
    word = text.strip().lower()
    if not word:
        return None
    if word not in list(WireType):
        return Unclear(f"{text} {size} {gap} {dialect}")
    return TypeCell(type=WireType(word), words=WireType(word).words)


def choose_dialect(texts: Sequence[str], sizes: Sequence[str], gaps: Sequence[int]) -> DialectChoice:
    """Decide what UINT, INT, LONG, BYTE and lengths of texts mean in a table, by the gaps to the next rows.

    `sizes` are the cells of a size column, empty ones where there is none; `gaps` are distances to the next register,
    0 where not known.
    """
    return DialectChoice(Dialect(), (*texts, *sizes, *map(str, gaps))[:0])


def parse_order(text: str) -> tuple[Order | None, Order | None] | Unclear | None:
    """Read words for the order of words and bytes (`CDAB`, `little endian`, `swapped`, `Lo-Hi`): (words, bytes)."""
    return Unclear(text) if text else None
