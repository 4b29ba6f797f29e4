"""`check` and `breaking` for machines: one line each, JUnit's XML, GitLab's code quality, by their published shapes."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from regscribe.cli.shared.ci_formats import as_concise, as_gitlab, as_junit
from regscribe.model import Diagnostic, Severity, Span

Cli = Callable[..., Any]
ERROR = Diagnostic("RS0203", 'two & "one" <overlap>', Span("maps/a.yaml", 2, 3, 2, 6), "move one")
WARNING = Diagnostic("RS0472", "nothing is\x1b against it", Span("maps/a.yaml", 9, 1, 11, 2), severity=Severity.WARNING)


def test_a_concise_line_is_that_of_a_compiler() -> None:
    assert as_concise([ERROR, WARNING]) == (
        'maps/a.yaml:2:3: error[RS0203]: two & "one" <overlap>\n'
        "maps/a.yaml:9:1: warning[RS0472]: nothing is\\x1b against it\n"
    )
    assert as_concise([]) == ""


def test_gitlab_gets_what_its_code_quality_report_demands() -> None:
    error, warning = json.loads(as_gitlab([ERROR, WARNING]))
    assert re.fullmatch("[0-9a-f]{64}", error.pop("fingerprint"))
    assert error == {
        "description": 'two & "one" <overlap> (move one)',
        "check_name": "RS0203",
        "severity": "major",
        "location": {"path": "maps/a.yaml", "lines": {"begin": 2, "end": 2}},
    }
    assert (warning["severity"], warning["location"]["lines"]) == ("minor", {"begin": 9, "end": 11})
    assert json.loads(as_gitlab([])) == []


def test_a_fingerprint_stays_where_lines_move_and_is_of_one_finding_alone() -> None:
    moved = Diagnostic(ERROR.rule, ERROR.message, Span("maps/a.yaml", 7, 3, 7, 6), ERROR.help)
    first, again = (one["fingerprint"] for one in json.loads(as_gitlab([ERROR, moved])))
    assert first != again
    assert json.loads(as_gitlab([moved]))[0]["fingerprint"] == first


def test_junit_has_a_suite_for_each_file_and_a_failure_for_each_finding() -> None:
    root = ET.fromstring(as_junit([ERROR, WARNING], ["maps/a.yaml", "maps/good.yaml"]))  # noqa: S314 - our own
    assert (root.tag, root.attrib) == (
        "testsuites",
        {"name": "regscribe", "tests": "3", "failures": "2", "errors": "0"},
    )
    bad, good = root
    assert bad.attrib == {"name": "maps/a.yaml", "tests": "2", "failures": "2", "errors": "0"}
    assert [case.attrib for case in bad] == [
        {"name": "RS0203", "classname": "maps/a.yaml", "line": "2"},
        {"name": "RS0472", "classname": "maps/a.yaml", "line": "9"},
    ]
    failure = bad[0][0]
    assert (failure.tag, failure.attrib) == ("failure", {"type": "error", "message": 'two & "one" <overlap>'})
    assert failure.text == 'maps/a.yaml:2:3\ntwo & "one" <overlap>\nmove one'
    assert bad[1][0].attrib["message"] == "nothing is\\x1b against it"
    assert good.attrib == {"name": "maps/good.yaml", "tests": "1", "failures": "0", "errors": "0"}
    assert [(case.tag, len(case)) for case in good] == [("testcase", 0)]


@pytest.mark.parametrize("form", ["concise", "gitlab", "junit"])
def test_check_and_breaking_print_every_form(cli: Cli, oven: Path, folder: Path, form: str) -> None:
    before = folder / "before.yaml"
    before.write_text(oven.read_text())
    assert cli("check", "--format", form).code == 0
    oven.write_text(oven.read_text().replace("at: 2,", "at: 3,"))
    moved = cli("breaking", "--against", before, "--format", form)
    assert (moved.code, "maps/acme/oven.yaml" in moved.out) == (1, True)
    oven.write_text("format: 1\n")
    wrong = cli("check", "--format", form)
    assert (wrong.code, "RS0" in wrong.out, wrong.err) == (1, True, "")


def test_format_json_and_json_are_the_same_with_live_commands(cli: Cli) -> None:
    frame = ("decode", "16C", "01 03 0F D1 00 01 D7 27")
    assert cli(*frame, "--format", "json").out == cli(*frame, "--json").out != cli(*frame).out
    assert cli(*frame, "--format", "text").out == cli(*frame).out
