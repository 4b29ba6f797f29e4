"""Identifiers and indexed names, made of the manual's names."""

import re

_RUN = re.compile(r"[A-Za-z0-9]+")
_MARK = re.compile(r"\{[ij]\}")
_LETTERS = "ij"


def snake(text: str) -> str:
    """Lower snake case of a name: `Alarm 1 Action` gives `alarm_1_action`; empty where no letter or digit is."""
    return "_".join(_RUN.findall(text)).lower()


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
