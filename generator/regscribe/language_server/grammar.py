"""What the schema of the map language allows at a place of a map, found by walking it along the path to there."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from regscribe.schema import inline, schema_json
from regscribe.schema.quick_check import Check, UnknownKeywordError, compile_schema
from regscribe.schema.schemas import exact, resolved
from regscribe.source import Path, Plain, SourceNode

Schema: TypeAlias = Mapping[str, Any]

_RESOLVED: dict[int, tuple[Any, Schema]] = {}
"""Schemas with their references followed, by the identity of the schema, which is kept so that no other takes it."""


def parts(schema: Any, value: Plain) -> list[Schema]:  # noqa: ANN401  JSON: true and false are schemas
    """The schema and those in it that count for a value: references followed, conditions decided."""
    if not isinstance(schema, dict):
        return []
    whole = _followed(schema)
    found = [whole]
    for one in (*whole.get("allOf", ()), *whole.get("anyOf", ())):
        found += parts(one, value)
    if "if" in whole:
        found += parts(whole.get("then" if _holds(whole["if"], value) else "else"), value)
    return found


def _followed(schema: Schema) -> Schema:
    if id(schema) not in _RESOLVED:
        _RESOLVED[id(schema)] = schema, resolved(schema, schema_json()["$defs"])
    return _RESOLVED[id(schema)][1]


_CHECKS: dict[int, tuple[Any, Check]] = {}


def _holds(schema: Any, value: Plain) -> bool:  # noqa: ANN401  JSON
    if not isinstance(schema, dict):
        return bool(schema)
    if id(schema) not in _CHECKS:
        _CHECKS[id(schema)] = schema, compile_schema({**schema, "$defs": schema_json()["$defs"]})
    try:
        return _CHECKS[id(schema)][1](value)
    except UnknownKeywordError:
        return False


def under(schemas: Sequence[Schema], step: str | int) -> list[Any]:
    """The schemas of the value under a key or an index."""
    found = []
    for schema in schemas:
        if isinstance(step, int):
            first = schema.get("prefixItems", ())
            found += [first[step]] if step < len(first) else [schema["items"]] if "items" in schema else []
        elif step in schema.get("properties", {}):
            found.append(schema["properties"][step])
        elif patterns := _matching(schema, step):
            found += patterns
        elif isinstance(schema.get("additionalProperties"), dict):
            found.append(schema["additionalProperties"])
    return found


def _matching(schema: Schema, key: str) -> list[Any]:
    return [one for pattern, one in schema.get("patternProperties", {}).items() if re.search(exact(pattern), key)]


def step_into(schemas: Sequence[Schema], step: str | int, value: Plain) -> list[Schema]:
    """The schemas that count for the value under a key or an index."""
    return [part for schema in under(schemas, step) for part in parts(schema, value)]


def at(root: SourceNode, path: Path, value: Plain = ...) -> list[Schema]:
    """The schemas that count at a path, for the value there or for another one in its place."""
    node: SourceNode | None = root
    schemas = parts(schema_json(), root.value if path or value is ... else value)
    for done, step in enumerate(path, start=1):
        node = node.child(step) if node else None
        own = node.value if node else None
        schemas = step_into(schemas, step, own if done < len(path) or value is ... else value)
    return schemas


def roots_at(root: SourceNode, path: Path) -> list[Any]:
    """The schemas of the value at a path, before it is decided which of their conditions hold."""
    return under(at(root, path[:-1]), path[-1]) if path else [schema_json()]


def keys(schemas: Sequence[Schema]) -> dict[str, Schema]:
    """All keys that schemas may know in some case, with what they say of them."""
    found: dict[str, Schema] = {}
    for schema in schemas:
        found |= {key: one for key, one in _possible(schema) if isinstance(one, dict) and key not in found}
    return {key: _followed(one) for key, one in found.items()}


def _possible(schema: Any) -> Iterator[tuple[str, Any]]:  # noqa: ANN401  JSON
    if not isinstance(schema, dict):
        return
    whole = _followed(schema)
    for key, one in whole.get("properties", {}).items():
        if one and "not" not in one:
            yield key, one
    for word in ("then", "else"):
        yield from _possible(whole.get(word))
    for one in whole.get("allOf", ()):
        yield from _possible(one)


def missing_keys(roots: Sequence[Any], value: Mapping[str, Plain]) -> dict[str, Schema]:
    """The keys that may be added to a mapping as it stands: none that would not go with those in it."""
    possible = keys([part for root in roots for part in parts(root, value)] or list(roots))
    before = _misfits(roots, value)
    free = {key: one for key, one in possible.items() if key not in value}
    return {key: one for key, one in free.items() if _misfits(roots, {**value, key: _sample(one)}) <= before}


def _sample(schema: Schema) -> Plain:
    values = schema.get("x-examples") or schema.get("enum") or [None]
    return values[0]


def _misfits(roots: Sequence[Any], value: Mapping[str, Plain]) -> int:
    """How many keys of a mapping are unknown to its schemas, or forbidden beside others."""
    schemas = [part for root in roots for part in parts(root, dict(value))]
    return sum(not _fits(schemas, key) for key in value)


def _fits(schemas: Sequence[Schema], key: str) -> bool:
    for schema in schemas:
        own = schema.get("properties", {}).get(key, True)
        if own is False or (isinstance(own, dict) and "not" in own):
            return False
        known = key in schema.get("properties", {}) or _matching(schema, key)
        if schema.get("additionalProperties") is False and not known:
            return False
    return True


def required(schemas: Sequence[Schema]) -> list[str]:
    """The keys that a mapping needs."""
    return [key for schema in schemas for key in schema.get("required", ())]


def words(schemas: Sequence[Schema]) -> dict[str, str]:
    """The values that schemas list, as a map writes them, with what they say of the value."""
    found: dict[str, str] = {}
    for schema in schemas:
        every = [*schema.get("enum", ()), *([schema["const"]] if "const" in schema else [])]
        if "boolean" in _types(schema):
            every += [True, False]
        found |= {inline(one): str(schema.get("description", "")) for one in every}
    return found


def _types(schema: Schema) -> list[str]:
    types = schema.get("type", [])
    return [types] if isinstance(types, str) else list(types)


def kind_named(schemas: Sequence[Schema]) -> str:
    """What a text at a place names, by `x-names`: `register`, `enum` and so on; empty where it names nothing."""
    return next((one for schema in schemas if isinstance(one := schema.get("x-names"), str)), "")


def kind_of_keys(schemas: Sequence[Schema]) -> str:
    """What the free keys of a mapping name; empty where they name nothing."""
    return next((one for schema in schemas if (one := schema.get("x-key", {}).get("x-names", ""))), "")


def described(schemas: Sequence[Schema], key: str) -> list[Schema]:
    """What schemas say of a key, their references followed."""
    return [_followed(one) for one in under(schemas, key) if isinstance(one, dict)]


def about(schemas: Sequence[Schema]) -> str:
    """What the schema says of a key or a value, in Markdown: the outermost that says something."""
    said = next((schema for schema in schemas if schema.get("description")), None)
    if said is None:
        return ""
    examples = [f"`{inline(one)}`" for one in said.get("x-examples", ())[:3]]
    shown = f"For example {', '.join(examples)}" if examples else ""
    return "\n\n".join(filter(None, (f"**{said.get('title', '')}**", str(said["description"]), shown)))
