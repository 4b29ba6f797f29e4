"""What an export lost: as lines for people, as JSON, and as SARIF for hosts that show such results."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict
from itertools import groupby

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.report_formats import as_sarif
from regscribe.losses import Exported, Grade, Loss, worst_first
from regscribe.model import Diagnostic, Severity, Span
from regscribe.visible import json_text, safe

FORMS = ("text", "json", "sarif")

MOST_NAMED = 6
"""Registers of one loss that are named in a text; JSON has them all."""


def report_of(made: Exported, *, form: str, report: str, refused: bool) -> str:
    """Return the report on an export to `form`; empty where a text would say nothing."""
    losses = worst_first(made.losses)
    if report == "sarif":
        return as_sarif([_diagnostic(loss, form) for loss in losses], {})
    if report == "json":
        plain = [{**asdict(loss), "grade": loss.grade.name.lower()} for loss in losses]
        return json_text({"format": 1, "export": form, "remarks": made.remarks, "losses": plain}, indent=2) + "\n"
    return "".join(f"{safe(line)}\n" for line in _lines(made, losses, form, refused=refused))


def _lines(made: Exported, losses: tuple[Loss, ...], form: str, *, refused: bool) -> Iterator[str]:
    yield from made.remarks
    if losses:
        tally = Counter(loss.grade for loss in losses)
        many = ", ".join(f"{tally[grade]} {grade.words}" for grade in Grade if tally[grade])
        yield f"{'nothing was exported: ' * refused}{form} cannot say everything: {many}"
    for (grade, fact, done), some in _grouped(losses):
        paths = list(dict.fromkeys(loss.register for loss in some))
        named = ", ".join(paths[:MOST_NAMED])
        more = f" and {len(paths) - MOST_NAMED} more" if len(paths) > MOST_NAMED else ""
        yield f"  {grade.words}: {fact}: {done} ({count(len(paths), 'register')}: {named}{more})"


def _grouped(losses: tuple[Loss, ...]) -> Iterator[tuple[tuple[Grade, str, str], list[Loss]]]:
    def key(loss: Loss) -> tuple[Grade, str, str]:
        return loss.grade, loss.fact, loss.done

    for which, some in groupby(sorted(losses, key=key), key):
        yield which, list(some)


def _diagnostic(loss: Loss, form: str) -> Diagnostic:
    severity = Severity.ERROR if loss.grade is Grade.WRONG else Severity.WARNING
    return Diagnostic(f"{form}/{loss.fact}", f"{loss.register}: {loss.done}", Span(loss.model), severity=severity)
