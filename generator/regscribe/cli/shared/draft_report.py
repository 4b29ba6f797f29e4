"""What became of each row of an import: as lines for people, as JSON, and as SARIF for hosts that show such results."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import asdict

from regscribe.cli.shared.diagnostic_text import count
from regscribe.cli.shared.report_formats import as_sarif
from regscribe.draft import Draft, Entry, Outcome
from regscribe.model import Diagnostic, Severity
from regscribe.visible import json_text, safe

FORMS = ("text", "json", "sarif")


def report_of(draft: Draft, found: Sequence[Diagnostic], *, source: str, form: str, report: str) -> str:
    """Return the report: `found` are faults of the source, and what `check` still refuses."""
    if report == "sarif":
        return as_sarif([*found, *(one for entry in draft.each for one in _diagnostics(entry))], {})
    if report == "json":
        return _json(draft, found, source, form)
    return "".join(f"{safe(line)}\n" for line in _lines(draft, found))


def _json(draft: Draft, found: Sequence[Diagnostic], source: str, form: str) -> str:
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
    return json_text({**whole, "stated": draft.stated, "findings": plain, "rows": rows}, indent=2) + "\n"


def _lines(draft: Draft, found: Sequence[Diagnostic]) -> Iterator[str]:
    yield from draft.stated
    for one in found:
        yield f"{one.severity}: {one.span}: {one.message}{f' ({one.help})' if one.help else ''}"
    for entry in draft.each:
        if entry.remarks or entry.outcome is not Outcome.WHOLE:
            said = "; ".join(f"{remark.code}: {remark.message}" for remark in entry.remarks)
            yield f"{entry.where or entry.place}: {entry.name}: {entry.outcome}: {said or 'no reason is given'}"
    counts = Counter(entry.outcome for entry in draft.each)
    every = ", ".join(f"{counts[outcome]} {outcome}" for outcome in Outcome)
    yield f"{count(len(draft.each), 'row')}: {every}"


def _diagnostics(entry: Entry) -> Iterator[Diagnostic]:
    for remark in entry.remarks:
        severity = Severity.ERROR if entry.outcome is Outcome.LEFT_OUT else Severity.WARNING
        yield Diagnostic(f"import/{remark.code}", f"{entry.name}: {remark.message}", entry.place, severity=severity)
