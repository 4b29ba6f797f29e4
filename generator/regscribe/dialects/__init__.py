"""Words of other programs' configurations, shared by the exporter and the importer of a form; tables and no more.

Tables lead from the model to the word that is written. `read_back` turns one around; what a form knows besides, under
which nothing is written, stands in a table of its own.
"""

from collections.abc import Hashable, Mapping
from typing import TypeVar

from regscribe.model import Order, WireType

Orders = tuple[Order, Order]
"""The order of the words of a number, and that of the bytes in a word."""

ABCD: Orders = (Order.BIG, Order.BIG)
CDAB: Orders = (Order.LITTLE, Order.BIG)
BADC: Orders = (Order.BIG, Order.LITTLE)
DCBA: Orders = (Order.LITTLE, Order.LITTLE)
LETTERS: Mapping[Orders, str] = {ABCD: "ABCD", CDAB: "CDAB", BADC: "BADC", DCBA: "DCBA"}
"""What people of the field call an order, by a number of two words."""

T = TypeVar("T", bound=Hashable)


def read_back(table: Mapping[T, str]) -> dict[str, T]:
    """Return the same table from the word to what it means, the first that has it."""
    found: dict[str, T] = {}
    for meant, word in table.items():
        found.setdefault(word, meant)
    return found


def upper(*types: WireType) -> dict[WireType, str]:
    """Return a table in which types are called as here, in capitals."""
    return {one: one.upper() for one in types}


def lower(*types: WireType) -> dict[WireType, str]:
    """Return a table in which types are called as here."""
    return {one: one.value for one in types}
