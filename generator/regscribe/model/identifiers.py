"""Identifiers and indexed names, made of the manual's names."""

import re
from collections.abc import Iterator

_RUN = re.compile(r"[A-Za-z0-9]+")
_MARK = re.compile(r"\{[ij]\}")
_LETTERS = "ij"
_INDEX = re.compile(r"\[\d+\]")
OPEN = "[]"


def snake(text: str) -> str:
    """Lower snake case of a name: `Alarm 1 Action` gives `alarm_1_action`; empty where no letter or digit is."""
    return "_".join(_RUN.findall(text)).lower()


def label_id(text: str) -> str:
    """Lower snake case of a label, with an `n` in front of a digit: `9600 baud` gives `n9600_baud`."""
    name = snake(text)
    return f"n{name}" if name[:1].isdigit() else name


def module_names(map_id: str) -> tuple[str, ...]:
    """The names of package and module of a map: `eaton/93-pm` gives `eaton` and `n93_pm`."""
    return tuple(label_id(part) for part in map_id.split("/"))


def unindexed(text: str) -> str:
    """The name without the marks `{i}` and `{j}`, which stand for the indexes of the arrays around it."""
    return _MARK.sub("", text)


def indexed(text: str, index: tuple[int, ...]) -> str:
    """The name in one element: indexes in place of the marks, `{i}` that of the outermost array and `{j}` of the next.

    A mark without an array stays as it is.
    """
    known = {f"{{{letter}}}": str(number) for letter, number in zip(_LETTERS, index, strict=False)}
    return _MARK.sub(lambda mark: known.get(mark[0], mark[0]), text)


def has_mark(text: str) -> bool:
    """Whether an index stands somewhere in the name."""
    return _MARK.search(text) is not None


def opened(path: str, depth: int = 0) -> str:
    """A path with empty brackets for its first `depth` indices (0: for all): that of "the same element" of an array.

    `programs[2].segments[1].ramp` said in any element of `programs` is `programs[].segments[1].ramp`.
    """
    return _INDEX.sub(OPEN, path, count=depth)


def ways_to_say(path: str) -> Iterator[str]:
    """The path, and what those call it who stand in the same element of the arrays around it."""
    yield path
    yield from (opened(path, depth) for depth in range(1, path.count("[") + 1))
