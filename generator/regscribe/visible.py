"""The one door for texts from outside (maps, devices, files, arguments) on their way to a person's eyes.

A terminal obeys control characters, a spreadsheet calculates what looks like a formula, and both believe direction
marks. So what is printed, logged or put into a table goes through one of these functions.
"""

import json
import re

INVISIBLE = re.compile(
    "[\\x00-\\x1f\\x7f-\\x9f\\xad\\u061c\\u200b-\\u200f\\u2028-\\u202e\\u2060-\\u206f\\ud800-\\udfff\\ufeff\\ufff9-\\ufffb\\ufffe\\uffff]"
)
"""Control characters, direction marks, line separators and what has no width."""

FORMULA = re.compile(r"\s*(?:[=@\t\r]|[+-].*[(|!=])", re.DOTALL)
"""What a spreadsheet would calculate, blanks and line ends before it or not."""


def safe(text: str) -> str:
    """`text` on one line: every character that a terminal would obey is spelled out."""
    return "".join(char if char.isprintable() else char.encode("unicode_escape").decode() for char in text)


def safe_lines(text: str) -> str:
    """As `safe`, with the ends of its lines as they are."""
    return "\n".join(map(safe, text.split("\n")))


def tame(text: str) -> str:
    """`text` with what a terminal would obey spelled out, but for line ends and tabs: the door for whole outputs."""
    return INVISIBLE.sub(lambda found: found[0] if found[0] in "\n\t" else safe(found[0]), text)


def cell(text: str) -> str:
    """`text` as a cell of a spreadsheet: nothing of it is obeyed, and a formula gets an apostrophe before it."""
    plain = safe_lines(text)
    return f"'{plain}" if FORMULA.match(text) else plain


def json_text(what: object, *, indent: int | None = None) -> str:
    """JSON of what is plain, with characters as they are but for those that a terminal would obey."""
    text = json.dumps(what, ensure_ascii=False, indent=indent)
    return INVISIBLE.sub(lambda found: found[0] if found[0] == "\n" else f"\\u{ord(found[0]):04x}", text)
