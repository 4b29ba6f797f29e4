"""A register in the making: its keys in the order of the language, and what is to be said of its row."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from regscribe.draft import Remark
from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.scales import PLAIN, Scale
from regscribe.importers.table.cells.types import TypeCell
from regscribe.importers.table.layout import Item
from regscribe.model import Space, WireType

UNKNOWN = TypeCell()
"""Nothing is known of a type."""


class LeftOutError(Exception):
    """Raised for a row of which no register can be made: the remark says why."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.remark = Remark(code, message)


@dataclass(slots=True)
class Making:
    """One row while it becomes a register.

    `declared` are units that the map must declare; `order_assumed`: nothing states the order of its words.
    """

    item: Item
    at: int
    space: Space
    keys: dict[str, Any] = field(default_factory=dict)
    remarks: list[Remark] = field(default_factory=list)
    type: TypeCell = UNKNOWN
    scale: Scale | None = PLAIN
    declared: dict[str, Any] = field(default_factory=dict)
    order_assumed: bool = False

    @property
    def wire(self) -> WireType:
        """The type on the wire; a register that states none holds codes or bits of one word."""
        return WireType.BIT if self.space.is_bits else self.type.type or WireType.UINT16

    @property
    def words(self) -> int:
        """Addresses that it takes."""
        return 1 if self.space.is_bits else int(self.keys.get("length", 0)) or self.wire.words or self.type.words

    def set(self, keys: Mapping[str, Any]) -> None:
        """Add keys."""
        self.keys.update(keys)

    def lose(self, code: str, message: str) -> None:
        """A fact of the row is not in the map."""
        self.remarks.append(Remark(code, message))

    def ask(self, code: str, unclear: Unclear | str) -> None:
        """A fact is not in the map, because a person must decide it."""
        message = unclear if isinstance(unclear, str) else unclear.message
        self.remarks.append(Remark(code, message, todo=True))

    def tell(self, code: str, message: str) -> None:
        """Something is said of the row, and nothing of it is lost."""
        self.remarks.append(Remark(code, message, lossy=False))
