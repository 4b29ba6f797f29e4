"""Makes texts from outside (maps, devices, files, arguments) safe to print, to log and to open in a spreadsheet.

A terminal obeys control characters, a spreadsheet calculates what looks like a formula, and both obey direction marks.
All output goes through one of these functions.
"""

import json
import re

INVISIBLE = re.compile(
    "[\\x00-\\x1f\\x7f-\\x9f\\xad\\u061c\\u200b-\\u200f\\u2028-\\u202e\\u2060-\\u206f\\ud800-\\udfff\\ufeff\\ufff9-\\ufffb\\ufffe\\uffff]"
)
"""Control characters, direction marks, line separators and characters without width."""

FORMULA = re.compile(r"\s*(?:[=@\t\r]|[+-].*[(|!=])", re.DOTALL)
"""A text that a spreadsheet would calculate, perhaps behind blanks and line ends."""


def safe(text: str) -> str:
    """`text` on one line, every character that is not printable as an escape sequence."""
    return "".join(char if char.isprintable() else char.encode("unicode_escape").decode() for char in text)


def safe_lines(text: str) -> str:
    """`text` with every character that is not printable, but for line ends, as an escape sequence."""
    return "\n".join(map(safe, text.split("\n")))


def tame(text: str) -> str:
    """`text` with invisible characters, but for line ends and tabs, as escape sequences: for whole outputs."""
    return INVISIBLE.sub(lambda found: found[0] if found[0] in "\n\t" else safe(found[0]), text)


def cell(text: str) -> str:
    """`text` as a cell of a spreadsheet: as `safe_lines`, and a formula gets an apostrophe before it."""
    plain = safe_lines(text)
    return f"'{plain}" if FORMULA.match(text) else plain


def json_text(what: object, *, indent: int | None = None, compact: bool = False) -> str:
    """JSON of plain values, with non-ASCII characters as they are and invisible ones as Unicode escapes.

    With `compact`, no blank stands between values.
    """
    text = json.dumps(what, ensure_ascii=False, indent=indent, separators=(",", ":") if compact else None)
    return INVISIBLE.sub(lambda found: found[0] if found[0] == "\n" else f"\\u{ord(found[0]):04x}", text)
