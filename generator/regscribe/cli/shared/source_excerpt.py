"""The source line under a diagnostic: read on demand, made safe for a terminal, cut to width, with its caret run."""

import re
import unicodedata
from dataclasses import dataclass, field
from pathlib import Path

from regscribe.model import Span

WIDTH = 110
"""Most characters of a source line that are shown; a longer line is cut around its carets."""

MOST_BYTES = 8_000_000
"""A larger file is not read again just to show a line of it."""

LINE_BREAK = re.compile("\r\n|[\n\r]")
"""What the places of diagnostics count as the end of a line."""


@dataclass(frozen=True, slots=True)
class Excerpt:
    """One line of source and the run of carets under the span."""

    line: str
    carets: str


@dataclass(frozen=True, slots=True)
class Sources:
    """The files that diagnostics point into; each is read once."""

    _lines: dict[str, list[str]] = field(default_factory=dict)

    def excerpt(self, span: Span) -> Excerpt | None:
        """Return the line that `span` starts on with carets under it; None if it cannot be shown."""
        if span.file not in self._lines:
            self._lines[span.file] = _read(Path(span.file))
        lines = self._lines[span.file]
        if not 1 <= span.line <= len(lines):
            return None
        line = lines[span.line - 1]
        first = min(span.column - 1, len(line))
        end = span.end_column - 1 if span.end_line == span.line else len(line.rstrip())
        return _cut(line, first, max(min(end, len(line)), first + 1))


def _read(path: Path) -> list[str]:
    try:
        if not path.is_file() or path.stat().st_size > MOST_BYTES:
            return []
        return LINE_BREAK.split(path.read_text(encoding="utf-8-sig", errors="replace"))
    except (OSError, ValueError):  # gone or unreadable by now: the message stands without its line
        return []


def _cut(line: str, first: int, end: int) -> Excerpt:
    start = max(0, first - WIDTH // 2) if len(line) > WIDTH else 0
    stop = min(len(line), start + WIDTH)
    end = min(end, max(stop, first + 1))
    before = ("…" if start else "") + line[start:first]
    text = f"{before}{line[first:stop]}{'…' if stop < len(line) else ''}"
    return Excerpt(_plain(text), " " * _width(before) + "^" * max(1, _width(line[first:end])))


def _plain(text: str) -> str:
    """One column for each character, whatever it was: carets must stay under their text."""
    return "".join(
        " " if char == "\t" else char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in text
    )


def _width(text: str) -> int:
    """Terminal columns of `text`: two for a wide character, none for one that combines with the one before."""
    return sum(0 if unicodedata.combining(char) else 1 + (unicodedata.east_asian_width(char) in "WF") for char in text)
