"""Registers of array elements: "the same element" of a declaration becomes the element that a register stands in.

An array is declared once for all its elements. What a register there says of another one of its own element has empty
brackets in the place of each index: `channels[].decimals` said in `channels[3]` is `channels[3].decimals`.
"""

import re
from typing import Any

OPEN = "[]"
PATHS = frozenset({"register"})
"""The fields that hold the path of a register, in all that a declaration is made of (see `spec`)."""
_INDEX = re.compile(r"\[(\d+)\]")


def is_open(told: Any) -> bool:
    """Whether part of a declaration speaks of the same element of an array."""
    if isinstance(told, tuple):
        names = getattr(told, "_fields", ("",) * len(told))
        return any(OPEN in one if name in PATHS else is_open(one) for name, one in zip(names, told, strict=True))
    return False


def closed(told: Any, path: str) -> Any:
    """Part of a declaration as the register at `path` means it, each empty bracket with its own index there."""
    return _closed(told, _INDEX.findall(path))


def _closed(told: Any, indices: list[str]) -> Any:
    if not is_open(told):
        return told
    names = getattr(told, "_fields", None)
    if names is None:
        return tuple(_closed(one, indices) for one in told)
    return told._replace(
        **{
            name: _filled(one, indices) if name in PATHS else _closed(one, indices)
            for name, one in zip(names, told, strict=True)
        }
    )


def _filled(path: str, indices: list[str]) -> str:
    """A path with the first indices in its empty brackets, which come before all others."""
    first, *rest = path.split(OPEN)
    return first + "".join(f"[{index}]{part}" for index, part in zip(indices, rest, strict=False))
