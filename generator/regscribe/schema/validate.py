"""A document against the schema: every mistake in one run, each once and at its place."""

from itertools import islice

from regscribe.model import Diagnostic, Span
from regscribe.schema.compiled import certainly_valid
from regscribe.schema.messages import Complaint, complaints, violation
from regscribe.schema.rules import MISSING_KEY, TOO_MANY_ERRORS, WRONG_TYPE
from regscribe.schema.schemas import MAP, validator
from regscribe.source import Document

MAX_ERRORS = 300


def validate(document: Document, *, language: str = MAP) -> list[Diagnostic]:
    """Check the shape of a map, or of another file that `schema/<language>.schema.json` describes.

    The diagnostics are sorted by place and are all errors.
    """
    if certainly_valid(document.data, language):
        return []
    errors = list(islice(validator(language).iter_errors(document.data), MAX_ERRORS))
    errors.sort(key=lambda error: len(error.absolute_schema_path))  # the outermost knows all types that are allowed
    found: dict[tuple[str, Span, str], Diagnostic] = {}
    for error in errors:
        for complaint in islice(complaints(violation(error)), MAX_ERRORS):
            find = document.key_span if complaint.at_key else document.span
            span = find(complaint.path)
            diagnostic = Diagnostic(complaint.rule, complaint.message, span, complaint.advice)
            found.setdefault((complaint.rule, span, _subject(complaint)), diagnostic)
    ordered = sorted(found.values(), key=lambda diagnostic: (diagnostic.span, diagnostic.rule, diagnostic.message))
    return _cut(ordered) if len(errors) == MAX_ERRORS or len(ordered) > MAX_ERRORS else ordered


def _subject(complaint: Complaint) -> str:
    """What tells complaints of one rule at one place apart."""
    if complaint.rule == MISSING_KEY:
        return complaint.same
    return "" if complaint.rule == WRONG_TYPE else complaint.message


def _cut(ordered: list[Diagnostic]) -> list[Diagnostic]:
    """Keep the first errors, and say that there are more."""
    kept = ordered[:MAX_ERRORS]
    message = f"{len(kept)} errors up to here; there may be more"
    return [*kept, Diagnostic(TOO_MANY_ERRORS, message, kept[-1].span, "mend these first, then check again")]
