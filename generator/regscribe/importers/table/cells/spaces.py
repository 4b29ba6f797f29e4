"""Address spaces, as a column says them: by function codes, by words, by the leading digit."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from regscribe.importers.table.cells import Unclear, quoted
from regscribe.importers.table.cells.numbers import clean
from regscribe.model import Space


@dataclass(frozen=True, slots=True)
class SpaceCell:
    """The space of a row, and the function codes that the cell names, if it names some."""

    space: Space
    functions: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class SpaceColumn:
    """The spaces of all rows (None: the cell is empty), with a sentence that says how bare digits are read."""

    evidence: str
    cells: tuple[SpaceCell | Unclear | None, ...]


REGIONS = {0: Space.COIL, 1: Space.DISCRETE, 3: Space.INPUT, 4: Space.HOLDING}
"""Spaces by the leading digit of their numbers in Modicon's notation."""

FUNCTIONS = {
    1: Space.COIL,
    5: Space.COIL,
    15: Space.COIL,
    2: Space.DISCRETE,
    4: Space.INPUT,
    7: Space.STATUS,
    **dict.fromkeys((3, 6, 16, 22, 23), Space.HOLDING),
}
"""Spaces by the functions that read and write them."""

_WORDS = (
    (Space.DISCRETE, r"discrete|digital in\w*|\bdi\b|\bdiscr\w*|input status|input bits?\b|input contacts?|\b1x\b"),
    (Space.DISCRETE, r"entrées? (?:tor|discr|digital|logique)\w*|digitale? (?:eing|ing)\w*|kontakt|离散"),
    (Space.COIL, r"\bcoils?\b|digital out\w*|\bdo\b|output bits?\b|\b0x\b|\bspule|bobine|bobina|线圈"),
    (Space.INPUT, r"\binput|\bir\b|analog(?:ue)? in\w*|\bai\b|\b3x\b|eingang|eingabe|entrée|ingresso|entrada"),
    (Space.INPUT, r"invoer|ingång|输入"),
    (Space.HOLDING, r"\bholding|\bhr\b|\bhold\b|analog(?:ue)? out\w*|\bao\b|output reg\w*|\b4x\b"),
    (Space.HOLDING, r"halte|maintien|mantenimento|保持"),
)
"""Words for spaces; the first that occur count, so `discrete input` is no input register."""

_CODE = r"(?:0x)?0?(?:[1-7]|1[56]|2[23]|0F|10)(?:hex|h)?"
_PREFIX = re.compile(
    r"(?:modbus )?\b(?:functions?|function codes?|func\.?|fct?|fn|fk|funktion\w*|codes?|read|write|r|w)\b[\s.:#]*"
    r"|fc(?=\d)|\([^()]*\)",
    re.IGNORECASE,
)
_CODES = re.compile(rf"{_CODE}(?:\s*[/,;+&|]\s*{_CODE}|\s+{_CODE})*", re.IGNORECASE)
_FUNCTION_HEADING = re.compile(r"func|\bfc\b|\bfct|funktion|fonction|funzione|funci|code", re.IGNORECASE)
_REGION_HEADING = re.compile(r"region|area|\btable\b|block|prefix|\bx\b", re.IGNORECASE)


def parse_spaces(texts: Sequence[str], header: str = "", *, digits: str = "") -> SpaceColumn:
    """Read a column that says where registers are: `03`, `FC4`, `0x03/0x06`, `Holding`, `Input Register`, `4x`.

    Bare digits are function codes, or the leading digits of Modicon's notation if a 0 is among them or the heading says
    so. Where 3 and 4 alone stand, without a word in the heading, they are unclear: each notation has both, unless
    `digits` says what the user says of them: `function` or `region`.
    """
    bare = {int(text.strip()) for text in texts if re.fullmatch(r"\s*[0-9]{1,2}\s*", text)}
    by_region, evidence = _digits_mean(bare, texts, header)
    if digits:
        by_region, evidence = digits == "region", f"as the user says, bare digits mean a {digits}"
    return SpaceColumn(evidence, tuple(_cell(text, by_region=by_region) for text in texts))


def _digits_mean(digits: set[int], texts: Sequence[str], header: str) -> tuple[bool | None, str]:
    """Whether bare digits are leading digits of Modicon's notation and no functions; None: it is not clear."""
    if not digits:
        return False, ""
    shown = ", ".join(map(str, sorted(digits)))
    if _FUNCTION_HEADING.search(header):
        return False, f"the heading `{header.strip()}` says that {shown} are functions"
    if 0 in digits or _REGION_HEADING.search(header):
        return (
            True,
            f"{shown} are leading digits of the numbers: 0 coils, 1 discrete inputs, 3 input, 4 holding registers",
        )
    if digits - {1, 3, 4} or any(re.fullmatch(r"\s*0[0-9]\s*", text) for text in texts):
        return False, f"{shown} are functions: 1 coils, 2 discrete inputs, 3 holding, 4 input registers"
    return None, f"{shown} are functions or leading digits of numbers, which is not clear"


def _cell(text: str, *, by_region: bool | None) -> SpaceCell | Unclear | None:
    plain = clean(text)
    if plain in {"", "-", "--"}:
        return None
    if re.fullmatch(r"[0-9]", plain) and by_region is not False:
        if by_region is None:
            return Unclear(f"{quoted(text)} is a function or the leading digit of a number: which, is not clear")
        return SpaceCell(REGIONS[int(plain)]) if int(plain) in REGIONS else Unclear(f"{quoted(text)} is no space")
    codes = _PREFIX.sub("", plain).strip()
    return _of_functions(codes, text) if _CODES.fullmatch(codes) else _of_words(plain, text)


def _of_functions(codes: str, text: str) -> SpaceCell | Unclear:
    functions = tuple(dict.fromkeys(_code(one) for one in re.split(r"[\s/,;+&|]+", codes)))
    spaces = {FUNCTIONS.get(function) for function in functions}
    space = spaces.pop()
    if spaces or space is None:
        return Unclear(f"the functions {quoted(text)} are not all of one space")
    return SpaceCell(space, functions)


def _code(text: str) -> int:
    digits = text.lower().removesuffix("hex").removesuffix("h")
    is_hex = digits.startswith("0x") or digits != text.lower() or digits == "0f"
    return int(digits, 16 if is_hex else 10)


def _of_words(plain: str, text: str) -> SpaceCell | Unclear:
    spaced = plain.replace("_", " ")
    for space, words in _WORDS:
        if re.search(words, spaced, re.IGNORECASE):
            return SpaceCell(space)
    return Unclear(f"{quoted(text)} is no space of addresses")


def parse_space(text: str) -> SpaceCell | None:
    """Read the space that words say, of a section's title or a sheet's name; None where they say none."""
    found = _of_words(clean(text), text)
    return found if isinstance(found, SpaceCell) else None
