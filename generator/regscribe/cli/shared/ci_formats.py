"""Diagnostics for machines that show them beside a merge request: one line each, JUnit's XML, GitLab's code quality.

https://github.com/testmoapp/junitxml and https://docs.gitlab.com/ci/testing/code_quality/ say what these look like.
"""

import hashlib
import json
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import PurePath
from xml.etree import ElementTree as ET

from regscribe.model import Diagnostic, Severity
from regscribe.visible import safe, safe_lines

GRADES = {Severity.ERROR: "major", Severity.WARNING: "minor"}
"""GitLab's words for how bad it is."""


def as_concise(diagnostics: Iterable[Diagnostic]) -> str:
    """Return one line a diagnostic, as compilers write them and editors read them."""
    return "".join(f"{safe(f'{one.span}: {one.severity.value}[{one.rule}]: {one.message}')}\n" for one in diagnostics)


def as_gitlab(diagnostics: Iterable[Diagnostic]) -> str:
    """Return the list of a code quality report; a fingerprint stays when lines above are added or removed."""
    seen: Counter[str] = Counter()
    found = []
    for one in diagnostics:
        path = PurePath(one.span.file).as_posix()
        what = f"{one.rule} {path} {one.message}"
        seen[what] += 1
        issue = {
            "description": f"{one.message} ({one.help})" if one.help else one.message,
            "check_name": one.rule,
            "fingerprint": hashlib.sha256(f"{what} {seen[what]}".encode(errors="surrogateescape")).hexdigest(),
            "severity": GRADES[one.severity],
            "location": {"path": path, "lines": {"begin": one.span.line, "end": max(one.span.line, one.span.end_line)}},
        }
        found.append(issue)
    return json.dumps(found, indent=2) + "\n"


def as_junit(diagnostics: Sequence[Diagnostic], files: Iterable[str] = ()) -> str:
    """Return a test suite for each file, with a test for each diagnostic; one that passes for a file without any."""
    by_file: dict[str, list[Diagnostic]] = {safe(file): [] for file in files}
    for one in diagnostics:
        by_file.setdefault(safe(one.span.file), []).append(one)
    tests = sum(max(len(found), 1) for found in by_file.values())
    root = ET.Element("testsuites", _counts("regscribe", tests, len(diagnostics)))
    for file, found in by_file.items():
        suite = ET.SubElement(root, "testsuite", _counts(file, max(len(found), 1), len(found)))
        for one in found:
            test = ET.SubElement(suite, "testcase", name=one.rule, classname=file, line=str(one.span.line))
            failure = ET.SubElement(test, "failure", type=one.severity.value, message=safe(one.message))
            failure.text = safe_lines("\n".join(filter(None, (str(one.span), one.message, one.help))))
        if not found:
            ET.SubElement(suite, "testcase", name="check", classname=file)
    ET.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _counts(name: str, tests: int, failures: int) -> dict[str, str]:
    return {"name": name, "tests": str(tests), "failures": str(failures), "errors": "0"}
