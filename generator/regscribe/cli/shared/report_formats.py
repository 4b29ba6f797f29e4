"""Diagnostics for programs: JSON, annotations that GitHub shows beside the line, and SARIF 2.1.0 for editors and hosts.

https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html
"""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from urllib.parse import quote

from regscribe import __version__
from regscribe.model import Diagnostic, Rule, Severity, Span
from regscribe.schema import inline

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"

Json = dict[str, object]


def as_json(diagnostics: Sequence[Diagnostic]) -> str:
    """Return one JSON object with all diagnostics; lines and columns count from 1, `end_column` is exclusive."""
    numbers = {f"{severity.value}s": sum(one.severity is severity for one in diagnostics) for severity in Severity}
    return json.dumps({"format": 1, **numbers, "diagnostics": [_plain(one) for one in diagnostics]}, indent=2) + "\n"


def _plain(diagnostic: Diagnostic) -> Json:
    return {
        "rule": diagnostic.rule,
        "severity": diagnostic.severity.value,
        "message": diagnostic.message,
        **asdict(diagnostic.span),
        "help": diagnostic.help,
        "replacement": diagnostic.replacement,
        "related": [{"message": related.message, **asdict(related.span)} for related in diagnostic.related],
    }


def as_github(diagnostics: Iterable[Diagnostic]) -> str:
    """Return one workflow command a diagnostic."""
    annotations = ""
    for diagnostic in diagnostics:
        span = diagnostic.span
        place = {"file": span.file, "line": span.line, "endLine": max(span.line, span.end_line), "col": span.column}
        if span.end_line == span.line:
            place["endColumn"] = span.end_column
        place["title"] = diagnostic.rule
        values = {key: _escaped(str(value)).replace(":", "%3A").replace(",", "%2C") for key, value in place.items()}
        properties = ",".join(f"{key}={value}" for key, value in values.items())
        more = [f"{related.message} ({related.span})" for related in diagnostic.related]
        message = "\n".join(filter(None, [diagnostic.message, *more, diagnostic.help]))
        annotations += f"::{diagnostic.severity.value} {properties}::{_escaped(message)}\n"
    return annotations


def _escaped(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def as_sarif(diagnostics: Sequence[Diagnostic], rules: Mapping[str, Rule]) -> str:
    """Return one run with all diagnostics; `rules` describes those that occur, as far as it knows them."""
    ids = sorted({diagnostic.rule for diagnostic in diagnostics})
    driver = {"name": "regscribe", "semanticVersion": __version__, "rules": [_rule(one, rules.get(one)) for one in ids]}
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [_result(diagnostic, ids.index(diagnostic.rule)) for diagnostic in diagnostics],
    }
    return json.dumps({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2) + "\n"


def _rule(rule_id: str, rule: Rule | None) -> Json:
    if rule is None:
        return {"id": rule_id}
    return {
        "id": rule_id,
        "shortDescription": {"text": rule.title},
        "fullDescription": {"text": rule.why},
        "defaultConfiguration": {"level": rule.severity.value},
    }


def _result(diagnostic: Diagnostic, rule_index: int) -> Json:
    message = f"{diagnostic.message}\n{diagnostic.help}" if diagnostic.help else diagnostic.message
    related = [
        {"id": number, "message": {"text": one.message}, **_location(one.span)}
        for number, one in enumerate(diagnostic.related, start=1)
    ]
    return {
        "ruleId": diagnostic.rule,
        "ruleIndex": rule_index,
        "level": diagnostic.severity.value,
        "message": {"text": message},
        "locations": [_location(diagnostic.span)],
        **({"relatedLocations": related} if related else {}),
        **({"fixes": [_fix(diagnostic)]} if diagnostic.replacement else {}),
    }


def _fix(diagnostic: Diagnostic) -> Json:
    location = _location(diagnostic.span)["physicalLocation"]
    change = {"deletedRegion": location["region"], "insertedContent": {"text": inline(diagnostic.replacement)}}
    where = {"artifactLocation": location["artifactLocation"], "replacements": [change]}
    return {"description": {"text": f"write `{diagnostic.replacement}`"}, "artifactChanges": [where]}


def _location(span: Span) -> dict[str, Json]:
    path = Path(span.file)
    uri = path.as_uri() if path.is_absolute() else quote(path.as_posix())
    end_line = max(span.line, span.end_line)
    region = {"startLine": span.line, "startColumn": span.column, "endLine": end_line, "endColumn": span.end_column}
    return {"physicalLocation": {"artifactLocation": {"uri": uri}, "region": region}}
