"""Diagnostics as text for people: message, place, source line with carets, the other parties, what to do."""

import re
import sys
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache
from pathlib import Path

import click

from regscribe.cli.shared.output import Piece, show, warn
from regscribe.cli.shared.standard_input import kept_text
from regscribe.model import Diagnostic, Severity, Span
from regscribe.visible import safe

STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow"}
MARGIN = "cyan"

WIDTH = 110
"""Most characters of a source line that are shown; a longer line is cut around its carets."""

MOST_BYTES = 8_000_000
"""A larger file is not read again just to show a line of it."""

LINE_BREAK = re.compile("\r\n|[\n\r]")
"""Line ends by which the positions of diagnostics count."""


def report(diagnostics: Sequence[Diagnostic], *, failed: bool, nothing: str) -> None:
    """Print diagnostics to standard error; if `failed`, end the command with code 1, after `nothing` and a tally."""
    show(findings(diagnostics), stream=sys.stderr)
    if failed:
        warn(f"{nothing}: {tally(diagnostics)}\n")
        raise click.exceptions.Exit(1)


def findings(diagnostics: Iterable[Diagnostic]) -> Iterator[Piece]:
    """Yield every diagnostic as styled text, an empty line after each."""
    lines_of = cache(read_lines)
    for diagnostic in diagnostics:
        yield f"{diagnostic.severity.value}[{diagnostic.rule}]", STYLES[diagnostic.severity]
        yield f": {safe(diagnostic.message)}\n", "bold"
        yield from placed(diagnostic.span, lines_of, STYLES[diagnostic.severity])
        for related in diagnostic.related:
            yield f"  note: {safe(related.message)}\n", ""
            yield from placed(related.span, lines_of, MARGIN)
        if diagnostic.help:
            yield "  help: ", "bold green"
            yield f"{safe(diagnostic.help)}\n", ""
        yield "\n", ""


def count(number: int, noun: str, plural: str = "") -> str:
    """A number with its noun: `1 map`, `2 maps`."""
    return f"{number} {noun if number == 1 else plural or f'{noun}s'}"


def tally(diagnostics: Iterable[Diagnostic]) -> str:
    """The number of errors and warnings: `no findings`, `1 error, 2 warnings`."""
    numbers = dict.fromkeys(Severity, 0)
    for diagnostic in diagnostics:
        numbers[diagnostic.severity] += 1
    return ", ".join(count(number, severity.value) for severity, number in numbers.items() if number) or "no findings"


def placed(span: Span, lines_of: Callable[[str], Sequence[str]], style: str) -> Iterator[Piece]:
    """Yield a place with its line, as far as the file can be read, and carets in a style under it."""
    yield "  --> ", MARGIN
    yield f"{safe(str(span))}\n", ""
    shown = excerpt(span, lines_of(span.file))
    if shown is None:
        return
    line, carets = shown
    number = f"{span.line:5d}"
    yield f"{number} | ", MARGIN
    yield f"{line}\n", ""
    yield f"{' ' * len(number)} | ", MARGIN
    yield f"{carets}\n", style


def read_lines(file: str) -> list[str]:
    """The lines of a source file, or of standard input; none if it is gone, unreadable or too large by now."""
    text = kept_text(file)
    if text is not None:
        return LINE_BREAK.split(text.removeprefix("\ufeff"))
    path = Path(file)
    try:
        if not path.is_file() or path.stat().st_size > MOST_BYTES:
            return []
        return LINE_BREAK.split(path.read_text(encoding="utf-8-sig", errors="replace"))
    except (OSError, ValueError):
        return []


def excerpt(span: Span, lines: Sequence[str]) -> tuple[str, str] | None:
    """The line that `span` starts on, safe for a terminal, cut to WIDTH, and the carets under it; None without it."""
    if not 1 <= span.line <= len(lines):
        return None
    line = lines[span.line - 1]
    first = min(span.column - 1, len(line))
    end = span.end_column - 1 if span.end_line == span.line else len(line.rstrip())
    end = max(min(end, len(line)), first + 1)
    start = max(0, first - WIDTH // 2) if len(line) > WIDTH else 0
    stop = min(len(line), start + WIDTH)
    end = min(end, max(stop, first + 1))
    before = ("…" if start else "") + line[start:first]
    text = f"{before}{line[first:stop]}{'…' if stop < len(line) else ''}"
    return _one_column_each(text), " " * _columns(before) + "^" * max(1, _columns(line[first:end]))


def _one_column_each(text: str) -> str:
    """Replace tabs and unprintable characters, so that carets stay under their text."""
    return "".join(
        " " if char == "\t" else char if char.isprintable() else "\N{REPLACEMENT CHARACTER}" for char in text
    )


def _columns(text: str) -> int:
    """Terminal columns of `text`: two for a wide character, none for one that combines with the one before."""
    return sum(0 if unicodedata.combining(char) else 1 + (unicodedata.east_asian_width(char) in "WF") for char in text)
