"""What the functions of the page say besides words and values: requests, what decides, computed values, names."""

from typing import Any

import pytest

from regscribe.emit.vectors import document as vectors
from regscribe.map_files import data_folder
from regscribe.pipeline import compile_map
from regscribe.register_browser import document

from ...conformance.browser_codec import evaluate  # noqa: TID252 (test folders are no packages)
from ...conformance.suite import Json, diagnose, errors_of, whole_map  # noqa: TID252 (as above)
from ...conformance.test_computed import CONDITIONAL, REGISTERS, TERMS  # noqa: TID252 (as above)

PARTS: Json = {
    "givens": {"ratio": {"type": "number", "default": 2, "description": "a ratio", "reason": "not in this manual"}},
    "decimals": {"digits": {"register": "places"}},
    "units": {"flow": [{"when": {"mode": "on"}, "symbol": "l/h"}, {"symbol": "%"}]},
    "enums": {"mode": {0: "off", 1: "on", 2: "service"}},
    "registers": [
        {"at": 0, "name": "Mode", "enum": "mode"},
        {"at": 1, "name": "Level", "type": "uint16"},
        {"at": 3, "name": "Places", "type": "uint16"},
        {
            "at": 4,
            "name": "Flow",
            "type": "int16",
            "decimals": "digits",
            "unit": "flow",
            "range": {"from": 0, "to": "level"},
            "writable": {"when": {"mode": "service"}, "reason": "in service only"},
            "sentinels": {-1: "no sensor"},
            "special": {999: "full"},
        },
        {"at": 5, "name": "Scaled", "type": "uint16", "multiply": {"given": "ratio"}, "when": {"mode": "on"}},
        {"at": 10, "name": "Total", "type": "uint32"},
        {"at": 107, "name": "Long", "type": "uint48"},
        {"at": 8, "space": "input", "name": "Measured", "type": "uint16", "access": "r"},
        {"at": 172, "space": "coil", "name": "Pump", "type": "bit"},
        {
            "at": 20,
            "name": "State",
            "type": "uint16",
            "fields": {"stage": {"bits": "0..3"}, "heat": {"bits": "8..15", "type": "signed"}},
        },
    ],
}
NAMED = """const named = (path) => codec.find(map, 'A', path)
const view = (one) => one.views[0]
const said = (path, words, known) =>
  codec.describe(named(path), codec.decode(named(path), view(named(path)), words, known), known)
"""


def ask(expression: str, parts: Json = PARTS, **given: Any) -> Any:
    """What an expression of `codec`, `map`, what NAMED defines, and `given` is, for a map of these parts."""
    register_map, found = diagnose(whole_map(parts))
    assert register_map is not None, found
    assert errors_of(found) == []
    code = f"(codec, {{ data, given }}) => {{ const [map] = codec.open(data)\n{NAMED}return {expression} }}"
    return evaluate(code, {"data": document([register_map]), "given": given})


@pytest.mark.parametrize(
    ("path", "words", "frame"),  # requests of unit 17 as descriptions of Modbus print them, with their CRC
    [
        ("level", [3], "11 06 00 01 00 03 9A 9B"),
        ("long", None, "11 03 00 6B 00 03 76 87"),
        ("measured", None, "11 04 00 08 00 01 B2 98"),
        ("pump", [1], "11 05 00 AC FF 00 4E 8B"),
    ],
)
def test_a_request_has_the_bytes_of_the_standard(path: str, words: list[int] | None, frame: str) -> None:
    found = ask(f"codec.frame(map, named('{path}'), view(named('{path}')), 17, given.words)", words=words)
    assert bytes(found["frame"]).hex(" ").upper() == frame


def test_several_words_are_written_by_function_16() -> None:
    found = ask("codec.frame(map, named('total'), view(named('total')), 1, [10, 258])")
    assert bytes(found["frame"][:-2]).hex(" ") == "01 10 00 0a 00 02 04 00 0a 01 02"


def test_without_a_request_the_reason_is_said() -> None:
    assert ask("codec.frame(map, named('measured'), view(named('measured')), 1, [1])") == {
        "refused": "no function writes this view"
    }
    long = {"protocol": {"functions": [3, 16], "limits": {"read_words": 2}}, "registers": PARTS["registers"][5:6]}
    assert ask("codec.frame(map, named('total'), { ...view(named('total')), words: 3 }, 1)", long) == {
        "refused": "one request has 2 words at most, and these are 3"
    }


@pytest.mark.parametrize(
    ("name", "path", "place", "unit", "words", "frame"),  # as the manuals print them
    [
        ("athena/series-c", "manual_control_output_1_percent", 0, 156, [50], "9C 06 0F A9 00 32 C7 66"),
        ("athena/series-c", "setpoint_eeprom_and_ram", 2, 1, [0x437A, 0], "01 10 1F 42 00 02 04 43 7A 00 00 CE 2B"),
        ("athena/platinum-m300", "stand_by_setpoint", 0, 38, [926], "26 06 00 19 03 9E DF 82"),
    ],
)
def test_a_write_has_the_bytes_of_the_manual(
    name: str, path: str, place: int, unit: int, words: list[int], frame: str
) -> None:
    register_map = compile_map(data_folder("maps") / f"{name}.yaml").map
    assert register_map is not None
    found = evaluate(
        "(codec, { data, path, place, unit, words }) => { const [map] = codec.open(data);"
        "const register = codec.find(map, map.models[0].name, path);"
        "return codec.frame(map, register, register.views[place], unit, words) }",
        {"data": document([register_map]), "path": path, "place": place, "unit": unit, "words": words},
    )
    assert bytes(found["frame"]).hex(" ").upper() == frame


def test_what_decides_is_named_apart_for_reading_and_for_writing() -> None:
    assert ask("codec.needs(named('flow'), view(named('flow')))") == {
        "read": ["places", "mode"],  # decimals and unit
        "write": ["level"],
        "givens": [],
    }
    assert ask("codec.needs(named('scaled'), view(named('scaled')))")["givens"] == ["ratio"]


def test_what_must_be_known_is_named_in_place_of_a_guess() -> None:
    flow = "named('flow'), view(named('flow'))"
    assert ask(f"codec.decode({flow}, [5], codec.surroundings())") == {"meaning": "unknown", "subject": "places"}
    found = ask(f"codec.encode({flow}, '0.5', codec.surroundings({{ places: '1' }}))")
    assert (found["refused"], found["subject"]) == ("unknown", "level")
    assert ask("codec.writable(named('flow'), codec.surroundings())") == {"subject": "mode"}


def test_a_given_has_its_default_and_can_be_stated() -> None:
    said = "said('scaled', [7], codec.surroundings({ mode: '1' }, given.stated, map, 'A')).text"
    assert ask(said, stated={}) == "14"
    assert ask(said, stated={"ratio": "0.5"}) == "3.5"


@pytest.mark.parametrize(("mode", "writable", "unit"), [("2", True, "%"), ("1", False, "l/h")])
def test_what_holds_now_tells_the_unit_and_whether_to_write(mode: str, writable: bool, unit: str) -> None:  # noqa: FBT001 (of a table)
    known = "codec.surroundings({ mode: given.mode, places: '1' })"
    found = ask(f"said('flow', [125], {known})", mode=mode)
    assert (found["text"], found["unit"]) == ("12.5", unit)
    assert ask(f"codec.writable(named('flow'), {known})", mode=mode) is writable


def test_faults_specials_and_members_have_names() -> None:
    said = "said(given.path, given.words, codec.surroundings({ mode: '1', places: '0', level: '2000' }))"
    assert ask(said, path="flow", words=[0xFFFF])["fault"]["label"] == "no sensor"
    assert ask(said, path="flow", words=[999])["special"]["label"] == "full"
    assert ask(said, path="mode", words=[2])["member"]["label"] == "service"


@pytest.mark.parametrize(("text", "words"), [("service", [2]), ("ON", [1]), ("0x2", [2]), ("1", [1])])
def test_a_member_is_taken_by_label_id_and_code(text: str, words: list[int]) -> None:
    assert ask("codec.encode(named('mode'), view(named('mode')), given.text, codec.surroundings())", text=text) == {
        "words": words
    }


def test_parts_of_a_word_are_numbers_of_their_own() -> None:
    parts = "said('state', [0xFE07], codec.surroundings()).fields"
    assert ask(f"{parts}.map((one) => [one.field.id, one.text, one.set])") == [
        ["stage", "7", True],
        ["heat", "-2", True],
    ]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("-1.250", "-1.25"),
        ("1/3", "1/3"),
        ("2/4", "0.5"),
        ("1e-3", "0.001"),
        ("0x1F", "31"),
        (" 7 ", "7"),
        (".5", "0.5"),
        ("9007199254740993", "9007199254740993"),  # 2^53 + 1, which no double holds
        ("1e5000", None),
        ("nan", None),
        ("", None),
        ("1,5", None),
        ("1/0", None),
        ("--1", None),
    ],
)
def test_a_text_is_the_exact_number_or_none(text: str, shown: str | None) -> None:
    assert ask("codec.parse(given.text) && codec.show(codec.parse(given.text))", text=text) == shown


@pytest.mark.parametrize("parts", [{"registers": REGISTERS, "computed": {}}, CONDITIONAL], ids=["terms", "conditions"])
def test_computed_values_are_what_the_vectors_say(parts: Json) -> None:
    terms = {name: {"name": name.title(), "is": term, "unit": "W"} for name, term in TERMS.items()}
    parts = {**parts, "computed": parts["computed"] or terms}
    register_map, _ = diagnose(whole_map(parts))
    assert register_map is not None
    cases = [(one["id"], case) for one in vectors(register_map)["computed"] for case in one["cases"]]
    made = ask(
        "given.cases.map(([id, { words, givens }]) => { const known = codec.surroundings({}, givens ?? {}, map, 'A');"
        "for (const one of words) codec.take(named(one.register), one.words, known);"
        "const found = codec.compute(map.computed.find((one) => one.id === id), known);"
        "return found.value ? codec.show(found.value) : found.meaning })",
        parts,
        cases=cases,
    )
    expected = [case.get("value", case.get("outcome")) for _, case in cases]
    wrong = [
        (case, said)
        for case, said, told in zip(cases, made, expected, strict=True)
        if (said if said != "unknown" else "not_decodable") != told
    ]
    assert wrong == []
    assert len(cases) > 10
