"""What exporters say of every case that compiles: JSON under its schema, CSV that can be read again."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from regscribe.draft import Outcome
from regscribe.draft.text import text_of
from regscribe.export.csv import csv_text
from regscribe.export.json import json_text
from regscribe.importers import own_csv
from regscribe.model import RegisterMap

from .matrix import TRIALS, compiled, register_keys, restates
from .matrix_maps import Seed, seeds, whole
from .matrix_watch import by_docs
from .suite import Case, Json, cases, diagnose, whole_map

ROOT = Path(__file__).parents[2]
SOUND = [case for case in cases() if not case.refused and not case.place]
SCHEMA = jsonschema.Draft202012Validator(json.loads((ROOT / "schema" / "export.schema.json").read_text("utf-8")))

SEED = {
    "format": 1,
    "map": {"id": "test/case", "title": "Case", "maker": "Test", "class_prefix": "Case"},
    "manual": {"title": "Manual", "number": "1"},
    "protocol": {"functions": [1, 2, 3, 4, 5, 6, 7, 15, 16, 20, 21, 24, 43]},
}
CALLED = frozenset({"id", "path", "name", "group", "array", "index", "section", "page"})


@pytest.mark.parametrize("case", SOUND, ids=repr)
def test_the_json_of_a_case_is_valid_under_the_schema(case: Case) -> None:
    register_map, found = diagnose(whole_map(case.map))
    assert register_map is not None, found
    SCHEMA.validate(json.loads(json_text([register_map])))


@pytest.mark.parametrize("case", SOUND, ids=repr)
def test_a_row_of_the_csv_is_read_as_it_was_written_or_what_is_left_out_is_told(case: Case) -> None:
    register_map, _ = diagnose(whole_map(case.map))
    assert register_map is not None
    head, *lines = csv_text([register_map]).splitlines()
    (model,) = register_map.models
    for register, line in zip(model.registers, lines, strict=False):
        draft = own_csv.read(f"{head}\n{line}\n".encode(), "table.csv", {})
        (entry,) = draft.entries
        if entry.outcome is Outcome.WHOLE:
            text = text_of(draft, SEED).text
            again, found = diagnose(text)
            assert again is not None, (text, found)
            assert _facts(again) == _facts(replace(register_map, models=(replace(model, registers=(register,)),))), text


def _facts(register_map: RegisterMap) -> Any:
    """What JSON says of the one register, but for what it is called and where it is described."""
    (found,) = json.loads(json_text([register_map]))["maps"][0]["models"][0]["registers"]
    enum, fields = found["enum"], found["fields"]
    found["enum"] = enum and [(one["code"], one["label"]) for one in enum["members"]]
    found["sentinels"] = [{**one, "id": ""} for one in found["sentinels"]]
    found["fields"] = [(one["low"], one["high"], one["label"]) for one in fields]
    return {key: value for key, value in found.items() if key not in CALLED}


WHEREVER = [
    seed for seed in seeds() if (seed.place, seed.space) == ("alone", "holding") and seed.type in {"uint16", "string"}
]
NEEDED = frozenset({"file", "queue", "views", "layout", "byte", "rescales", "rereads"})
"""Keys without which the maps that are tried here are wrong; the cases have them."""
OUTPUTS: dict[str, Callable[[RegisterMap], str]] = {
    "JSON": lambda found: json_text([found]),
    "CSV": lambda found: csv_text([found]),
    "docs": by_docs,
}


@pytest.mark.parametrize("key", [key for key in register_keys() if TRIALS[key]])
def test_every_key_of_a_register_is_in_every_export(key: str) -> None:
    tried = ((seed, value, beside) for value, beside in TRIALS[key] for seed in WHEREVER)
    pairs = (_with_and_without(seed, key, *one) for seed, *one in tried if not restates(seed, key, *one))
    pair = next(filter(None, pairs), ())
    assert pair or key in NEEDED
    assert [name for name, write in OUTPUTS.items() if pair and write(pair[0]) == write(pair[1])] == []


def _with_and_without(seed: Seed, key: str, value: Any, beside: Json) -> tuple[RegisterMap, ...]:
    """A map with and without a key; nothing where a rule refuses one of them."""
    found = [compiled(whole(seed, beside, keys))[0] for keys in ({}, {key: value})]
    return tuple(one for one in found if one) if all(found) else ()
