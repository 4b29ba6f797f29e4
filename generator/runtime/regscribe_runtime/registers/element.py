"""References of array elements to registers of the same element.

An array is declared once for all its elements. A reference to a register of the same element has empty brackets in
place of each index: `channels[].decimals` in `channels[3]` is `channels[3].decimals`.
"""

import re
from typing import Any

OPEN = "[]"
PATHS = frozenset({"register"})
"""The fields of the vocabulary that hold the path of a register."""
_INDEX = re.compile(r"\[\d+\]")


def is_open(part: Any) -> bool:
    """Whether part of a declaration refers to the same element of an array."""
    if isinstance(part, tuple):
        names = getattr(part, "_fields", ("",) * len(part))
        return any(OPEN in one if name in PATHS else is_open(one) for name, one in zip(names, part, strict=True))
    return False


def closed(part: Any, path: str) -> Any:
    """Part of a declaration with the indices of the register at `path` in each empty bracket."""
    if not is_open(part):
        return part
    if not hasattr(part, "_fields"):
        return tuple(closed(one, path) for one in part)
    parts = part._asdict().items()
    return part._replace(**{name: filled(one, path) if name in PATHS else closed(one, path) for name, one in parts})


def filled(reference: str, path: str) -> str:
    """A reference with the first indices of `path` in its empty brackets, which come before all others."""
    for index in _INDEX.findall(path)[: reference.count(OPEN)]:
        reference = reference.replace(OPEN, index, 1)
    return reference
