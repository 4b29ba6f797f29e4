"""Units as people spell them, as the symbols of the language; a scale in a unit (`0.1V`) is told apart."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.importers.table.cells import Unclear


@dataclass(frozen=True, slots=True)
class UnitCell:
    """The symbol, the factor that stood before it (None: none), and a unit that a map must declare (`known` is False).

    `signed`: a minus before the factor, by which some tables say that the number has a sign.
    """

    symbol: str
    factor: Fraction | None = None
    known: bool = True
    signed: bool = False
    stated: str = ""


def parse_unit(text: str) -> UnitCell | Unclear | None:
    """Read a cell of units; None if it is empty or says that there is none (`-`)."""
    return Unclear(text) if text else None
