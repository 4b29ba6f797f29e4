"""The JSON export keeps its schema and loses nothing."""

import json
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from regscribe.export.json import json_text, number
from regscribe.model import RegisterMap

SCHEMA = Path(__file__).parents[3] / "schema" / "export.schema.json"


@pytest.fixture
def validator() -> jsonschema.Draft202012Validator:
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def document(*maps: RegisterMap) -> Any:
    return json.loads(json_text(maps))


def test_the_document_is_valid_under_the_schema(
    device: RegisterMap, validator: jsonschema.Draft202012Validator
) -> None:
    validator.validate(document(device))


def test_the_schema_refuses_a_key_it_does_not_know(
    device: RegisterMap, validator: jsonschema.Draft202012Validator
) -> None:
    changed = document(device)
    changed["maps"][0]["models"][0]["registers"][0]["colour"] = "red"
    assert not validator.is_valid(changed)


def test_errata_examples_and_reserved_addresses_are_there(device: RegisterMap) -> None:
    found = document(device)["maps"][0]
    assert found["errata"][0]["why"] == "the table on page 3 agrees"
    assert [example["type"] for example in found["examples"]] == ["value", "frame", "timing"]
    assert found["examples"][0]["stored"] == 120.5
    assert found["examples"][1]["frame"] == "9C 06"
    assert found["reserved"] == [["holding", 77, 79]]


def test_arrays_are_expanded_in_registers_and_folded_in_members(device: RegisterMap) -> None:
    model = document(device)["maps"][0]["models"][0]
    assert [item["path"] for item in model["registers"]][-2:] == ["segments[1].ramp_time", "segments[2].ramp_time"]
    assert model["members"][-1]["members"] == ["segments[1].ramp_time"]
    assert model["members"][0] == "input_type"


def test_the_place_of_the_file_is_not_exported(device: RegisterMap) -> None:
    assert json_text([device]) == json_text([replace(device, source="/somewhere/else.yaml")])
    assert "elsewhere" not in json_text([device])


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        ("7", 7),
        ("-0.1", -0.1),
        ("4553.6", 4553.6),
        ("0.00001", 0.00001),
        ("1/3", {"numerator": 1, "denominator": 3, "text": "1/3"}),
        (
            "0.12345678901234567890125",
            {"numerator": 98765431209876543121, "denominator": 8 * 10**20, "text": "0.12345678901234567890125"},
        ),
    ],
)
def test_numbers_are_exact(value: str, expected: object) -> None:
    assert number(Fraction(value)) == expected


def test_a_number_beyond_a_double_is_exact_all_the_same() -> None:
    huge = Fraction(10**400 * 2 + 1, 2)
    assert number(huge)["numerator"] == 10**400 * 2 + 1
