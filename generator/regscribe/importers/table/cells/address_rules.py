"""How a column writes addresses, and from what it counts: decided on evidence, with a sentence that says it."""

import re
from collections.abc import Callable, Sequence

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.address_rule import Rule, counted_from
from regscribe.importers.table.cells.modicon import modicon_rule
from regscribe.importers.table.cells.notations import Printed
from regscribe.importers.table.cells.spaces import REGIONS
from regscribe.model import Space

_HEX = re.compile(r"\bhex|0x|\bh\b|\$", re.IGNORECASE)
_DECIMAL = re.compile(r"\bdec", re.IGNORECASE)
_FUNCTION = re.compile(r"func|\bfc\b|funktion|fonction", re.IGNORECASE)


def decide(
    read: Sequence[Printed | Unclear | None],
    header: str,
    spaces: Sequence[Space | None],
    said: set[str],
    words: Sequence[bool],
) -> Rule:
    """The rule of a column, by what its cells, its heading, the spaces and types beside it and the user say."""
    known = [one for one in read if isinstance(one, Printed)]
    digits, why_digits, doubt = _digits(known, header, said)
    by_function, why_prefix = _prefixes(known, header, said)
    if digits == 10 and (rule := modicon_rule(known, read, header, spaces, said, words)):  # noqa: PLR2004 - decimal
        return rule
    numbers = [one.number(digits) for one in known if one.form != "letters" or digits == 16]  # noqa: PLR2004 - hex
    base, why_base, assumed = counted_from(numbers, header, said)
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
