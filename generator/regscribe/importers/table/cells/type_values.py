"""What a cell of a type says, and its words while it is read."""

from dataclasses import dataclass
from typing import NamedTuple

from regscribe.importers.table.cells.dialects import Dialect
from regscribe.importers.table.cells.sizes import Size
from regscribe.model import Order, WireType

WORD_BITS = 16


@dataclass(frozen=True, slots=True, kw_only=True)
class TypeCell:
    """The type that a row says.

    `type` is None where it says an order or a kind alone. `words` are the registers that it takes, 0 if not said (a
    text without length). Orders are None where the cell says none. `kind` is `flags`, `enum` or `boolean`, where a word
    says so. `encoding` is that of a text, `layout` that of a date, if they are said; `bits` is the number of bits of a
    part of a word (`2bit`). `stated` says in a sentence how a length was read.
    """

    type: WireType | None = None
    words: int = 0
    word_order: Order | None = None
    byte_order: Order | None = None
    kind: str = ""
    encoding: str = ""
    layout: str = ""
    bits: int = 0
    stated: str = ""


class Words(NamedTuple):
    """The words of a type without an order: in small letters, and folded; the size beside them; the cell."""

    plain: str
    folded: str
    dialect: Dialect
    size: Size | None
    text: str
    gap: int
