"""What the cells of a column look like, where a heading alone does not tell what they are."""

import re
from collections.abc import Callable, Mapping, Sequence

from regscribe.importers.table.cells import Unclear
from regscribe.importers.table.cells.access import AccessCell, parse_access
from regscribe.importers.table.cells.enums import Codes, parse_codes
from regscribe.importers.table.cells.ranges import Limits, parse_range
from regscribe.importers.table.cells.spaces import SpaceCell, parse_spaces
from regscribe.importers.table.cells.types import Dialect, TypeCell, parse_type
from regscribe.importers.table.cells.units import UnitCell, parse_unit
from regscribe.importers.table.headings import AT, ROLES

HALF = 0.5
FEWEST = 6
"""Cells that show whether a column names each row or several rows together."""

SEEN = 400
"""Cells of a column that are looked at."""

ADDRESS = re.compile(r"(?=.*[0-9])[A-Za-z$%@#:]{0,4}[\s#]?[0-9A-Fa-f][\w\s.,:~/\[\]()-]{0,24}")
"""A text that may be an address: a number, perhaps with a prefix, a suffix, a second number."""

DIALECT = Dialect(characters=True, size_bits=16, little_bytes=False)
"""Any will do to see whether cells are types."""


def is_address(text: str) -> bool:
    """Whether a text may be an address."""
    return len(text) <= 30 and bool(ADDRESS.fullmatch(text.strip()))  # noqa: PLR2004 - no notation is longer


def is_access(text: str) -> bool:
    """Whether a text is an access."""
    return isinstance(parse_access(text), AccessCell)


def is_type(text: str) -> bool:
    """Whether a text is a type."""
    return isinstance(found := parse_type(text, DIALECT), TypeCell) and found.type is not None


def is_size(text: str) -> bool:
    """Whether a text is a size: a number, perhaps with a word."""
    return text[:1].isdecimal() or not is_type(text)


def is_space(text: str) -> bool:
    """Whether a text is an address space or a function code."""
    return isinstance(parse_spaces([text], digits="function").cells[0], SpaceCell)


def is_unit(text: str) -> bool:
    """Whether a text is a known unit."""
    return isinstance(found := parse_unit(text), UnitCell) and found.known


def is_range(text: str) -> bool:
    """Whether a text is a range of numbers."""
    return isinstance(parse_range(text), Limits)


def is_codes(text: str) -> bool:
    """Whether a text is codes with their labels."""
    return isinstance(parse_codes(text), Codes)


CONTENTS: Mapping[str, Callable[[str], bool]] = {"type": is_type, "access": is_access, "unit": is_unit}
"""Roles that the cells of a column tell by themselves."""

_ELSE: Mapping[str, tuple[Callable[[str], bool], Mapping[str, Callable[[str], bool]], str]] = {
    AT: (is_address, {}, "name"),
    "name": (lambda text: not text.isdecimal(), {"length": str.isdecimal}, "name"),
    "type": (is_type, {"space": is_space, "access": is_access}, "type"),
    "length": (is_size, {"type": is_type}, "length"),
    "space": (is_space, {"type": is_type}, "description"),
    "access": (lambda text: not isinstance(parse_access(text, "writable"), Unclear), {}, ""),
    "values": (is_codes, {"range": lambda text: is_codes(text) or is_range(text)}, "description"),
}
"""Roles whose headings mean something else to some people: what their cells are, what they may be, and else."""


def _by_variety(role: str, filled: Sequence[str], said: str) -> tuple[str, str] | None:
    """Another role for names that are few for many rows, and for offsets that differ in most; None for all else."""
    texts = len(set(filled))
    if len(filled) < FEWEST:
        return None
    if role == "name" and texts * 2 < len(filled) and not all(map(str.isdecimal, filled)):
        return "group", f"{said}, but {len(filled)} cells have {texts} texts"
    if role == "decimals" and texts * 2 > len(filled):
        return AT, f"{said}, but {texts} of {len(filled)} cells differ, as addresses do"
    if role == "offset" and texts * 2 > len(filled):
        return "", f"{said}, but {texts} of {len(filled)} cells differ, as offsets of addresses do"
    return None


def judge(role: str, cells: Sequence[str], *, known: bool) -> tuple[str, str]:
    """The role of a column whose heading claims one, with the evidence; its cells may show that it is another."""
    filled = [cell for cell in cells if cell][:SEEN]
    said = f"a heading for {ROLES[role]}" if known else f"a word for {ROLES[role]} in the heading"
    if found := _by_variety(role, filled, said):
        return found
    if role not in _ELSE or not filled:
        return role, said
    wanted, others, otherwise = _ELSE[role]
    shares = {other: sum(map(test, filled)) for other, test in {role: wanted, **others}.items()}
    best = max(shares, key=lambda other: shares[other])
    if shares[best] >= HALF * len(filled):
        if best == role:
            return role, said
        return best, f"{said}, but {shares[best]} of {len(filled)} cells are for {ROLES[best]}"
    if otherwise == role or not otherwise:
        return role, f"{said}; {shares[role]} of {len(filled)} cells are such"
    return otherwise, f"{said}, but only {shares[role]} of {len(filled)} cells are such"
