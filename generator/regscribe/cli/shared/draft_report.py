"""What became of each row of an import: as lines for people, as JSON, and as SARIF for hosts that show such results."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.report_formats import as_sarif
from regscribe.draft import Draft, Entry, Outcome, Recognised
from regscribe.draft.differences import Change, Note
from regscribe.model import Diagnostic, Severity
from regscribe.visible import json_text, safe

FORMS = ("text", "json", "sarif")
HEADS = ("column", "heading", "understood as", "because")
MOST_HEADING = 40
"""Most characters of a heading that the table of columns shows."""


def report_of(
    draft: Draft, found: Sequence[Diagnostic], *, source: str, form: str, report: str, notes: Sequence[Note] = ()
) -> str:
    """Return the report: `found` are faults of the source and what `check` still refuses, `notes` are of a merge."""
    if report == "sarif":
        rows = [one for entry in draft.each for one in _diagnostics(entry)]
        return as_sarif([*found, *rows, *map(_of_note, notes)], {})
    if report == "json":
        return _json(draft, found, source, form, notes)
    return "".join(f"{safe(line)}\n" for line in _lines(draft, found, notes))


def _json(draft: Draft, found: Sequence[Diagnostic], source: str, form: str, notes: Sequence[Note]) -> str:
    rows = [
        {
            "place": asdict(entry.place),
            "where": entry.where,
            "name": entry.name,
            "part": entry.part,
            "group": entry.group,
            "outcome": entry.outcome,
            "remarks": [asdict(remark) for remark in entry.remarks],
        }
        for entry in draft.each
    ]
    plain = [{"rule": one.rule, "severity": one.severity, "message": one.message, **asdict(one.span)} for one in found]
    counts = Counter(entry.outcome for entry in draft.each)
    tally = {outcome.value.replace(" ", "_"): counts[outcome] for outcome in Outcome}
    whole = {"format": 1, "source": source, "importer": form, "counts": tally}
    columns = [asdict(column) for column in draft.recognised]
    about = {"columns": columns, "stated": draft.stated, "findings": plain, "rows": rows}
    return json_text({**whole, **about, "merge": [asdict(note) for note in notes]}, indent=2) + "\n"


def _lines(draft: Draft, found: Sequence[Diagnostic], notes: Sequence[Note]) -> Iterator[str]:
    yield from _columns(draft.recognised)
    yield from draft.stated
    for one in found:
        yield f"{one.severity}: {one.span}: {one.message}{f' ({one.help})' if one.help else ''}"
    for entry in draft.each:
        if entry.remarks or entry.outcome is not Outcome.WHOLE:
            said = "; ".join(f"{remark.code}: {remark.message}" for remark in entry.remarks)
            yield f"{entry.where or entry.place}: {entry.name}: {entry.outcome}: {said or 'no reason is given'}"
    yield from (f"{note.place}: {note.name}: {note.change}: {note.message}" for note in notes)
    counts = Counter(entry.outcome for entry in draft.each)
    every = ", ".join(f"{counts[outcome]} {outcome}" for outcome in Outcome)
    yield f"{count(len(draft.each), 'row')}: {every}"


def _columns(recognised: Sequence[Recognised]) -> Iterator[str]:
    """The columns of a table, as a table."""
    if not recognised:
        return
    rows = [HEADS, *((one.column, _short(one.heading), one.meaning, one.evidence) for one in recognised)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()


def _short(heading: str) -> str:
    text = " ".join(heading.split())
    return text if len(text) <= MOST_HEADING else f"{text[: MOST_HEADING - 3]}..."


def _of_note(note: Note) -> Diagnostic:
    word = note.change.name.lower()
    severity = Severity.ERROR if note.change is Change.KEPT else Severity.WARNING
    return Diagnostic(f"merge/{word}", f"{note.name}: {note.change}: {note.message}", note.place, severity=severity)


def _diagnostics(entry: Entry) -> Iterator[Diagnostic]:
    for remark in entry.remarks:
        severity = Severity.ERROR if entry.outcome is Outcome.LEFT_OUT else Severity.WARNING
        yield Diagnostic(f"import/{remark.code}", f"{entry.name}: {remark.message}", entry.place, severity=severity)
