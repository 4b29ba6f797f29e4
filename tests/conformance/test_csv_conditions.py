"""The table says under which conditions commands, their steps and computed values are there, and what is valid."""

import csv
import io
import json
from typing import Any

from regscribe.export.csv import csv_text

from .suite import diagnose, whole_map

PARTS: dict[str, Any] = {
    "registers": [
        {"at": 0, "name": "Card", "type": "uint16"},
        {"at": 1, "name": "Power", "type": "uint16"},
    ],
    "commands": {
        "go": {
            "name": "Go",
            "when": {"card": 1},
            "steps": [{"at": 5, "words": [1]}, {"at": 6, "words": [2], "when": {"power": 10}}],
        },
        "halt": {"name": "Halt", "steps": [{"at": 7, "words": [1]}]},
    },
    "computed": {
        "double": {"name": "Double", "is": {"product": [2, "power"]}, "valid": "0..100", "when": {"card": 1}},
        "same": {
            "name": "Same",
            "is": {"sum": ["power"]},
            "valid": [{"when": {"card": 1}, "is": "0..10"}, {"is": "0..20"}],
        },
    },
}


def rows() -> dict[str, dict[str, str]]:
    register_map, found = diagnose(whole_map(PARTS))
    assert register_map is not None, found
    return {row["id"]: row for row in csv.DictReader(io.StringIO(csv_text([register_map])))}


def test_a_command_exists_under_its_condition_and_says_that_of_its_steps() -> None:
    found = rows()
    assert found["go"]["exists"] == "card is 1"
    assert json.loads(found["go"]["more"]) == {"steps": "step 2 while power is 10"}
    assert (found["halt"]["exists"], found["halt"]["more"]) == ("", "{}")


def test_a_computed_value_exists_under_its_condition_and_has_the_limits_of_valid() -> None:
    double, same = (rows()[name] for name in ("double", "same"))
    assert (double["exists"], double["minimum"], double["maximum"]) == ("card is 1", "0", "100")
    assert json.loads(double["more"]) == {"valid": "0..100"}
    assert (same["exists"], same["minimum"], same["maximum"]) == (
        "",
        "card is 1: 0; otherwise: 0",
        "card is 1: 10; otherwise: 20",
    )
    assert json.loads(same["more"]) == {"valid": "card is 1: 0 to 10; otherwise: 0 to 20"}
