"""Scales, as people write them; whether a bare number multiplies or divides is decided once for the column."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from typing import Any

from regscribe.importers.table.cells import Unclear


class Way(StrEnum):
    """What a bare number in the column does with the stored number."""

    MULTIPLY = "multiply"
    DIVIDE = "divide"
    DECIMALS = "decimals"


@dataclass(frozen=True, slots=True)
class Scale:
    """The value is the stored number times `multiply`, plus `add`; `unit` stands beside it (`1 = 0.1 A`)."""

    multiply: Fraction = Fraction(1)
    add: Fraction = Fraction(0)
    unit: str = ""

    @property
    def keys(self) -> Mapping[str, Any]:
        """The keys of a register that say it: `decimals` for powers of ten, else `multiply` or `divide`; and `add`."""
        return {}

    def of(self, stored: Fraction) -> Fraction:
        """The value of a stored number."""
        return stored * self.multiply + self.add

    def back(self, value: Fraction) -> Fraction:
        """The stored number of a value."""
        return (value - self.add) / self.multiply


PLAIN = Scale()


@dataclass(frozen=True, slots=True)
class ScaleColumn:
    """The scales of all rows (None: the cell is empty), what bare numbers do, and the evidence in a sentence.

    `assumed`: the table does not show it.
    """

    way: Way | None
    evidence: str
    cells: tuple[Scale | Unclear | None, ...]
    assumed: bool = False


def parse_scales(texts: Sequence[str], header: str = "", *, way: str = "") -> ScaleColumn:
    """Read a column of scales; `way` is what the user says of bare numbers: `multiply`, `divide` or `decimals`."""
    return ScaleColumn(Way(way) if way else None, header, tuple(None for _ in texts))


def parse_scale(text: str, way: Way | None = None, *, comma: bool | None = None) -> Scale | Unclear | None:
    """Read one cell; a bare number needs a `way`. `comma`: whether a comma is the decimal point (None: as it looks)."""
    return Unclear(f"{text} {way} {comma}") if text else None


def parse_offset(text: str, *, comma: bool | None = None) -> Fraction | Unclear | None:
    """Read a cell that is added to the value."""
    return Unclear(f"{text} {comma}") if text else None
