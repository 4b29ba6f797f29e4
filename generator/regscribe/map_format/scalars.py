"""Texts of a map in their canonical form: quotes only where they are needed, lines after the first indented."""

import re

from regscribe.map_format.tokens import Token
from regscribe.source import resolve
from regscribe.visible import INVISIBLE

_BEGINS_LIKE_TEXT = re.compile(r"[^\W\d_]")
_ELSEWHERE_A_VALUE = {"y", "n", "yes", "no", "on", "off", "true", "false", "null"}
"""Words that readers by YAML 1.1 take for true, false or nothing, in any letters."""
_ENDS_TEXT = re.compile(r":(\s|\Z)|\s#|\s\Z")
_ENDS_TEXT_IN_FLOW = re.compile(r"[,\[\]{}:?#]|\s\Z")
_STATED = re.compile(r"[|>][+-]?([1-9])")
_DOUBLE_NEEDS_ESCAPE = re.compile(r'["\\]')


def scalar_lines(token: Token, *, flow: bool) -> list[str]:
    """Return the lines of a text that is no block; those after the first without their indentation."""
    if "\n" in token.text:
        first, *others = token.text.split("\n")
        return [
            _without_end(first),
            *(_without_end(line.lstrip(" \t")) for line in others[:-1]),
            others[-1].lstrip(" \t"),
        ]
    return [_quoted(token, flow=flow) if token.style else token.text]


def block_lines(token: Token, parent: int, indent: int) -> list[str]:
    """Return the lines of a block (`|` or `>`), its content moved to two columns behind `parent`.

    `indent` is the column of the parent in the text as it was: a stated indentation counts from there.
    """
    head, *lines = token.text.split("\n")
    stated = _STATED.match(head)
    filled = [len(line) - len(line.lstrip(" ")) for line in lines if line.strip(" ")]
    margin = indent + int(stated[1]) if stated else filled[0] if filled else 0
    head = f"{head[: stated.start(1)]}2{head[stated.end(1) :]}" if stated else head
    return [head.rstrip(), *(f"{' ' * (parent + 2)}{line[margin:]}" if line[margin:] else "" for line in lines)]


def _without_end(line: str) -> str:
    """Drop blanks that folding drops; those behind a backslash count."""
    kept = line.rstrip(" \t")
    return line if kept.endswith("\\") and kept != line else kept


def _quoted(token: Token, *, flow: bool) -> str:
    value = token.value
    if not value or INVISIBLE.search(value):
        return token.text
    if _reads_as_text(value, flow=flow):
        return value
    if not _DOUBLE_NEEDS_ESCAPE.search(value):
        return f'"{value}"'
    return token.text if "'" in value else f"'{value}'"


def _reads_as_text(value: str, *, flow: bool) -> bool:
    if not _BEGINS_LIKE_TEXT.match(value) or value.casefold() in _ELSEWHERE_A_VALUE:
        return False
    ends = _ENDS_TEXT_IN_FLOW if flow else _ENDS_TEXT
    return ends.search(value) is None and resolve(value) == value
