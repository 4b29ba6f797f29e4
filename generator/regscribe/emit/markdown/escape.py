"""Text to Markdown: every text of a map is untrusted, so it is escaped unless it is a `Md`, which is ready.

`escape` is safe anywhere on a line: in a paragraph, a heading, a list item and a table cell.
"""

import re
from collections.abc import Iterable
from functools import lru_cache

INLINE = re.compile(r"[\\`*\[\]#~|$]|(?<![A-Za-z0-9])_|_(?![A-Za-z0-9])")
"""Punctuation that CommonMark, tables, strike-through or mathematics could take for mark-up."""

ENTITIES = {"<": "&lt;", ">": "&gt;"}
BLOCK_START = re.compile(r" ?(?:[-+](?=[ -]|$)|=(?==* ?$)|\d{1,9}[.)](?= |$))")
"""A list marker, a rule or the underline of a heading at the start of a line."""

ADDRESS = re.compile(r"(?:https?|ftp)://[^\s`|<>]*|\bwww\.[^\s`|<>]*|[\w.+-]{1,64}@[\w.-]+", re.IGNORECASE)
"""Addresses that renderers turn into links, but not in a code span; without the 64, long words take ages."""

CONTROL = re.compile(r"[\x00-\x08\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ufeff\ud800-\udfff]")
"""Characters that show as nothing or turn the direction of their neighbours; joiners of emoji are not among them."""

CODE = re.compile(r"[^`|\n\r\\<>]+")
"""Text that a code span carries unchanged in and outside a table."""

PLAIN = re.compile(r"[A-Za-z0-9]+(?: [A-Za-z0-9]+)*")
"""Words and whole numbers, which are most of what is escaped, and which nothing takes for mark-up."""

QUOTED = re.compile(r"`([A-Za-z0-9_.\[\] ]+)`")
"""A name in backticks in a description: the one mark-up that prose may use."""


class Md(str):
    """Markdown that is ready: never escaped again."""

    __slots__ = ()


@lru_cache(maxsize=4096)  # a page says the same few words of every register
def escape(text: str) -> Md:
    """Escape text so that it renders as itself on one line; addresses of the net become code, so none is a link."""
    if PLAIN.fullmatch(text):
        return Md(text)
    text = CONTROL.sub(lambda found: f"U+{ord(found[0]):04X}", re.sub(r"\s+", " ", text))
    parts: list[str] = []
    end = 0
    for found in ADDRESS.finditer(text):
        parts += [_escape_plain(text[end : found.start()]), f"`{found[0]}`"]
        end = found.end()
    line = "".join([*parts, _escape_plain(text[end:])])
    start = BLOCK_START.match(line)
    return Md(line if start is None else f"{line[: start.end() - 1]}\\{line[start.end() - 1 :]}")


def _escape_plain(text: str) -> str:
    text = re.sub(r"&(?=[#A-Za-z])", "&amp;", INLINE.sub(lambda found: f"\\{found[0]}", text))
    return re.sub("[<>]", lambda found: ENTITIES[found[0]], text)


def md(*parts: str) -> Md:
    """Join parts; those that are not ready are escaped."""
    return Md("".join(part if isinstance(part, Md) else escape(part) for part in parts))


def join(separator: str, parts: Iterable[Md]) -> Md:
    """Join ready parts by a separator that is ready too; empty parts are dropped."""
    return Md(separator.join(part for part in parts if part))


def lines(*parts: Md) -> Md:
    """Join ready parts as lines of one table cell."""
    return join("<br>", parts)


def code(text: str) -> Md:
    """Return a code span where the text can stand in one, else the escaped text."""
    plain = text == text.strip() and CODE.fullmatch(text) and not CONTROL.search(text)
    return Md(f"`{text}`") if plain else escape(text)


def link(text: str, anchor: str) -> Md:
    """Return a link to an anchor of the same page; the text alone without an anchor."""
    return md(Md("["), text, Md(f"](#{anchor})")) if anchor else md(text)


def prose(text: str) -> Md:
    """Escape a description, in which a name in backticks may be code."""
    pieces = QUOTED.split(text)
    return Md("".join(code(piece) if index % 2 else escape(piece) for index, piece in enumerate(pieces)))


def slug(text: str) -> str:
    """Return the part of an anchor that a text gives: letters, digits, `_` and `-`."""
    return re.sub(r"[^a-z0-9_]+", "-", text.lower()).strip("-") or "x"
