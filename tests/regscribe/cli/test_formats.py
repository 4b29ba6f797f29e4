import json
from pathlib import Path

import pytest

from regscribe.cli.shared.diagnostic_text import WIDTH, excerpt, findings, read_lines, tally
from regscribe.cli.shared.report_formats import as_github, as_json, as_sarif
from regscribe.model import Diagnostic, Related, Rule, Severity, Span
from regscribe.visible import safe


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("a map.yaml").write_text("one: 1\n  two: [°C, 測, x]\n\tthree\n" + "z" * 400 + "!\n", encoding="utf-8")
    return "a map.yaml"


def diagnostic(span: Span, **more: object) -> Diagnostic:
    return Diagnostic("RS0203", "`two` overlaps `one` at 12", span, **more)  # type: ignore[arg-type] # test shorthand


def text_of(one: Diagnostic) -> str:
    return "".join(text for text, _ in findings([one]))


def test_text_shows_message_place_line_carets_other_party_and_help(source: str) -> None:
    related = Related("`one` stands here", Span(source, 1, 1, 1, 4))
    shown = text_of(diagnostic(Span(source, 2, 3, 2, 6), related=(related,), help="move one of them"))
    assert shown == (
        "error[RS0203]: `two` overlaps `one` at 12\n"
        "  --> a map.yaml:2:3\n"
        "    2 |   two: [°C, 測, x]\n"
        "      |   ^^^\n"
        "  note: `one` stands here\n"
        "  --> a map.yaml:1:1\n"
        "    1 | one: 1\n"
        "      | ^^^\n"
        "  help: move one of them\n"
        "\n"
    )


def test_carets_stand_under_their_text_behind_wide_characters(source: str) -> None:
    shown = excerpt(Span(source, 2, 16, 2, 17), read_lines(source))
    assert shown is not None
    assert shown[0][15] == "x"
    assert shown[1] == " " * 16 + "^"


def test_a_tab_takes_one_column(source: str) -> None:
    shown = excerpt(Span(source, 3, 2, 3, 7), read_lines(source))
    assert shown is not None
    assert shown == (" three", " ^^^^^")


def test_a_span_over_several_lines_is_marked_to_the_end_of_its_first_line(source: str) -> None:
    shown = excerpt(Span(source, 1, 1, 3, 2), read_lines(source))
    assert shown is not None
    assert shown[1] == "^^^^^^"


def test_a_long_line_is_cut_around_its_carets(source: str) -> None:
    shown = excerpt(Span(source, 4, 401, 4, 402), read_lines(source))
    assert shown is not None
    assert shown[0].startswith("…")
    assert shown[0][len(shown[1]) - 1] == "!"
    assert len(shown[0]) <= WIDTH + 2


@pytest.mark.parametrize(("file", "line"), [("gone.yaml", 1), (".", 1), ("", 99), ("", 0)])
def test_a_line_that_cannot_be_shown_is_left_out(source: str, file: str, line: int) -> None:
    assert excerpt(Span(file or source, line), read_lines(file or source)) is None


def test_escape_sequences_of_a_map_do_not_reach_the_terminal() -> None:
    assert safe("\x1b[2Jred\u202e\n") == "\\x1b[2Jred\\u202e\\n"


def test_the_tally_names_errors_and_warnings() -> None:
    warning = diagnostic(Span("m"), severity=Severity.WARNING)
    assert tally([]) == "no findings"
    assert tally([diagnostic(Span("m")), warning, warning]) == "1 error, 2 warnings"


def test_json_holds_every_part_of_a_diagnostic() -> None:
    span = Span("m.yaml", 2, 3, 2, 6)
    one = diagnostic(span, related=(Related("other", Span("m.yaml", 1, 1, 1, 4)),), help="move", replacement="on")
    place = {"file": "m.yaml", "line": 2, "column": 3, "end_line": 2, "end_column": 6}
    other = {"message": "other", "file": "m.yaml", "line": 1, "column": 1, "end_line": 1, "end_column": 4}
    message = {"rule": "RS0203", "severity": "error", "message": "`two` overlaps `one` at 12", "help": "move"}
    message["replacement"] = "on"
    assert json.loads(as_json([one])) == {
        "format": 1,
        "errors": 1,
        "warnings": 0,
        "diagnostics": [{**message, **place, "related": [other]}],
    }


def test_github_annotations_escape_what_would_end_them() -> None:
    one = Diagnostic("RS0203", "50% :: a\nb", Span("a,b:c.yaml", 2, 3, 2, 6), severity=Severity.WARNING)
    assert as_github([one]) == (
        "::warning file=a%2Cb%3Ac.yaml,line=2,endLine=2,col=3,endColumn=6,title=RS0203::50%25 :: a%0Ab\n"
    )


def test_sarif_places_results_and_describes_their_rules() -> None:
    one = diagnostic(Span("maps/a b.yaml", 2, 3, 2, 6), related=(Related("other", Span("/m.yaml")),), help="move")
    log = json.loads(as_sarif([one], {"RS0203": Rule("RS0203", "Overlap", "Two meanings.")}))
    (run,) = log["runs"]
    assert log["version"] == "2.1.0"
    assert run["tool"]["driver"]["rules"] == [
        {
            "id": "RS0203",
            "shortDescription": {"text": "Overlap"},
            "fullDescription": {"text": "Two meanings."},
            "defaultConfiguration": {"level": "error"},
        }
    ]
    (result,) = run["results"]
    assert (result["ruleId"], result["ruleIndex"], result["level"]) == ("RS0203", 0, "error")
    assert result["locations"][0]["physicalLocation"] == {
        "artifactLocation": {"uri": "maps/a%20b.yaml"},
        "region": {"startLine": 2, "startColumn": 3, "endLine": 2, "endColumn": 6},
    }
    assert result["relatedLocations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "file:///m.yaml"


def test_sarif_says_what_to_write_in_place_of_a_name_as_yaml_reads_it() -> None:
    one = diagnostic(Span("m.yaml", 2, 3, 2, 6), replacement="null")
    (fix,) = json.loads(as_sarif([one], {}))["runs"][0]["results"][0]["fixes"]
    (change,) = fix["artifactChanges"]
    region = {"startLine": 2, "startColumn": 3, "endLine": 2, "endColumn": 6}
    assert change["artifactLocation"] == {"uri": "m.yaml"}
    assert change["replacements"] == [{"deletedRegion": region, "insertedContent": {"text": "'null'"}}]
    assert "fixes" not in json.loads(as_sarif([diagnostic(Span("m.yaml"))], {}))["runs"][0]["results"][0]


def test_sarif_of_nothing_is_a_log_with_an_empty_run() -> None:
    assert json.loads(as_sarif([], {}))["runs"][0]["results"] == []
