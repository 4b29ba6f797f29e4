"""What an editor is told: what `check` says, in the editor's positions; and mends of it."""

import json
from pathlib import Path

import pytest
from lsprotocol.types import Position, PositionEncodingKind

from regscribe.checks.catalogue import all_rules, examples
from regscribe.cli.shared.report_formats import as_json
from regscribe.language_server.files import Files
from regscribe.language_server.fixes import fixes
from regscribe.language_server.lenses import other_addresses, read_examples
from regscribe.language_server.positions import Positions
from regscribe.language_server.protocol_values import Lines, diagnostic
from regscribe.language_server.rename import apply
from regscribe.language_server.session import Session, compile_text
from regscribe.pipeline import compile_map
from regscribe.source import display_name
from regscribe.visible import tame

from .conftest import At
from .texts import HEAD

NO_MAP = "RS0107"
"""Of an empty file nobody knows that it is to be a map."""

KNOWN = [rule.id for rule in all_rules() if rule.id != NO_MAP and not rule.id.startswith("RS07")]
BAD = {rule: bad for rule in KNOWN if (bad := examples(rule)[0])}


@pytest.mark.parametrize("rule", BAD)
def test_an_editor_is_told_what_check_says_of_each_broken_example(rule: str, tmp_path: Path) -> None:
    texts = {tmp_path / "maps" / name: text for name, text in BAD[rule]}
    main = next(iter(texts))
    session = Session(Files(dict(texts)))
    session.found = {
        one: compile_text(one, texts, file).diagnostics for one in (main,) if (file := session.files.get(one))
    }
    lines = {display_name(path): (path, text.split("\n")) for path, text in texts.items()}
    told = []
    for path in texts:
        for one in session.findings_in(path):
            sent = diagnostic(one, lines[display_name(path)][1], Lines(lines), Positions(PositionEncodingKind.Utf32))
            start, end = sent.range.start, sent.range.end
            place = (start.line + 1, start.character + 1, end.line + 1, end.character + 1)
            told.append((sent.code, sent.message, display_name(path), *place))
    expected = []
    for one in json.loads(as_json(compile_map(main, texts).diagnostics))["diagnostics"]:
        said = tame("\n".join(filter(None, (one["message"], one["help"]))))
        expected.append(
            (one["rule"], said, one["file"], one["line"], one["column"], one["end_line"], one["end_column"])
        )
    assert sorted(told) == sorted(set(expected))


@pytest.mark.parametrize(
    ("encoding", "units"),
    [
        (PositionEncodingKind.Utf8, [0, 1, 3, 7, 8]),
        (PositionEncodingKind.Utf16, [0, 1, 2, 4, 5]),
        (PositionEncodingKind.Utf32, [0, 1, 2, 3, 4]),
    ],
)
def test_positions_count_as_the_client_does(encoding: PositionEncodingKind, units: list[int]) -> None:
    positions, lines = Positions(encoding), ["a°🌡b"]
    assert [positions.position(lines, 0, column).character for column in range(5)] == units
    assert [positions.cursor(lines, Position(0, unit))[1] for unit in units] == [0, 1, 2, 3, 4]
    assert positions.position(lines, 9, 0) == Position(0, units[-1])
    assert positions.cursor(lines, Position(0, 99)) == (0, 4)


def mends(at: At, text: str) -> dict[str, str]:
    """The text after each mend that is offered, by its title."""
    files, file, _, _ = at(text)
    found = compile_map(file.path, files.unsaved).diagnostics
    return {fix.title: apply(file.text, fix.edits) for one in found for fix in fixes(files, file, one)}


@pytest.mark.parametrize(
    ("line", "title", "mended"),
    [
        ("{at: 20, name: A, uint: s}", "Write `unit`", "{at: 20, name: A, unit: s}"),
        ("{at: 20, label: A}", "Write `name`", "{at: 20, name: A}"),
        ("{at: 20, name: A, enum: mod}", "Write `mode`", "{at: 20, name: A, enum: mode}"),
        ("{at: 20, name: A, unit: percent}", "Write `%`", "{at: 20, name: A, unit: '%'}"),
        ("{at: 20, unit: s}", "Add `name`", "{at: 20, unit: s, name: Alarm 1 Action}"),
        ("at: 20\n        unit: s", "Add `name`", "at: 20\n        unit: s\n        name: Alarm 1 Action"),
        ("{at: 11, name: A}", "Move it to 13, the next free address", "{at: 13, name: A}"),
        ("{at: 11, name: A, type: int32}", "Move it to 13, the next free address", "{at: 13, name: A, type: int32}"),
    ],
)
def test_a_mend_writes_what_was_meant(at: At, line: str, title: str, mended: str) -> None:
    assert mends(at, f"{HEAD}      - {line}\n")[title] == f"{HEAD}      - {mended}\n"


def test_a_free_address_is_found_behind_all_that_are_taken(at: At) -> None:
    taken = "".join(f"      - {{at: {number}, name: Taken {number}}}\n" for number in range(13, 30))
    found = mends(at, f"{HEAD}{taken}      - {{at: 11, name: A}}\n")
    assert "Move it to 30, the next free address" in found


def test_examples_are_read_with_the_state_that_they_name(at: At) -> None:
    example = "examples:\n  - {register: setpoint, words: [1505], value: 150.5, with: {fahrenheit: 0}}\n"
    files, file, _, _ = at(HEAD + example)
    found = compile_map(file.path, files.unsaved).map
    assert found is not None
    assert [said for _, said in read_examples(file, found)] == ["05 E1 = 150.5 °C"]


@pytest.mark.parametrize(
    ("frame", "facts", "said"),
    [
        (
            "07 03 00 0A 00 03",
            "function: 3, address: 10, count: 3",
            "to unit 7, function 03: mode, fahrenheit, setpoint",
        ),
        ("07 06 00 0C 05 E1", "function: 6, words: [1505], with: {fahrenheit: 0}", "setpoint = 150.5 °C"),
        (
            "07 06 00 0C 05 E1",
            "function: 6, writes: {setpoint: 150.5}, answer: true",
            "from unit 7, function 06: setpoint",
        ),
        ("07 03 04 00 01 00 00", "function: 3, address: 10, answer: true", "mode = 1 = manual, fahrenheit = 0"),
        ("07 03 02 00 01", "function: 3, answer: true", "from unit 7, function 03"),
        ("07 83 02", "function: 0x83, answer: true", "from unit 7, function 03: exception 2"),
    ],
)
def test_a_worked_frame_is_read(at: At, frame: str, facts: str, said: str) -> None:
    example = f"examples:\n  - {{source: '9', frame: {frame}, crc: false, unit: 7, {facts}}}\n"
    files, file, _, _ = at(HEAD + example)
    compiled = compile_map(file.path, files.unsaved)
    assert compiled.map is not None, compiled.diagnostics
    assert said in next(text for _, text in read_examples(file, compiled.map))


def test_addresses_are_told_in_other_notations_where_they_stand(at: At) -> None:
    files, file, _, _ = at(HEAD)
    found = compile_map(file.path, files.unsaved).map
    assert found is not None
    lines = HEAD.split("\n")
    told = [(lines[place.line][place.column : place.end_column], said) for place, said in other_addresses(file, found)]
    assert told == [("10", "0xA (40011)"), ("11", "0xB (40012)"), ("12", "0xC (40013)")]
