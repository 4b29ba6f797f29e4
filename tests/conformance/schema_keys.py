"""Which object of the schema each mapping of a map is, so that every key of every object can be put on trial."""

import json
import re
from collections.abc import Iterator
from functools import cache, reduce
from operator import getitem
from pathlib import Path
from typing import Any, NamedTuple

from jsonschema import Draft202012Validator

from .suite import Json

SCHEMA: Json = json.loads((Path(__file__).parents[2] / "schema" / "map.language.json").read_text("utf-8"))
ROOT = "map file"
"""What the object around everything is called here."""
SAME = frozenset({"register", "each", "set_each", "variant", "view"})
"""Objects whose keys `matrix.py` and `matrix_views.py` try."""


class Found(NamedTuple):
    """A key of an object of the schema, where it stands in a map, and what the schema says of its value."""

    object: str
    key: str
    place: tuple[Any, ...]
    schema: Json

    @property
    def name(self) -> str:
        """Object and key in one word."""
        return f"{self.object}.{self.key}"


def keys_of_schema() -> list[str]:
    """Every key of every object."""
    objects = {ROOT: SCHEMA, **SCHEMA["$defs"]}
    return [f"{name}.{key}" for name, node in objects.items() for key in node.get("properties", ())]


def keys_in(document: Any) -> Iterator[Found]:
    """Every key in a map of which the schema knows what it is."""
    yield from _walk(SCHEMA, document, ROOT, ())


def _walk(node: Json, value: Any, name: str, place: tuple[Any, ...]) -> Iterator[Found]:
    for form, called in _forms(node, value, name):
        if isinstance(value, dict):
            yield from _members(form, value, called, place)
        if isinstance(value, list) and isinstance(form.get("items"), dict):
            for number, each in enumerate(value):
                yield from _walk(form["items"], each, called, (*place, number))


def _forms(node: Json, value: Any, name: str) -> Iterator[tuple[Json, str]]:
    """A node, what it refers to, and the form that the value has, each with the name of its object."""
    yield node, name
    if "$ref" in node:
        _, _, called, *inner = node["$ref"].split("/")
        yield from _forms(reduce(getitem, inner, SCHEMA["$defs"][called]), value, called)
    if "if" in node:
        yield from _forms(node.get("then" if _fits(node["if"], value) else "else", {}), value, name)


def _members(node: Json, value: Json, name: str, place: tuple[Any, ...]) -> Iterator[Found]:
    for key, each in value.items():
        if key in node.get("properties", {}):
            yield Found(name, key, (*place, key), node["properties"][key])
            yield from _walk(node["properties"][key], each, name, (*place, key))
        elif isinstance(node.get("additionalProperties"), dict):
            yield from _walk(node["additionalProperties"], each, name, (*place, key))
        for pattern, inner in node.get("patternProperties", {}).items():
            if re.search(pattern, str(key)):
                yield from _walk(inner, each, name, (*place, key))


def _fits(node: Json, value: Any) -> bool:
    return _validator(json.dumps(node, sort_keys=True)).is_valid(value)


@cache
def _validator(node: str) -> Draft202012Validator:
    return Draft202012Validator({**json.loads(node), "$defs": SCHEMA["$defs"]})
