"""Whether a register can be read and written, in the words of several languages."""

from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear
from regscribe.model import Access, Space


@dataclass(frozen=True, slots=True)
class AccessCell:
    """The access, and what else the cell says of it (`with code`), which the map does not say so."""

    access: Access
    remark: str = ""


def parse_access(text: str, header: str = "", space: Space | None = None) -> AccessCell | Unclear | None:
    """Read `R`, `RO`, `R/W`, `Lesen/Schreiben`, `lecture`; `yes` and `no` under a heading such as `writable`.

    An empty cell means `r` in a space that is only read; None where it says nothing.
    """
    return Unclear(f"{text} {header} {space}") if text else None
