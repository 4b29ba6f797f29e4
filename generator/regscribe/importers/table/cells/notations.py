"""One text of an address: its number, and what its prefix, its digits and its ending say."""

import re
from dataclasses import dataclass, replace

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.bits import MOST_BIT
from regscribe.importers.table.cells.numbers import clean
from regscribe.importers.table.cells.spaces import FUNCTIONS, REGIONS
from regscribe.model import Space


@dataclass(frozen=True, slots=True, kw_only=True)
class Printed:
    """An address as it is printed.

    `number` in decimal digits, or in hexadecimal ones where `form` is `hex` (marked as such) or `letters` (digits and
    letters without a mark); `digits` is how many stand there. `region` is the digit of `4x0001`, `prefix` that of
    `4:1`, of which the column shows whether it is a region or a function. `last` is the last number of a range.
    """

    digits: str
    form: str = "decimal"
    region: int | None = None
    prefix: int | None = None
    space: Space | None = None
    last: str = ""
    bits: tuple[int, int] | None = None
    has_point_zero: bool = False
    has_0x: bool = False

    @property
    def as_region(self) -> "Printed":
        """As in a column where `4x0001` stands: `0x0001` is coil 1 and no hexadecimal number."""
        return replace(self, form="decimal", region=0) if self.has_0x and self.digits.isdecimal() else self

    def number(self, base: int) -> int:
        """The number, of digits without a mark in a base; letters are always hexadecimal."""
        return int(self.digits, base if self.form == "decimal" else 16)

    def end(self, base: int) -> int:
        """The last number of a range; the number itself where it is none."""
        is_decimal = self.form == "decimal" and self.last.isdecimal()
        return int(self.last, base if is_decimal else 16) if self.last else self.number(base)


_SPACES = (
    (Space.HOLDING, r"hr|holding(?: registers?)?|holdreg|%?mw|hold\.?"),
    (Space.INPUT, r"ir|input registers?|%iw"),
    (Space.COIL, r"co|coils?|%m"),
    (Space.DISCRETE, r"di|discrete(?: inputs?)?|%ix?"),
    (None, r"r|reg\.?|register|word|addr\.?|address|adr\.?|no\.?|#|@"),
)
"""Prefixes by the space that they say (None: none)."""

_PREFIX = "|".join(f"(?P<p{at}>{words})" for at, (_, words) in enumerate(_SPACES))
_NUMBER = (
    r"0x[0-9a-f]{1,6}|[0-9][0-9a-f]{0,5}h|[a-f][0-9a-f]{1,5}h|[x$][0-9a-f]{1,6}|&h[0-9a-f]{1,6}|16#[0-9a-f]{1,6}"
    r"|[0-9a-f]{1,7}"
)
_REGION = r"(?P<region>[134])x\s*|(?:fc?\s*)?(?P<prefix>[0-9]{1,2})\s*:\s*(?=[0-9])"
_LAST = rf"\s*(?:~|\.\.+|\u2026|-|\bto\b|\bbis\b)\s*(?:[134]x)?(?P<last>{_NUMBER})"
_OTHER = r"\s*[/,&+; ]\s*(?P<other>[0-9]{1,6})"
_BIT_WORD = r"(?:bit|b)\s*"
_BITS = (
    rf"\s*(?:[.:,_ ]\s*{_BIT_WORD}|\.|[\[(]\s*(?:{_BIT_WORD})?)\s*(?P<low>[0-9]{{1,2}})"
    rf"(?:\s*(?:-|\.\.|~|:)\s*(?:{_BIT_WORD})?(?P<high>[0-9]{{1,2}}))?\s*[\])]?"
)
_WHOLE = re.compile(
    rf"(?:(?:{_PREFIX})\s*[.:#_-]?\s*)?(?:{_REGION})?(?P<n>{_NUMBER})(?:{_LAST}|{_OTHER})?(?:{_BITS})?", re.IGNORECASE
)
_GROUPED = re.compile(r"(?<![0-9.])([1-9][0-9]{0,2})[ ,'](?=[0-9]{3}(?![0-9]))")


def printed(text: str) -> Printed | Unclear:
    """Take a text apart; Unclear if it is no address, or several things at once (`1234/5`)."""
    plain = clean(text)
    grouped = plain if re.search(r"[/~]|\.\.", plain) or _is_pair(plain) else _GROUPED.sub(r"\1", plain)
    found = _WHOLE.fullmatch(grouped)
    if not found:
        return Unclear(f"{quoted(text)} is no address")
    digits, form = _form(found["n"])
    last = _last(found, digits, form, text)
    bits = _bits(found, text)
    if isinstance(last, Unclear):
        return last
    if isinstance(bits, Unclear):
        return bits
    return Printed(
        digits=digits,
        form=form,
        region=int(found["region"]) if found["region"] else None,
        prefix=int(found["prefix"]) if found["prefix"] else None,
        space=next((space for at, (space, _) in enumerate(_SPACES) if found[f"p{at}"]), None),
        last=last,
        bits=bits,
        has_point_zero=grouped.endswith(".0"),
        has_0x=found["n"].casefold().startswith("0x"),
    )


def _is_pair(plain: str) -> bool:
    """Whether a comma or a blank stands between two addresses that follow each other, and no thousands."""
    found = re.fullmatch(r"([0-9]{1,9})[ ,]\s*([0-9]{1,9})", plain)
    return found is not None and int(found[2]) == int(found[1]) + 1


def _form(text: str) -> tuple[str, str]:
    """The digits, and whether they are marked as hexadecimal, or have letters, or are decimal."""
    low = text.casefold()
    bare = re.sub(r"^(?:0x|x|\$|&h|16#)|h$", "", low)
    if bare != low:
        return bare, "hex"
    return low, "decimal" if low.isdecimal() else "letters"


def _last(found: re.Match[str], digits: str, form: str, text: str) -> str | Unclear:
    """The digits of the last register; empty where one stands alone."""
    if other := found["other"]:
        follows = form == "decimal" and other.isdecimal() and int(other) == int(digits) + 1
        return other if follows else Unclear(f"{quoted(text)} may be two addresses, an address and a count or a bit")
    if not found["last"]:
        return ""
    last, last_form = _form(found["last"])
    if last_form != form and {last_form, form} != {"decimal", "letters"}:
        return Unclear(f"{quoted(text)} is a range from one notation to another")
    base = 10 if form == last_form == "decimal" else 16
    if int(last, base) < int(digits, base) and 1 < len(last) < len(digits):
        last = digits[: -len(last)] + last  # 40001-12 ends at 40012
    return last if int(last, base) >= int(digits, base) else Unclear(f"the range {quoted(text)} ends before it begins")


def _bits(found: re.Match[str], text: str) -> tuple[int, int] | Unclear | None:
    if not found["low"]:
        return None
    ends = sorted((int(found["low"]), int(found["high"] or found["low"])))
    if ends[1] > MOST_BIT:
        return Unclear(f"{quoted(text)} names bit {ends[1]}, and a register has bits 0 to {MOST_BIT - 1}")
    return ends[0], ends[1]


def space_of(one: Printed, *, by_function: bool) -> Space | None:
    """The space that the text says; `by_function`: whether the digit of `4:1` is a function."""
    if one.space or one.region is not None:
        return one.space or REGIONS.get(one.region or 0)
    if one.prefix is None:
        return None
    return (FUNCTIONS if by_function else REGIONS).get(one.prefix)
