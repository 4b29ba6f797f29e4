"""Vectors of numbers that follow from several registers: what the reference works out, and whether drivers agree."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from regscribe.emit.vectors import document, render
from regscribe.testing import DriverUnderTest, Vectors

from .judges import bench_of
from .suite import Built, Json, build, whole_map
from .test_computed import CONDITIONAL, TERMS, with_terms

ROOT = Path(__file__).parents[2]
SCHEMA = jsonschema.Draft202012Validator(json.loads((ROOT / "schema" / "vectors.schema.json").read_text("utf-8")))

POWER: Json = {"at": 1, "name": "Power", "type": "int16", "unit": "W"}
OTHER: Json = {"at": 2, "name": "Other", "type": "int16", "sentinels": {-32768: "open"}}


def computing(term: Any, *registers: Json, **more: Any) -> str:
    total = {"name": "Total", "is": term, **more.pop("total", {})}
    return whole_map({"registers": [POWER, OTHER, *registers], "computed": {"total": total}, **more})


SUM: Json = {"sum": ["power", "other"]}
MODE: Json = {"at": 5, "name": "Mode", "type": "uint16", "enum": {0: "off", 1: "on", 5: "idle"}}
MAPS = {
    "terms": with_terms(**TERMS),
    "condition and limits": whole_map(CONDITIONAL),
    "decimals in a register": computing(
        {"sum": ["power", "level"]},
        {"at": 3, "name": "Level", "type": "int16", "decimals": "by_places"},
        {"at": 4, "name": "Places", "type": "uint16", "range": "0..3"},
        decimals={"by_places": [{"register": "places"}]},
    ),
    "an order in a register": computing(
        {"product": ["power", "energy"]},
        {
            "at": 10,
            "name": "Energy",
            "type": "float32",
            "word_order": {"register": "order", "codes": {0: "big", 1: "little"}},
        },
        {"at": 4, "name": "Order", "type": "uint16", "enum": {0: "big", 1: "little"}},
    ),
    "a register that exists at times": computing(
        {"sum": ["power", "extra"]}, MODE, {"at": 6, "name": "Extra", "type": "uint16", "when": {"mode": "on"}}
    ),
    "a condition on one that exists at times": computing(
        SUM,
        MODE,
        {"at": 6, "name": "Extra", "type": "uint16", "when": {"mode": "on"}},
        total={"when": {"extra": "1..9"}},
    ),
    "a limit in a register that reports faults": computing("power", total={"valid": {"from": 0, "to": "other"}}),
    "a part of a word": computing(
        [{"when": {"state.run": 1}, "is": "power"}, {"when": {"state.part": "2..3"}, "is": 0}],
        {"at": 7, "name": "State", "type": "uint16", "fields": {"run": {"bit": 0}, "part": {"bits": "4..6"}}},
    ),
    "a given": computing(
        {"product": ["power", {"given": "ratio"}]},
        givens={"ratio": {"type": "number", "range": "1..40", "description": "turns", "reason": "not in it"}},
    ),
    "powers": computing(
        {"product": ["power", {"power": "exponent"}]},
        {"at": 3, "name": "Exponent", "type": "int16"},
    ),
}


@pytest.fixture(params=MAPS)
def built(request: pytest.FixtureRequest) -> Built:
    return build(MAPS[request.param])


def test_the_driver_computes_what_the_reference_does(built: Built) -> None:
    bench_of(built).check_computed()


def test_each_value_is_tried_with_a_number_and_without(built: Built) -> None:
    found = document(built.map)
    SCHEMA.validate(json.loads(json.dumps(found)))
    for one in found["computed"]:
        outcomes = {case.get("outcome", "number") for case in one["cases"]}
        assert "number" in outcomes, one
        assert len({case.get("value", case.get("outcome")) for case in one["cases"]}) > 1, one


def case_of(name: str, computed: str, **words: list[int]) -> Json:
    """The case in which registers hold these words, as the vectors have it."""
    (one,) = (one for one in document(build(MAPS[name]).map)["computed"] if one["id"] == computed)
    return next(
        case
        for case in one["cases"]
        if words.items() <= {held["register"]: held["words"] for held in case["words"]}.items()
    )


def test_numbers_of_the_vectors_are_those_worked_out_by_hand() -> None:
    assert case_of("terms", "total", power_1=[10], power_2=[13])["value"] == "14"  # 1.0 + 13
    assert case_of("terms", "current", power_2=[10], voltage=[13])["value"] == "100/13"  # 10 W / 1.3 V
    assert case_of("terms", "total", power_1=[0x8000])["outcome"] == "not_decodable"
    assert case_of("terms", "scaled", ratio=[0])["outcome"] == "not_decodable"
    assert case_of("condition and limits", "net", mode=[0])["outcome"] == "not_present"
    assert (
        case_of("condition and limits", "net", mode=[1], taken=[10], given_back=[0x7FFF])["outcome"] == "out_of_range"
    )
    assert case_of("a register that exists at times", "total", mode=[0])["outcome"] == "not_decodable"
    assert case_of("a condition on one that exists at times", "total", mode=[0])["outcome"] == "not_present"


@pytest.mark.parametrize("change", [{"value": "15"}, {"outcome": "not_present"}])
def test_a_vector_that_does_not_hold_fails(change: Json) -> None:
    built = build(MAPS["terms"])
    found = document(built.map)
    case = found["computed"][0]["cases"][0]
    del case["value"]
    case |= change
    vectors = Vectors("test/case", tuple(found["models"]), tuple(found["sets"]), computed=tuple(found["computed"]))
    with pytest.raises(AssertionError, match=r"total with .*expected"):
        DriverUnderTest(built.module.CaseA, vectors).check_computed()


def test_a_computed_value_that_no_vector_knows_is_noticed() -> None:
    built = build(MAPS["terms"])
    with pytest.raises(AssertionError, match="computed values"):
        DriverUnderTest(built.module.CaseA, Vectors("test/case", ("A",), ())).check_computed()


def test_only_the_generated_tests_of_maps_with_computed_values_ask_for_them() -> None:
    texts = [
        render(build(text).map)["tests/test/test_test__case.py"]
        for text in (MAPS["terms"], whole_map({"registers": [POWER]}))
    ]
    assert ["driver.check_computed()" in text for text in texts] == [True, False]
