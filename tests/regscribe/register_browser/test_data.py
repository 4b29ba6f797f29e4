"""The page knows of every register what the JSON export says of it, for every model and in every element."""

from typing import Any

import pytest

from regscribe.export.json import plain
from regscribe.map_files import data_folder
from regscribe.model import RegisterMap
from regscribe.pipeline import compile_map
from regscribe.register_browser import document
from regscribe.register_browser.encodings import table
from regscribe.register_browser.exact import exact
from regscribe.register_browser.folding import fold
from regscribe.register_browser.sharing import shared
from regscribe.visible import json_text

from ...conformance.browser_codec import evaluate  # noqa: TID252 (test folders are no packages)

EVERY = """(codec, data) => codec.open(data).map((map) => Object.fromEntries(map.models.map(({ name }) => [name,
  map.registers.filter((entry) => codec.modelsOf(map, entry).includes(name)).flatMap((entry) =>
    codec.elementsOf(map, entry, name).map((index) => codec.registerOf(map, entry, name, index)))])))"""
OF_THE_PAGE = {"anchor", "said", "elements", "models", "python"}
MOST = 300_000


@pytest.fixture(scope="module")
def maps() -> list[RegisterMap]:
    every = (compile_map(path).map for path in sorted(data_folder("maps").rglob("*.yaml")))
    return [one for one in every if one is not None]


def test_opening_gives_every_register_of_every_model_as_the_export_has_it(maps: list[RegisterMap]) -> None:
    found = evaluate(EVERY, document(maps))
    for one, opened in zip(maps, found, strict=True):
        for model in one.models:
            made = {each["path"]: exact(_facts(each)) for each in opened[model.name]}
            assert made == {each.path: exact(plain(each)) for each in model.registers}


def _facts(value: Any) -> Any:
    """What the page adds taken away: its own facts of registers, and the words of conditions."""
    if isinstance(value, list):
        return [_facts(each) for each in value]
    if not isinstance(value, dict):
        return value
    besides = {"words"} if "tests" in value else OF_THE_PAGE if "path" in value else set()
    return {key: _facts(each) for key, each in value.items() if key not in besides}


def test_a_family_takes_less_than_300_kb(maps: list[RegisterMap]) -> None:
    sizes = {one.id: len(json_text(document([one]), compact=True).encode()) for one in maps}
    assert {name for name, size in sizes.items() if size > MOST} == set()


def test_what_models_agree_in_stands_once_and_what_differs_with_its_models(maps: list[RegisterMap]) -> None:
    (series,) = (one for one in maps if one.id == "athena/series-c")
    (found,) = evaluate("(codec, data) => codec.open(data)", document([series]))
    paths = [entry["path"] for entry in found["registers"]]
    assert len(paths) == len(set(paths))
    (controller,) = (entry for entry in found["registers"] if entry["path"] == "controller_type")
    assert "models" not in controller
    segments = {path for path in paths if path.startswith("segments[")}
    assert {path.partition("]")[0] for path in segments} == {"segments[1"}


def test_numbers_that_a_double_would_change_are_both_halves() -> None:
    assert exact({"a": 0.1, "b": 2**53, "c": 7, "d": {"numerator": 1, "denominator": 3, "text": "1/3"}}) == {
        "a": {"n": "1", "d": "10"},
        "b": {"n": "9007199254740992", "d": "1"},
        "c": 7,
        "d": {"n": "1", "d": "3"},
    }


def test_what_says_nothing_is_left_out_and_zero_is_not() -> None:
    facts = {"default": 0, "low": 0, "multiply": 1, "add": 0, "factor": 10, "scale": [], "note": "", "on": False}
    assert exact(facts) == {"default": 0, "low": 0, "factor": 10, "scale": []}


def element(number: int, **more: Any) -> Any:
    return {"path": f"zones[{number}].level", "index": [number], "views": [{"address": 10 + 4 * number}], **more}


def test_an_array_is_its_first_element_and_what_changes() -> None:
    (found,) = fold([element(1, limit=5), element(2, limit=7), element(3, limit=6)])
    assert found["path"] == "zones[1].level"
    assert found["elements"] == {
        "index": [[1], [2], [3]],
        "vary": {
            "path": {"as": "zones[{0}].level"},
            "views/0/address": {"from": 14, "step": 4},
            "limit": {"each": [5, 7, 6]},
        },
    }


def test_an_element_with_another_shape_stands_for_itself() -> None:
    assert len(fold([element(1), element(2), element(3, danger="hot")])) == 2


def test_what_occurs_twice_stands_once() -> None:
    long = {"tests": [{"register": "input_type", "codes": [1, 2, 3]}]}
    found = shared({"a": [long, long], "b": {"c": long}})
    assert found["a"][0] == found["a"][1] == found["b"]["c"]
    assert set(found["a"][0]) == {"$"}


def test_an_encoding_is_a_table_of_its_letters() -> None:
    found = table("cp1251")
    assert (found["one"][0xC6], found["one"][0x98]) == ("Ж", "\ufffd")  # 0x98 is the one byte that cp1251 lacks
    assert table("gbk")["two"]["d6"][0xD0] == "中"
