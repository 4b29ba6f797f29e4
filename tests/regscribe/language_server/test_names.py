"""Definition, references, outline and renaming, across the files of a map."""

import re

import pytest

from regscribe.language_server.files import Files, MapText, Spot
from regscribe.language_server.hover import hover
from regscribe.language_server.navigation import named_at, outline, references, targets
from regscribe.language_server.rename import RenameRefusedError, apply, renamed
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.source import SourcePlace

from .conftest import At
from .texts import HEAD

COMMON = """\
format: 1
library: {id: acme/common, title: Common}
enums:
  shared: {0: a, 1: b}
sets:
  zone:
    - {at: 0, name: Level, access: rw, type: int16, source: "4"}
    - {at: 1, name: Limit, access: rw, type: int16, source: "4", range: {from: 0, to: level}}
"""
USING = HEAD.replace("conditions:", "uses: [acme/common]\nconditions:", 1) + (
    "      - {at: 20, name: Shared, type: uint16, enum: shared}\n"
    "      - {id: zones, name: Zone, repeat: 1..2, stride: 10, registers: [{set: zone, shift: 100}]}\n"
    "      - {at: 40, name: Copy, shadows: 'zones[2].level'}\n"
)


def marked(text: str, part: str, more: int = 0) -> str:
    place = text.index(part) + more
    return f"{text[:place]}│{text[place:]}"


def where(spots: list[Spot]) -> list[str]:
    return sorted(f"{spot.file.name}:{spot.place.line + 1}" for spot in spots)


def rename(at: At, text: str, new: str, **more: str) -> dict[str, str]:
    """The texts of all files after a renaming."""
    files, file, line, column = at(text, **more)
    found = named_at(files, file, line, column)
    assert found is not None
    every = [one for path in files.unsaved if (one := files.get(path))]
    changes = renamed(files, file, found[1], new, every)
    return {path.name: apply(files.text_of(path) or "", edits) for path, edits in changes.items()}


def compiled(files: Files, file: MapText) -> RegisterMap | None:
    return compile_map(file.path, files.unsaved).map


@pytest.mark.parametrize(
    ("text", "part", "more", "expected"),
    [
        (HEAD, "enum: mode", 7, ["one.yaml:14"]),
        (HEAD, "fahrenheit: 1", 2, ["one.yaml:22"]),
        (HEAD, "unit: temperature", 8, ["one.yaml:10"]),
        (HEAD + "      - {at: 13, name: X, when: manual_mode}\n", "when: manual_mode", 8, ["one.yaml:8"]),
        (USING, "enum: shared", 8, ["common.library.yaml:4"]),
        (USING, "set: zone", 6, ["common.library.yaml:6"]),
        (USING, "[acme/common", 3, ["common.library.yaml:1"]),
        (USING, "zones[2].level", 2, ["one.yaml:26"]),
        (USING, "zones[2].level", 11, ["common.library.yaml:7"]),
        (HEAD, "title: One", 8, []),
    ],
)
def test_a_name_leads_to_where_it_is_declared(at: At, text: str, part: str, more: int, expected: list[str]) -> None:
    assert where(targets(*at(marked(text, part, more), common__library__yaml=COMMON))) == expected


def test_all_uses_of_a_register_in_a_set_are_found(at: At) -> None:
    files, file, line, column = at(marked(USING, "zones[2].level", 11), common__library__yaml=COMMON)
    found = named_at(files, file, line, column)
    assert found is not None
    assert where(references(files, file, found[1], [])) == ["common.library.yaml:8", "one.yaml:27"]


def test_the_outline_has_groups_with_registers_and_tables_with_names(at: At) -> None:
    found = {one.name: [each.name for each in one.inside] for one in outline(at(HEAD)[1])}
    assert found["control"] == ["mode", "fahrenheit", "setpoint"]
    assert found["enums"] == ["mode"]
    assert found["conditions"] == ["manual_mode"]


def test_a_broken_line_hides_nothing_else_from_the_outline(at: At) -> None:
    found = {
        one.name: one.inside
        for one in outline(at(HEAD.replace("mode: {0: automatic, 1: manual}", "mode: {0: auto"))[1])
    }
    assert [one.name for one in found["control"]] == ["mode", "fahrenheit", "setpoint"]


@pytest.mark.parametrize(
    ("text", "part", "more", "new", "changed"),
    [
        (HEAD, "enum: mode", 7, "operation", ["operation: {0", "enum: operation"]),
        (HEAD, "fahrenheit: 1", 2, "degrees", ["{when: {degrees: 1}", "id: degrees, name: Fahrenheit"]),
        (HEAD, "unit: temperature", 8, "heat", ["  heat:\n", "unit: heat"]),
        (HEAD, "A1", 1, "A9", ["models: {A9: {}"]),
        (USING, "enum: shared", 8, "common", ["enum: common"]),
        (USING, "zones[2].level", 11, "depth", ["'zones[2].depth'"]),
        (USING, "zones[2].level", 2, "areas", ["id: areas,", "'areas[2].level'"]),
        (HEAD, "- id: control", 8, "main", ["- id: main"]),
    ],
)
def test_a_renamed_thing_has_its_new_name_everywhere_and_the_map_compiles(
    at: At, text: str, part: str, more: int, new: str, changed: list[str]
) -> None:
    after = rename(at, marked(text, part, more), new, common__library__yaml=COMMON)
    assert all(one in after["one.yaml"] for one in changed)
    files, file, _, _ = at(after["one.yaml"], common__library__yaml=after.get("common.library.yaml", COMMON))
    before = at(text, common__library__yaml=COMMON)
    now, then = compiled(files, file), compiled(*before[:2])
    assert now is not None
    assert then is not None
    addresses = [[one.address for one in each.models[0].registers] for each in (now, then)]
    assert addresses[0] == addresses[1]


def test_a_renamed_register_of_a_library_is_renamed_in_the_library(at: At) -> None:
    after = rename(at, marked(USING, "zones[2].level", 11), "depth", common__library__yaml=COMMON)
    assert "id: depth, name: Level" in after["common.library.yaml"]
    assert "to: depth" in after["common.library.yaml"]


@pytest.mark.parametrize(
    ("part", "more", "new", "reason"),
    [
        ("fahrenheit: 1", 2, "mode", "there is a register `mode` already: one.yaml:21"),
        ("fahrenheit: 1", 2, "Mode 2", "`Mode 2` is no name of a register"),
        ("enum: mode", 7, "x-mode", "is no name of a enum"),
        ("fahrenheit: 1", 2, "class", "the map would be wrong"),
    ],
)
def test_a_name_that_cannot_be_is_refused(at: At, part: str, more: int, new: str, reason: str) -> None:
    with pytest.raises(RenameRefusedError, match=reason):
        rename(at, marked(HEAD, part, more), new)


def test_a_key_says_what_the_language_says_of_it(at: At) -> None:
    found = hover(*at(marked(HEAD, "decimals: 1", 3)), None)
    assert found is not None
    assert found[1].startswith("**decimals**")


def test_an_enum_shows_its_codes(at: At) -> None:
    found = hover(*at(marked(HEAD, "enum: mode", 7)), None)
    assert found is not None
    assert "0: automatic, 1: manual" in found[1]


def test_a_condition_shows_what_it_means_and_where_its_registers_stand(at: At) -> None:
    line = "      - {at: 13, name: X, when: manual_mode, models: [B2]}\n"
    files, file, row, column = at(marked(HEAD + line, "when: manual_mode", 8))
    found = hover(files, file, row, column, compiled(files, file))
    assert found is not None
    assert "manual_mode: {mode: manual}" in found[1]
    assert "B2: Holds when mode is manual (1) (`mode`: holding 10)." in found[1]


def test_a_register_shows_what_it_compiles_to(at: At) -> None:
    files, file, line, column = at(marked(HEAD, "at: 12", 4))
    found = hover(files, file, line, column, compiled(files, file))
    assert found is not None
    for said in (
        "| view | space | type | address | hex | absolute |\n",  # which is Modicon's number: it is not told twice
        "| base | holding | int16 | 12 | 0xC | 40013 |\n",
        "unit: fahrenheit is 1: °F; otherwise: °C",
        "range: -10 to 250.5",
        "0302 = 77 °F",  # 770, the default in tenths, while fahrenheit is at its default
        "setpoint = ReadWrite(",
    ):
        assert said in found[1]


def test_what_a_map_says_is_escaped_in_a_hover(at: At) -> None:
    files, file, line, column = at(marked(HEAD.replace("name: Setpoint", "name: 'Set [x](y) <b>'"), "at: 12", 4))
    found = hover(files, file, line, column, compiled(files, file))
    assert found is not None
    assert "[x](y)" not in found[1].split("```")[0]
    assert "<b>" not in found[1].split("```")[0]


def test_names_in_a_setpoint_program_are_those_of_its_arrays(at: At) -> None:
    program = (
        "      - id: programs\n        name: Program\n        repeat: 1..2\n        stride: 100\n        registers:\n"
        "          - {id: segments, repeat: 1..4, registers: [{at: 200, name: Level}, {at: 201, name: Time}]}\n"
        "programs:\n  recipe:\n    name: Recipe\n    array: programs\n"
        "    segments: {array: segments, setpoint: level, ramp: time}\n"
    )
    for part, expected in (
        ("array: programs", 24),
        ("array: segments", 29),
        ("setpoint: level", 29),
        ("ramp: time", 29),
    ):
        text = marked(HEAD + program, part, part.index(":") + 3)
        assert where(targets(*at(text))) == [f"one.yaml:{expected}"]


def test_words_that_stand_apart_are_told_one_by_one(at: At) -> None:
    lines = "      - {at: [32, 30], name: Total, type: uint32, access: r}\n      - {at: 31, name: Between}\n"
    files, file, row, column = at(marked(HEAD + lines, "Total", 1))
    found = hover(files, file, row, column, compiled(files, file))
    assert found is not None
    assert "32" in found[1]
    assert "30 to 31" not in found[1]
    assert {"30", "32"} <= set(re.findall(r"\d+", found[1].split("| base |")[1].split("\n")[0]))


def test_a_name_that_is_used_twice_in_a_line_is_changed_in_both_places() -> None:
    first, second = SourcePlace(0, 1, 0, 3), SourcePlace(0, 6, 0, 8)
    assert apply("[lo, -lo]", [(first, "lowest"), (second, "lowest")]) == "[lowest, -lowest]"
