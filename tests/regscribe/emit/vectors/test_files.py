import ast
import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from regscribe.emit.vectors import dumps, render
from regscribe.model import RegisterMap

ROOT = Path(__file__).parents[4]
SCHEMA = json.loads((ROOT / "schema" / "vectors.schema.json").read_text(encoding="utf-8"))
COMMITTED = sorted((ROOT / "generated" / "vectors").glob("*/*.json"))
MOST_BYTES = 2_000_000
Compiled = Callable[..., RegisterMap]

ALL_KINDS = """
- {at: 1, id: level, name: Level, range: 0..9, special: {20: {label: fast, means: 0.5}}}
- {at: 2, id: kind, name: Kind, enum: {0: high, 1: low}}
- {at: 3, id: pv, name: PV, access: r, sentinels: {-32768: low}}
- {at: 4, id: lamps, name: Lamps, type: uint16, flags: {0: red}}
- {at: 5, id: serial, name: Serial, type: string, length: 2}
- {at: 9, id: output, name: Output, writable: {when: {kind: low}, reason: only then}}
- {at: 10, id: energy, name: Energy, type: float32, word_order: {register: kind, codes: {0: big, 1: little}}}
"""
EXAMPLES = """
examples:
  - {source: '2', register: level, words: [3], value: 3}
  - {source: '2', register: pv, words: [-32768], fault: low}
  - {source: '3', frame: 01 06 00 01 00 03, crc: false, unit: 1, function: 6, address: 1, writes: {level: 3}}
"""


def faults(document: Any) -> list[str]:
    return [
        f"{one.json_path}: {one.message[:200]}" for one in jsonschema.Draft202012Validator(SCHEMA).iter_errors(document)
    ]


@pytest.mark.parametrize("path", COMMITTED, ids=[path.stem for path in COMMITTED])
def test_the_vectors_of_every_map_keep_to_the_schema_and_stay_small(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert faults(json.loads(text)) == []
    assert len(text) < MOST_BYTES


def test_every_kind_of_register_keeps_to_the_schema(compiled: Compiled) -> None:
    files = render(compiled(ALL_KINDS, after=EXAMPLES))
    assert faults(json.loads(files["vectors/example/controller.json"])) == []


def test_the_schema_documents_every_key() -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    described = [(path, node) for path, node in _nodes(SCHEMA, "") if "properties" in node or "type" in node]
    assert len(described) > 100
    assert [path for path, node in described if "items" in node and "description" not in node] == []
    for path, node in described:
        for key, value in node.get("properties", {}).items():
            assert "$ref" in value or {"title", "description"} <= set(value), f"{path}/{key}"


def _nodes(node: Any, path: str) -> Iterator[tuple[str, dict[str, Any]]]:
    if isinstance(node, dict):
        yield path, node
        for key, value in node.items():
            yield from _nodes(value, f"{path}/{key}")


def test_worked_examples_say_what_they_assume(compiled: Compiled) -> None:
    text = render(compiled(ALL_KINDS, after=EXAMPLES))["vectors/example/controller.json"]
    value, fault, frame = json.loads(text)["examples"]
    assert (value["value"], value["encodes"], fault["fault"]) == ("3", True, "LOW")
    assert (frame["frame"], frame["writes"], frame["encodes"]) == ("01 06 00 01 00 03", {"level": "3"}, True)


def test_a_vector_stands_on_one_line_and_the_text_reads_back() -> None:
    value = {"decode": [{"words": [1], "value": "1", "note": "x" * 60}] * 3, "empty": []}
    text = dumps(value)
    assert json.loads(text) == value
    assert sum("words" in line for line in text.splitlines()) == 3


def test_the_text_does_not_depend_on_the_hash_seed() -> None:
    program = (
        "import hashlib, sys; from pathlib import Path; from regscribe.pipeline import compile_map\n"
        "from regscribe.emit.vectors import render\n"
        "files = render(compile_map(Path(sys.argv[1])).map)\n"
        "print(hashlib.sha256(repr(sorted(files.items())).encode()).hexdigest())"
    )
    path = str(ROOT / "maps" / "fdc" / "series-100.yaml")
    runs = {
        subprocess.run(  # noqa: S603 (our own interpreter and program)
            [sys.executable, "-c", program, path],
            env={"PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
            text=True,
            timeout=60,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(runs) == 1


def test_the_test_module_is_valid_python_for_any_title(compiled: Compiled) -> None:
    found = compiled("- {at: 1, id: level, name: Level}")
    text = render(found)["tests/example/test_example__controller.py"]
    assert isinstance(ast.parse(text), ast.Module)
    assert "MODULE.ExampleA1," in text
    assert "agreement" not in text


def test_a_register_with_several_views_adds_the_test_that_they_agree(compiled: Compiled) -> None:
    tables = "views: {two: {base: {type: int16}, x10: {offset: 100, type: int16, factor: 10}}}\n"
    text = render(compiled("- {at: 1, id: level, name: Level, views: two}", tables=tables))
    assert "hold.agreement" in text["tests/example/test_example__controller.py"]
