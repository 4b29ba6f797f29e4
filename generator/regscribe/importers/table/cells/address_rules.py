"""How a column writes addresses, and from what it counts: decided on evidence, with a sentence that says it."""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.notations import Printed
from regscribe.importers.table.cells.spaces import REGIONS
from regscribe.model import Space

_HEX = re.compile(r"\bhex|0x|\bh\b|\$", re.IGNORECASE)
_DECIMAL = re.compile(r"\bdec", re.IGNORECASE)
_FROM_ZERO = re.compile(
    r"\bpdu\b|\b(?:0|zero)[\s-]?based|\bbase[\s-]?(?:0|zero)\b|protocol|\bwire\b|(?:start|count)\w* (?:at|from|with) 0",
    re.IGNORECASE,
)
_FROM_ONE = re.compile(
    r"\b(?:1|one)[\s-]?based|\bbase[\s-]?(?:1|one)\b|\bplc\b|modicon|(?:start|count)\w* (?:at|from|with) 1",
    re.IGNORECASE,
)
_FUNCTION = re.compile(r"func|\bfc\b|funktion|fonction", re.IGNORECASE)

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


def _has_region(one: Printed) -> bool:
    """Whether it may be a number of Modicon's: five or six digits, the first of a region, and not the 0th."""
    return is_plain(one) and len(one.digits) in {5, 6} and int(one.digits[0]) in REGIONS and int(one.digits[1:]) > 0


def decide(
    read: Sequence[Printed | Unclear | None], header: str, spaces: Sequence[Space | None], said: set[str]
) -> Rule:
    """The rule of a column, by what its cells, its heading, the spaces beside it and the user say."""
    known = [one for one in read if isinstance(one, Printed)]
    digits, why_digits, doubt = _digits(known, header, said)
    by_function, why_prefix = _prefixes(known, header, said)
    if digits == 10 and (rule := _modicon(known, read, header, spaces, said)):  # noqa: PLR2004 - decimal
        return rule
    numbers = [one.number(digits) for one in known if one.form != "letters" or digits == 16]  # noqa: PLR2004 - hex
    base, why_base, assumed = _base(numbers, header, said)
    has_regions = any(one.region is not None or (one.prefix is not None and by_function is False) for one in known)
    only_regions = has_regions and all(one.region is not None or one.prefix is not None for one in known)
    region_base = _region_base(known, said)
    evidence = "; ".join(filter(None, (why_digits, why_prefix, _of_regions(region_base) if only_regions else why_base)))
    notation = "regions" if only_regions else "hexadecimal" if digits == 16 or _all_hex(known) else "decimal"  # noqa: PLR2004 - hex
    return Rule(
        notation=notation,
        evidence=evidence,
        digits=digits,
        base=base,
        region_base=region_base,
        by_function=by_function,
        assumed=assumed and not only_regions,
        unclear=doubt,
    )


def _all_hex(known: Sequence[Printed]) -> bool:
    return bool(known) and all(one.form == "hex" for one in known)


def _of_regions(base: int) -> str:
    return f"the leading digit is that of a space, and the numbers behind it count from {base}"


def _digits(known: Sequence[Printed], header: str, said: set[str]) -> tuple[int, str, Callable[[Printed], str] | None]:
    """The base of digits without a mark, why, and which cells are unclear."""
    if said & {"hex", "decimal"}:
        base = 16 if "hex" in said else 10
        return base, f"digits without a mark are {'hexadecimal' if base == 16 else 'decimal'}, as the user says", None  # noqa: PLR2004 - hex
    letters = [one for one in known if one.form == "letters"]
    if _HEX.search(header) and not _DECIMAL.search(header):
        return 16, f"the heading `{header.strip()}` says that they are hexadecimal", None
    if letters and not _DECIMAL.search(header):
        return 16, f"`{letters[0].digits.upper()}` has letters, so all are hexadecimal", None
    marked = sum(one.form == "hex" for one in known)
    if marked and marked * 2 > len(known) > marked:
        return 10, "most are marked as hexadecimal", _lacks_mark
    return 10, "", None


def _lacks_mark(one: Printed) -> str:
    return "" if one.form == "hex" else "lacks the mark of hexadecimal numbers that most others have"


def _prefixes(known: Sequence[Printed], header: str, said: set[str]) -> tuple[bool | None, str]:
    """Whether the digit of `4:1` is a function; None: it is not clear."""
    found = {one.prefix for one in known if one.prefix is not None}
    if not found:
        return False, ""
    shown = ", ".join(f"{digit}:" for digit in sorted(found))
    if "modicon" in said:
        return False, f"{shown} are leading digits of numbers, as the user says"
    if _FUNCTION.search(header) or found - set(REGIONS):
        return True, f"{shown} are functions"
    padded = any(one.prefix is not None and len(one.digits) > 1 and one.digits[0] == "0" for one in known)
    if 0 in found or padded or found == {4}:
        return False, f"{shown} are leading digits of numbers, where 3: are input and 4: are holding registers"
    return None, f"{shown} are functions or leading digits of numbers, which is not clear"


def _region_base(known: Sequence[Printed], said: set[str]) -> int:
    if said & {"0", "1"}:
        return int("1" in said)
    return int(not any(one.number(10) == 0 for one in known if one.region is not None or one.prefix is not None))


def _modicon(
    known: Sequence[Printed],
    read: Sequence[Printed | Unclear | None],
    header: str,
    spaces: Sequence[Space | None],
    said: set[str],
) -> Rule | None:
    """The rule where numbers begin with the digit of a space; None where they do not."""
    plain = [one for one in known if is_plain(one)]
    long = [one for one in plain if len(one.digits) == 6 and _has_region(one)]  # noqa: PLR2004 - six digits
    with_region = [one for one in plain if _has_region(one)]
    if not with_region or said & {"0", "1"} or (_FROM_ZERO.search(header) and not long):
        return None
    length = 6 if long else 5
    others = [one for one in known if not (_has_region(one) and len(one.digits) == length)]
    if long or "modicon" in said:
        return _regions(f"numbers such as {with_region[0].digits} begin with the digit of a space", others, length)
    if others:
        return _mixed(with_region, others)
    contrary = sum(
        isinstance(one, Printed) and space is not None and _has_region(one) and REGIONS[int(one.digits[0])] is not space
        for one, space in zip(read, spaces, strict=False)
    )
    if contrary * 2 > len(with_region):
        return None
    digits = "".join(sorted({one.digits[0] for one in with_region}))
    evidence = f"all numbers have five digits and begin with that of a space ({', '.join(digits)})"
    return _regions(f"{evidence}, so 40001 is the wire address 0: pass the base 0 if they are sent as printed", (), 5)


def _regions(evidence: str, others: Sequence[Printed], length: int) -> Rule:
    def unclear(one: Printed) -> str:
        plain = is_plain(one) and not (_has_region(one) and len(one.digits) == length)
        return f"is no number of {length} digits that begins with that of a space, as others are" if plain else ""

    return Rule(notation="modicon", evidence=evidence, regions=True, unclear=unclear if others else None)


def _mixed(with_region: Sequence[Printed], others: Sequence[Printed]) -> Rule | None:
    """Numbers such as 40001 beside others: plain, if the others show it; else they are unclear."""
    numbers = [one.number(10) for one in others if is_plain(one)]
    leading = {one.digits[0] for one in with_region if not one.digits.startswith("0")}
    if any(number >= 10000 for number in numbers) or not leading - {"1"} or not numbers:  # noqa: PLR2004 - five digits
        return None

    def unclear(one: Printed) -> str:
        if not is_plain(one) or one.digits.startswith("0"):
            return ""
        other = f"others are as low as {min(numbers)}" if _has_region(one) else f"others are {with_region[0].digits}"
        return f"may count in its space or be a plain address: {other} (pass the base modicon or 0)"

    base, why, assumed = _base(numbers, "", set())
    return Rule(evidence=why, base=base, assumed=assumed, unclear=unclear)


def _base(numbers: Sequence[int], header: str, said: set[str]) -> tuple[int, str, bool]:
    """From what plain numbers count, why, and whether it is assumed."""
    if said & {"0", "1"}:
        base = int("1" in said)
        return base, f"addresses count from {base}, as the user says", False
    if 0 in numbers:
        return 0, "the address 0 occurs, so they count from 0", False
    for base, words in ((0, _FROM_ZERO), (1, _FROM_ONE)):
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
