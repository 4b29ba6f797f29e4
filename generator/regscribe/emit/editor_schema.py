"""The JSON Schema of maps that editors read, `schema/map.schema.json`: `python -m regscribe.emit.editor_schema`.

It judges as the language itself does (`schema/map.language.json`) and leaves out what language servers for YAML make
wrong proposals of: defaults, which they would write into maps as facts of the device, and annotations beside `$ref`,
for which they lose the type. A key that the map chooses becomes a snippet.
"""

import json
from collections.abc import Mapping
from typing import Any, TypeAlias

from regscribe.schema import schema_json
from regscribe.schema.schemas import resolved

Schema: TypeAlias = Mapping[str, Any]

_NAMED = ("properties", "patternProperties", "$defs")
"""Keywords whose value is a mapping from names to schemas."""
_BESIDE_REFERENCES = frozenset({"$ref", "title", "description"})
"""What may stand beside `$ref`: language servers read anything else there as a second schema."""
_FORMS = frozenset({"type", "$ref", "enum", "const", "allOf", "if"})
"""Keywords that say which values a key has; one without them says something about a key that is known elsewhere."""
_CONTENTS = frozenset(
    {"properties", "patternProperties", "additionalProperties", "required", "dependentRequired", "minProperties"}
    | {"items", "prefixItems", "minItems", "maxItems", "uniqueItems"}
)
"""Keywords about the contents of mappings and lists."""


def editor_schema() -> dict[str, Any]:
    """Return the schema."""
    return {**_rewritten(schema_json()), "$comment": "Written by `python -m regscribe.emit.editor_schema`."}


def _rewritten(schema: Any) -> Any:  # noqa: ANN401  JSON: true and false are schemas
    if isinstance(schema, list):
        return [_rewritten(one) for one in schema]
    if not isinstance(schema, dict):
        return schema
    if schema.get("type") == "object" and _chooses(schema):
        schema = _offering(schema)
    kept = {key: value for key, value in schema.items() if key != "default" and not key.startswith("x-")}
    own = {key: _part(key, value) for key, value in kept.items()}
    return _split(own | _snippets(schema))


def _part(keyword: str, value: Any) -> Any:  # noqa: ANN401  JSON
    if keyword in {"enum", "const"}:
        return value
    if keyword == "properties":
        return {key: _rewritten(one) | _hidden(one) if isinstance(one, dict) else one for key, one in value.items()}
    if keyword in _NAMED:
        return {name: _rewritten(one) for name, one in value.items()}
    if keyword == "if" and "required" in value:
        return {"type": "object", **_rewritten(value)}  # else it holds for a value that is not there yet
    return _rewritten(value)


def _hidden(schema: Schema) -> dict[str, bool]:
    """What keeps a key out of proposals, if the schema has no values for it."""
    return {} if schema.keys() & _FORMS else {"doNotSuggest": True}


def _chooses(schema: Schema) -> bool:
    """Whether a schema says by a key of a mapping which of several forms it has."""
    return "required" in schema.get("if", ()) and "$ref" in schema.get("then", ())


def _offering(schema: Schema, others: tuple[Schema, ...] = ()) -> Schema:
    """Let the last of several forms, where its first key is not there yet, know the others in `x-others`."""
    if _chooses(schema):
        return {**schema, "else": _offering(schema["else"], (*others, schema["then"]))}
    begun = resolved(schema, schema_json()["$defs"])["required"][:1]
    return {"if": {"required": begun}, "then": schema, "else": {**schema, "x-others": others}}


def _snippets(schema: Schema) -> dict[str, Any]:
    """What proposes a key that the map chooses, and other forms that a mapping may have."""
    found = []
    if "x-key" in schema:
        title = schema["x-key"]["title"]
        found.append(_snippet(schema["x-key"], {f"${{1:{title}}}": "$2"}))
    for other in schema.get("x-others", ()):
        form = resolved(other, schema_json()["$defs"])
        found.append(_snippet(form, {key: f"${place}" for place, key in enumerate(form["required"], 1)}))
    return {"defaultSnippets": found} if found else {}


def _snippet(schema: Schema, body: Mapping[str, str]) -> dict[str, Any]:
    return {"label": schema["title"], "description": schema["description"], "body": body}


def _split(schema: dict[str, Any]) -> dict[str, Any]:
    """Put into `allOf` what a proposed key would be written with as if it were all that there is.

    That is a reference with a meaning beside it, and the contents of a mapping or list that may be a text too.
    """
    apart: set[str] = set()
    if "$ref" in schema and not schema.keys() <= _BESIDE_REFERENCES:
        apart |= {"$ref"}
        schema = {"type": resolved(schema, schema_json()["$defs"])["type"], **schema}
    if isinstance(schema.get("type"), list) and {"object", "array"} & set(schema["type"]):
        apart |= _CONTENTS
    moved = {key: value for key, value in schema.items() if key in apart}
    rest = {key: value for key, value in schema.items() if key not in apart}
    return {**rest, "allOf": [*schema.get("allOf", ()), moved]} if moved else schema


if __name__ == "__main__":
    print(json.dumps(editor_schema(), indent=1, ensure_ascii=False))  # noqa: T201  this entry exists to print
