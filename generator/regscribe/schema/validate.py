"""A document against the schema: every mistake in one run, each once and at its place."""

from itertools import islice

from regscribe.model import Diagnostic, Span
from regscribe.schema.messages import complaints, violation
from regscribe.schema.quick_check import certainly_valid
from regscribe.schema.rules import TOO_MANY_ERRORS
from regscribe.schema.schemas import MAP, places, validator
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
        for complaint in islice(complaints(violation(error), places(language)), MAX_ERRORS):
            find = document.key_span if complaint.at_key else document.span
            span = find(complaint.path)
            said = complaint.rule, complaint.message, span, complaint.advice
            diagnostic = Diagnostic(*said, replacement=complaint.replacement)
            subject = complaint.message if complaint.subject is None else complaint.subject
            found.setdefault((complaint.rule, span, subject), diagnostic)
    ordered = sorted(found.values(), key=lambda diagnostic: (diagnostic.span, diagnostic.rule, diagnostic.message))
    if len(errors) < MAX_ERRORS and len(ordered) <= MAX_ERRORS:
        return ordered
    kept = ordered[:MAX_ERRORS]
    message = f"{len(kept)} errors up to here; there may be more"
    return [*kept, Diagnostic(TOO_MANY_ERRORS, message, kept[-1].span, "mend these first, then check again")]
