"""Addresses in vectors: as they stand in a request, with the file, the queue, the page or the unit id beside them."""

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from regscribe.emit import python
from regscribe.emit.vectors import document
from regscribe.testing import DriverUnderTest, Vectors

from .judges import bench_of
from .suite import Built, Json, build, diagnose, module_of, whole_map

ROOT = Path(__file__).parents[2]
SCHEMA = jsonschema.Draft202012Validator(json.loads((ROOT / "schema" / "vectors.schema.json").read_text("utf-8")))

REGISTERS = {
    "holding": {"at": 7, "name": "Level", "write_at": 9},
    "file": {"at": 7, "name": "Level", "space": "file", "file": 4},
    "queue": {"at": 31, "name": "Level", "space": "queue", "queue": 1246, "access": "r"},
    "identification": {
        "at": 128,
        "name": "Level",
        "space": "identification",
        "access": "r",
        "type": "string",
        "length": 5,
    },
    "enron": {"at": 5001, "name": "Level", "space": "enron", "type": "uint32"},
}
PLACES: Json = {
    "holding": {"addresses": {"base": 7, "write": 9}},
    "file": {"addresses": {"base": 7}, "files": {"base": 4}},
    "queue": {"addresses": {"base": 31}, "queues": {"base": 1246}},
    "identification": {"addresses": {"base": 128}},
    "enron": {"addresses": {"base": 5001}},
}
PAGED = """\
format: 1
map: {id: test/case, title: Case, maker: Test, class_prefix: Case}
manual: {title: Manual, number: "1"}
models: {A: {}}
groups:
  - {id: own, name: Own, source: "1", registers: [{at: 10, name: Bank, access: rw, enum: {0: none, 1: one}}]}
  - {id: meter, name: Meter, source: "2", unit_id: 3, registers: [{at: 10, name: Power, access: r}]}
  - {id: one, name: One, source: "3", page: {bank: one}, registers: [{at: 11, name: Level, access: r}]}
"""


def places_of(found: Json) -> dict[str, Json]:
    """What vectors say of where each register is."""
    several = [place for entry in found["sets"] for place in entry["registers"]]
    return {one["path"]: {key: fact for key, fact in one.items() if key not in {"path", "models"}} for one in several}


@pytest.mark.parametrize("space", REGISTERS)
def test_an_address_stands_as_in_a_request(space: str) -> None:
    built = build(whole_map({"registers": [REGISTERS[space]]}))
    found = document(built.map)
    SCHEMA.validate(json.loads(json.dumps(found)))
    assert places_of(found)["level"] == PLACES[space]
    bench_of(built).check_registers()


def paged() -> tuple[Any, Json]:
    """The driver class of a map with a page and another unit, and its vectors."""
    register_map, found = diagnose(PAGED)
    assert register_map is not None, found
    ((_, code),) = python.render(register_map).items()
    return module_of(code).CaseA, document(register_map)


def test_a_page_and_another_unit_stand_beside_the_address() -> None:
    driver, found = paged()
    SCHEMA.validate(json.loads(json.dumps(found)))
    places = places_of(found)
    assert places["bank"]["addresses"] == {"base": 10}
    assert {"unit_id": 3, "addresses": {"base": 10}}.items() <= places["power"].items()
    assert "unit_id" not in places["level"]
    assert (places["level"]["addresses"], "page" in places["level"]) == ({"base": 11}, True)
    under_test(driver, found).check_registers()


def under_test(driver: Any, found: Json) -> DriverUnderTest:
    return DriverUnderTest(driver, Vectors("test/case", ("A",), tuple(found["sets"])))


@pytest.mark.parametrize("change", [{"page": 7}, {"unit_id": 4}, {"addresses": {"base": 9}}])
def test_a_place_that_is_not_the_drivers_fails(change: Json) -> None:
    driver, found = paged()
    place = next(one for entry in found["sets"] for one in entry["registers"] if one["path"] == "power")
    place |= change
    with pytest.raises(AssertionError, match="power: "):
        under_test(driver, found).check_registers()


def test_a_file_that_is_not_the_drivers_fails() -> None:
    built: Built = build(whole_map({"registers": [REGISTERS["file"]]}))
    found = document(built.map)
    found["sets"][0]["registers"][0]["files"] = {"base": 5}
    with pytest.raises(AssertionError, match="'file': 5"):
        under_test(built.module.CaseA, found).check_registers()
