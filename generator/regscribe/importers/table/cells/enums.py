"""Codes and their labels in one cell, or bits and theirs."""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.code_parts import MOST_TEXT, Part, parts_of


@dataclass(frozen=True, slots=True)
class Codes:
    """The labels of codes, or of bits where `flags`.

    `ranges` are codes (or bits) that the cell gives from one to another (`2..5 = reserved`), which an enum cannot say
    so. `other` is what it calls all others, `none` a word of which no bit is set; `lead` stands before the first code.
    """

    labels: Mapping[int, str]
    flags: bool = False
    ranges: tuple[tuple[int, int, str], ...] = ()
    other: str = ""
    none: str = ""
    lead: str = ""


LAST_BIT = 15
LAST_CODE = (1 << 64) - 1
ENOUGH = 3
"""Powers of two that may be masks as well as codes; fewer are codes."""


def parse_codes(text: str, *, flags: bool | None = None, width: int = 16) -> Codes | Unclear | None:
    """Read `0=Off 1=On`, `0: off; 1: on`, `0-Stop/1-Run`, `bit 0: alarm, bit 1: door`; None if no code stands there.

    `flags` is what the type says: whether the numbers are bits (None: nothing); `width` is how many bits there are.
    Unclear: a code that stands twice with different labels, numbers that may be masks or codes, labels without codes.
    """
    if len(text) > MOST_TEXT:
        return Unclear(f"{quoted(text)} has {len(text)} characters, more than the {MOST_TEXT} of a list of codes")
    objects = _json(text)
    parts = objects or parts_of(text)
    if not parts or (parts[0].lead and len(parts) == 1):  # prose with a number in it
        return _no_codes(text)
    if twice := _twice(parts):
        first, second = twice
        what = f"{'bit' if first.is_bit else 'code'} {first.low}"
        return Unclear(f"{quoted(text)} gives {what} twice: as {quoted(first.label)} and as {quoted(second.label)}")
    if any(not part.label for part in parts):
        return Unclear(f"{quoted(text)} has a code without a label")
    bits = {part.is_bit for part in parts if not part.is_other}
    if len(bits) > 1:
        return Unclear(f"{quoted(text)} has bits and codes")
    is_bits = bool(flags) or bits == {True}
    return _codes(parts, text, is_bits=is_bits, named=bits == {True}, width=width)


def _no_codes(text: str) -> Unclear | None:
    """Labels without numbers (`off/on`) may be codes in this order."""
    words = [word.strip() for word in re.split(r"[/|;]", text)]
    if 1 < len(words) <= 8 and all(re.fullmatch(r"[^\W\d_][^\d=:<>]{0,30}", word) for word in words):  # noqa: PLR2004 - few labels
        shown = ", ".join(f"{number}: {word}" for number, word in enumerate(words))
        return Unclear(f"{quoted(text)} has labels and no codes", f"`{{{shown}}}`")
    return None


def _json(text: str) -> Sequence[Part]:
    """The parts of `{"b0": "door"}`."""
    if not text.lstrip().startswith("{"):
        return ()
    try:
        found = json.loads(text[: 1 << 16])
    except (ValueError, RecursionError):
        return ()
    if not isinstance(found, dict) or not all(isinstance(label, str | int) for label in found.values()):
        return ()
    each = [parts_of(f"{key}={label}") for key, label in found.items()]
    return [parts[0] for parts in each] if all(len(parts) == 1 for parts in each) else ()


def _twice(parts: Sequence[Part]) -> tuple[Part, Part] | None:
    """Two parts of one code with different labels."""
    seen: dict[tuple[bool, int, int], Part] = {}
    for part in parts:
        if part.is_other:
            continue
        first = seen.setdefault((part.is_bit, part.low, part.high), part)
        if first.label.casefold() != part.label.casefold():
            return first, part
    return None


def _codes(parts: Sequence[Part], text: str, *, is_bits: bool, named: bool, width: int) -> Codes | Unclear:
    single = [part for part in parts if not part.is_other and part.low == part.high]
    numbers = sorted({part.low for part in single})
    if doubt := _doubt(single, numbers, text, is_bits=is_bits, named=named):
        return doubt
    masks = is_bits and not named and _masks(numbers) and max(numbers) >= width
    labels = {
        (part.low.bit_length() - 1 if masks else part.low): part.label for part in single if part.low or not masks
    }
    last = width - 1 if is_bits else LAST_CODE
    if any(number > last for number in labels):
        shifted = "bits counted from 1" if is_bits and min(labels) == 1 and max(labels) == width else ""
        what = "bit" if is_bits else "code"
        return Unclear(f"{quoted(text)} names {what} {max(labels)}, and the last is {last}", shifted)
    ranges = tuple((part.low, part.high, part.label) for part in parts if part.low != part.high)
    other = next((part.label for part in parts if part.is_other), "")
    none = next((part.label for part in single if masks and not part.low), "")
    return Codes(labels, flags=is_bits, ranges=ranges, other=other, none=none, lead=parts[0].lead)


def _masks(numbers: Sequence[int]) -> bool:
    """Whether all are powers of two (or nothing), enough of them to be masks."""
    powers = [number for number in numbers if number]
    return len(powers) >= ENOUGH and max(powers) > ENOUGH and all(number & (number - 1) == 0 for number in powers)


def _doubt(single: Sequence[Part], numbers: Sequence[int], text: str, *, is_bits: bool, named: bool) -> Unclear | None:
    """Why the numbers cannot be told for sure; None if they can."""
    if len(numbers) >= ENOUGH and all(re.fullmatch(r"[01]{2,}", part.digits) for part in single):
        return Unclear(f"the codes in {quoted(text)} may be binary or decimal")
    if named or not _masks(numbers) or (is_bits and max(numbers) > LAST_BIT):
        return None
    what = "masks or numbers of bits" if is_bits else "codes or masks of bits"
    return Unclear(f"the numbers in {quoted(text)} are all powers of two, so they may be {what}")
