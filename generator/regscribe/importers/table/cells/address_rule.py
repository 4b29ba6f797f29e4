"""How one column of addresses is read, and from what plain numbers count."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from regscribe.importers.table.cells.notations import Printed
from regscribe.importers.table.cells.spaces import REGIONS

FROM_ZERO = re.compile(
    r"\bpdu\b|\b(?:0|zero)[\s-]?based|\bbase[\s-]?(?:0|zero)\b|protocol|\bwire\b|(?:start|count)\w* (?:at|from|with) 0",
    re.IGNORECASE,
)
_FROM_ONE = re.compile(
    r"\b(?:1|one)[\s-]?based|\bbase[\s-]?(?:1|one)\b|\bplc\b|modicon|(?:start|count)\w* (?:at|from|with) 1",
    re.IGNORECASE,
)
LAST = 0xFFFF
"""The last wire address."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Rule:
    """How a column is read.

    `digits`: the base of digits without a mark (10 or 16). `base`: from what plain numbers count; `region_base`: from
    what those behind `4x` and `4:` do. `regions`: whether 40001 is the first holding register. `unclear` says of a cell
    why it cannot be read while others can; None: all can.
    """

    notation: str = "decimal"
    evidence: str = ""
    digits: int = 10
    base: int = 0
    region_base: int = 1
    regions: bool = False
    by_function: bool | None = False
    assumed: bool = False
    unclear: Callable[[Printed], str] | None = None

    def reads(self, one: Printed) -> bool:
        """Whether the digits of a cell are digits in the base of the column."""
        return one.form != "letters" or self.digits != 10  # noqa: PLR2004 - decimal

    def doubt(self, one: Printed) -> str:
        """Why a cell is unclear; empty if it is not."""
        if one.prefix is not None and self.by_function is None:
            return f"begins with a function or the digit of a space: whether {one.prefix} is which, is not clear"
        return self.unclear(one) if self.unclear else ""

    def modicon(self, one: Printed) -> tuple[int, int] | None:
        """The region and the number in it of a plain number of five or six digits, if the column has such."""
        if not self.regions or not is_plain(one):
            return None
        return int(one.digits[0]), int(one.digits[1:])

    def base_of(self, one: Printed) -> int:
        """From what the number of a cell counts."""
        in_region = one.region is not None or (one.prefix is not None and not self.by_function)
        return 1 if self.modicon(one) else self.region_base if in_region else self.base


def is_plain(one: Printed) -> bool:
    """Whether a cell has nothing but decimal digits that may be Modicon's."""
    return one.form == "decimal" and one.region is None and one.prefix is None and one.space is None


def has_region(one: Printed) -> bool:
    """Whether it may be a number of Modicon's: five or six digits, the first of a region, and not the 0th."""
    return is_plain(one) and len(one.digits) in {5, 6} and int(one.digits[0]) in REGIONS and int(one.digits[1:]) > 0


def counted_from(numbers: Sequence[int], header: str, said: set[str]) -> tuple[int, str, bool]:
    """From what plain numbers count, why, and whether it is assumed."""
    if said & {"0", "1"}:
        base = int("1" in said)
        return base, f"addresses count from {base}, as the user says", False
    if 0 in numbers:
        return 0, "the address 0 occurs, so they count from 0", False
    for base, words in ((0, FROM_ZERO), (1, _FROM_ONE)):
        if words.search(header):
            return base, f"the heading `{header.strip()}` says that they count from {base}", False
    if LAST + 1 in numbers:
        return 1, "the address 65536 occurs, so they count from 1", False
    least = f"the least is {min(numbers)}" if numbers else "there are none"
    return (
        0,
        f"addresses are taken as printed, counted from 0, which nothing in the table shows ({least}): check one",
        True,
    )
