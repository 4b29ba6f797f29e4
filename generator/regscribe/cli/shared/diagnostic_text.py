"""Diagnostics as text for people: message, place, source line with carets, the other parties, what to do."""

from collections.abc import Iterable, Iterator

from regscribe.cli.shared.output import Piece
from regscribe.cli.shared.source_excerpt import Sources
from regscribe.model import Diagnostic, Severity, Span
from regscribe.visible import safe

STYLES = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow"}
MARGIN = "cyan"


def findings(diagnostics: Iterable[Diagnostic]) -> Iterator[Piece]:
    """Yield every diagnostic as styled text, an empty line after each."""
    sources = Sources()
    for diagnostic in diagnostics:
        yield from _finding(diagnostic, sources)
        yield "\n", ""


def count(number: int, noun: str) -> str:
    """Spell a number with its noun: `1 map`, `2 maps`."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def tally(diagnostics: Iterable[Diagnostic]) -> str:
    """Say how many errors and warnings there are: `no findings`, `1 error, 2 warnings`."""
    numbers = dict.fromkeys(Severity, 0)
    for diagnostic in diagnostics:
        numbers[diagnostic.severity] += 1
    return ", ".join(count(number, severity.value) for severity, number in numbers.items() if number) or "no findings"


def _finding(diagnostic: Diagnostic, sources: Sources) -> Iterator[Piece]:
    yield f"{diagnostic.severity.value}[{diagnostic.rule}]", STYLES[diagnostic.severity]
    yield f": {safe(diagnostic.message)}\n", "bold"
    yield from _place(diagnostic.span, sources, STYLES[diagnostic.severity])
    for related in diagnostic.related:
        yield f"  note: {safe(related.message)}\n", ""
        yield from _place(related.span, sources, MARGIN)
    if diagnostic.help:
        yield "  help: ", "bold green"
        yield f"{safe(diagnostic.help)}\n", ""


def _place(span: Span, sources: Sources, style: str) -> Iterator[Piece]:
    yield "  --> ", MARGIN
    yield f"{safe(str(span))}\n", ""
    excerpt = sources.excerpt(span)
    if excerpt is None:
        return
    number = f"{span.line:5d}"
    yield f"{number} | ", MARGIN
    yield f"{excerpt.line}\n", ""
    yield f"{' ' * len(number)} | ", MARGIN
    yield f"{excerpt.carets}\n", style
