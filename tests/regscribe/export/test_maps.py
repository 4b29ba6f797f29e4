"""The exports of the maps of this repository."""

import csv
import io
import json
from pathlib import Path

import jsonschema
import pytest

from regscribe.export.csv import COLUMNS, csv_text
from regscribe.export.json import json_text
from regscribe.model import RegisterMap
from regscribe.simulate.map_cache import find_map

ROOT = Path(__file__).parents[3]
MAPS = [path for path in sorted((ROOT / "maps").glob("*/*.yaml")) if not path.name.endswith(".library.yaml")]


@pytest.fixture(scope="module", params=MAPS, ids=lambda path: path.stem)
def real(request: pytest.FixtureRequest) -> RegisterMap:
    return find_map(request.param)


def test_the_json_of_a_real_map_is_valid_under_the_schema(real: RegisterMap) -> None:
    schema = json.loads((ROOT / "schema" / "export.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(schema).validate(json.loads(json_text([real])))


def test_the_csv_of_a_real_map_has_a_row_for_each_value_and_command(real: RegisterMap) -> None:
    rows = list(csv.reader(io.StringIO(csv_text([real]), newline=""), strict=True))
    assert {len(row) for row in rows} == {len(COLUMNS)}
    assert len(rows) == 1 + sum(len(model.registers) + len(model.commands) for model in real.models)
    assert len({(row[1], row[2], row[10] == "command") for row in rows[1:]}) == len(rows) - 1
