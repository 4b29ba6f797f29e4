"""Diagnostics for programs: JSON, and annotations that GitHub shows beside the line."""

import json
from collections.abc import Iterable
from dataclasses import asdict

from regscribe.model import Diagnostic, Severity


def as_json(diagnostics: Iterable[Diagnostic]) -> str:
    """Return one JSON object with all diagnostics; lines and columns count from 1, `end_column` is exclusive."""
    found = list(diagnostics)
    numbers = {f"{severity.value}s": sum(one.severity is severity for one in found) for severity in Severity}
    return json.dumps({"format": 1, **numbers, "diagnostics": [_plain(one) for one in found]}, indent=2) + "\n"


def as_github(diagnostics: Iterable[Diagnostic]) -> str:
    """Return one workflow command a diagnostic."""
    return "".join(f"{_annotation(diagnostic)}\n" for diagnostic in diagnostics)


def _plain(diagnostic: Diagnostic) -> dict[str, object]:
    return {
        "rule": diagnostic.rule,
        "severity": diagnostic.severity.value,
        "message": diagnostic.message,
        **asdict(diagnostic.span),
        "help": diagnostic.help,
        "related": [{"message": related.message, **asdict(related.span)} for related in diagnostic.related],
    }


def _annotation(diagnostic: Diagnostic) -> str:
    span = diagnostic.span
    level = "error" if diagnostic.severity is Severity.ERROR else "warning"
    place = {"file": span.file, "line": span.line, "endLine": max(span.line, span.end_line), "col": span.column}
    if span.end_line == span.line:
        place["endColumn"] = span.end_column
    properties = ",".join(
        f"{key}={_property(str(value))}" for key, value in (place | {"title": diagnostic.rule}).items()
    )
    more = [f"{related.message} ({related.span})" for related in diagnostic.related]
    message = "\n".join(filter(None, [diagnostic.message, *more, diagnostic.help]))
    return f"::{level} {properties}::{_data(message)}"


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
