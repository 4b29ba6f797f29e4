"""The JSON Schemas of the files that people write: where they lie, and the validators, each built once."""

import json
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any

from regscribe.map_files import data_folder

if TYPE_CHECKING:
    from jsonschema.protocols import Validator

MAP = "map"
"""The language of maps."""
_FILES = {MAP: "map.language.json"}
"""Files with another name than `<language>.schema.json`: the schema of maps for editors is made of this one."""

_BRANCHES = frozenset({"allOf", "then", "else"})


@cache
def schema_json(language: str = MAP) -> dict[str, Any]:
    """Return the JSON Schema (2020-12) of a language; the caller must not change it."""
    file = data_folder("schema") / _FILES.get(language, f"{language}.schema.json")
    schema: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    return schema


@cache
def validator(language: str = MAP) -> "Validator":
    """Return the validator of a language, built at the first call."""
    from jsonschema import Draft202012Validator, ValidationError  # noqa: PLC0415 - 60 ms that few documents need
    from jsonschema.validators import extend  # noqa: PLC0415 - as above

    def unique_items(_: "Validator", unique: Any, instance: Any, __: Any) -> Iterator[ValidationError]:  # noqa: ANN401  JSON
        """Find an element given twice in linear time; jsonschema compares each with each where types differ."""
        if unique and isinstance(instance, list) and given_twice(instance):
            yield ValidationError("an element is given twice")

    schema = schema_json(language)
    checks: type[Validator] = extend(  # type: ignore[no-untyped-call]  # types-jsonschema leaves it untyped
        Draft202012Validator, {"uniqueItems": unique_items}
    )
    return checks(_inline(schema, schema.get("$defs", {}), {}))


@cache
def places(language: str) -> dict[str, list[str]]:
    """Name what has each key of a language, by the key: the titles of its schemas."""
    found: dict[str, dict[str, None]] = {}
    for title, key in _keys(schema_json(language), ""):
        found.setdefault(key, {})[title] = None
    return {key: list(titles) for key, titles in found.items()}


def _keys(node: Any, around: str) -> Iterator[tuple[str, str]]:  # noqa: ANN401  JSON is any
    """The keys of a schema and those within it, each with the title of the nearest schema that has one."""
    if isinstance(node, dict):
        title = node["title"] if isinstance(node.get("title"), str) else around
        properties = node.get("properties")
        yield from ((title, key) for key in (properties if isinstance(properties, dict) else ()))
        for value in node.values():
            yield from _keys(value, title)
    elif isinstance(node, list):
        for value in node:
            yield from _keys(value, around)


def _inline(node: Any, definitions: Mapping[str, Any], done: dict[tuple[int, str], Any], title: str = "") -> Any:  # noqa: ANN401  JSON is any
    """Put definitions in place of references: no look-up at run time, and a key's own title stands at its errors.

    Branches (`then` and the like) without a title take that of the schema around them. The result is a graph with
    cycles, which validation walks only as deep as the document is.
    """
    if isinstance(node, list):
        return [_inline(element, definitions, done, title) for element in node]
    if not isinstance(node, dict):
        return node
    if (id(node), title) not in done:
        done[id(node), title] = copy = {}
        merged = ({"title": title} if title else {}) | resolved(node, definitions)
        for key, value in merged.items():
            is_pattern = key == "pattern" and isinstance(value, str)
            around = merged.get("title", "") if key in _BRANCHES else ""
            copy[exact(key)] = exact(value) if is_pattern else _inline(value, definitions, done, around)
    return done[id(node), title]


def resolved(node: Mapping[str, Any], definitions: Mapping[str, Any]) -> dict[str, Any]:
    """Lay a schema's own keywords over those of the definition that it refers to, if it does."""
    own = {key: value for key, value in node.items() if key not in {"$ref", "$defs"}}
    if "$ref" not in node:
        return own
    target: Any = {"$defs": definitions}
    for step in node["$ref"].removeprefix("#/").split("/"):
        target = target[step]
    return resolved(target, definitions) | own


def exact(pattern: str) -> str:
    r"""Let a pattern's `$` mean the end, as in ECMA 262; in Python it also stands before a last line feed."""
    return f"{pattern[:-1]}\\Z" if pattern.startswith("^") and pattern.endswith("$") else pattern


def given_twice(elements: Sequence[Any]) -> bool:
    """Whether a list has an element twice; lists and mappings in it are not compared."""
    scalars = [(type(element), element) for element in elements if not isinstance(element, list | dict)]
    return len(set(scalars)) < len(scalars)
