"""What became of each row of an import: as lines for people, as JSON, and as SARIF for hosts that show such results."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.report_formats import as_sarif
from regscribe.draft import Draft, Entry, Outcome, Recognised
from regscribe.draft.differences import Change, Note
from regscribe.model import Diagnostic, Severity
from regscribe.visible import json_text, safe

LONGEST_NAME = 100

FORMS = ("text", "json", "sarif")
HEADS = ("column", "heading", "understood as", "because")
MOST_HEADING = 40
"""Most characters of a heading that the table of columns shows."""

MOST_ALIKE = 5
"""Most rows of which the same is said that are told one by one."""

SHOWN_ALIKE = 3
"""Of more of them, those that are named besides the first and the last."""

OWN = re.compile(r"`[^`]*`|[0-9]+")
"""What a message has of its row: a quoted text, or a number."""


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
    yield from _rows(draft.each)
    yield from (f"{note.place}: {note.name}: {note.change}: {note.message}" for note in notes)
    counts = Counter(entry.outcome for entry in draft.each)
    every = ", ".join(f"{counts[outcome]} {outcome}" for outcome in Outcome)
    yield f"{count(len(draft.each), 'row')}: {every}"


def _rows(entries: Iterable[Entry]) -> Iterator[str]:
    """The rows of which something is said; many of which the same is said are told at the first of them."""
    alike: dict[tuple[str, ...], list[Entry]] = {}
    for entry in entries:
        if entry.remarks or entry.outcome is not Outcome.WHOLE:
            alike.setdefault(_pattern(entry), []).append(entry)
    for same in alike.values():
        told = same if len(same) <= MOST_ALIKE else same[:1]
        for entry in told:
            said = "; ".join(f"{remark.code}: {remark.message}" for remark in entry.remarks)
            yield f"{_place(entry)}: {_called(entry)}: {entry.outcome}: {said or 'no reason is given'}"
        if others := same[len(told) :]:
            first = ", ".join(map(_place, others[:SHOWN_ALIKE]))
            yield f"  and {count(len(others), 'row')} more of which the same is said: {first}, .. {_place(others[-1])}"
    if any(len(same) > MOST_ALIKE for same in alike.values()):
        yield "--report json tells each row by itself"


def _called(entry: Entry) -> str:
    """The name, cut where it is longer than any name; JSON has it whole."""
    return entry.name if len(entry.name) <= LONGEST_NAME else f"{entry.name[:LONGEST_NAME]}..."


def _place(entry: Entry) -> str:
    return entry.where or str(entry.place)


def _pattern(entry: Entry) -> tuple[str, ...]:
    """What is said of a row, without the texts and numbers of its own."""
    said = (f"{remark.code}: {OWN.sub('', remark.message)}" for remark in entry.remarks)
    return entry.outcome, *said


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
