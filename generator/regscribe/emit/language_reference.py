"""The reference of the map language in Markdown, from its schema: `python -m regscribe.emit.language_reference`."""

from collections.abc import Iterator, Mapping
from typing import Any

from regscribe.emit.language_index import contents, known_units, tasks
from regscribe.schema import inline, schema_json

Schema = Mapping[str, Any]

_TYPES = {
    "string": "text",
    "integer": "whole number",
    "number": "number",
    "boolean": "true or false",
    "array": "list",
    "object": "mapping",
    "null": "null",
    "": "anything",
}
_BOUNDS = (
    ("minimum", "at least {}"),
    ("exclusiveMinimum", "more than {}"),
    ("maximum", "at most {}"),
    ("maxLength", "at most {} characters"),
    ("minItems", "elements: at least {}"),
    ("maxItems", "elements: at most {}"),
    ("minProperties", "keys: at least {}"),
    ("maxProperties", "keys: at most {}"),
)
_DEFAULT = " Default: "
_MAY_BE_NULL = {"type": "null"}
_INTRODUCTION = """\
<!-- Generated from schema/map.language.json by `python -m regscribe.emit.language_reference`; edit the schema. -->

# The map language, format 1

A map is one YAML file for one device family. The [tutorial](tutorial.md) writes one from a page of a manual, the
[recipes](recipes.md) show what to write for what manuals say; this page lists every key. A map may extend another one
(`extends`) and use libraries of names (`uses`), which lie in the same `maps` folder. The same text appears in an editor
that knows YAML schemas, if the map starts with the line

```yaml
# yaml-language-server: $schema=../../schema/map.schema.json
```

YAML is read by the rules of version 1.2: only `true` and `false` are booleans, so `off` and `yes` are texts; a number
has one notation (`010`, `1_000` and `.inf` are refused), and one with a fraction or an exponent is kept exactly; a
key given twice, a tag, a merge key and a second document are errors. All mappings are closed: a key that is not
listed here is an error, except that keys starting with `x-` are allowed everywhere and have no effect.
"""


def render(schema: Schema) -> str:
    """Render the reference: a section for the file, then one for each definition, in the schema's order."""
    definitions: Schema = schema["$defs"]
    parts = [_INTRODUCTION, *contents(map(_heading, definitions)), *tasks(schema, _heading)]
    parts += _section("The file", schema, definitions)
    for name, definition in definitions.items():
        parts += _section(_heading(name), definition, definitions)
    parts += known_units()
    return "\n".join(parts).rstrip("\n") + "\n"


def _section(heading: str, schema: Schema, definitions: Schema) -> Iterator[str]:
    yield f"## {heading}\n"
    yield f"{schema['description']}\n"
    yield f"Form: {_form(schema)}.\n"
    if "x-key" in schema:
        yield f"Its keys: {schema['x-key']['description']}.{_values(schema)}\n"
    if schema.get("properties"):
        yield "\n".join(_table(schema, definitions)) + "\n"
        yield from _borrowed(schema)
    yield from _rules(schema)
    if schema.get("x-examples"):
        yield "```yaml"
        yield from (inline(example) for example in schema["x-examples"])
        yield "```\n"


def _table(schema: Schema, definitions: Schema) -> Iterator[str]:
    if not all(_owner(own) for own in schema["properties"].values()):
        yield "| key | value | required | default | meaning | example |"
        yield "|---|---|---|---|---|---|"
    required = {*schema.get("required", ()), *schema.get("else", {}).get("required", ())}  # else: of a map, no library
    for key, own in schema["properties"].items():
        if not _owner(own):
            yield _row(key, own, _effective(own, definitions), required=key in required)


def _row(key: str, own: Schema, details: Schema, *, required: bool) -> str:
    meaning, _, default = details["description"].partition(_DEFAULT)
    example = f"`{inline(details['x-examples'][0])}`"
    cells = (f"`{key}`", _form(own), "yes" if required else "", default.rstrip("."), meaning, example)
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"


def _borrowed(schema: Schema) -> Iterator[str]:
    """Name the keys that are those of another definition."""
    owners: dict[str, list[str]] = {}
    for key, own in schema["properties"].items():
        if _owner(own):
            owners.setdefault(_owner(own), []).append(f"`{key}`")
    for owner, keys in owners.items():
        null = ", or null" if any("else" in own for own in schema["properties"].values()) else ""
        yield f"As in [{owner}](#{owner}){null}: {', '.join(keys)}.\n"


def _owner(details: Schema) -> str:
    """Return the definition that the key belongs to; empty if it is a key of its own."""
    steps = details.get("else", details).get("$ref", "").split("/")
    return steps[2] if len(steps) > 3 else ""  # noqa: PLR2004  "#/$defs/register/properties/unit" has five steps


def _effective(details: Schema, definitions: Schema) -> Schema:
    """Return the schema of a key with what it refers to; of a key that may be null, that of the other values."""
    details = details["else"] if details.get("if") == _MAY_BE_NULL else details
    if "$ref" not in details:
        return details
    target: Any = {"$defs": definitions}
    for step in details["$ref"].removeprefix("#/").split("/"):
        target = target[step]
    return {**_effective(target, definitions), **details}


def _form(schema: Schema) -> str:
    """Describe the values that a schema allows, with links to the sections that say more."""
    if "$ref" in schema:
        return _link(schema["$ref"])
    if schema.get("if") == _MAY_BE_NULL:
        return f"{_form(schema['else'])}, or null"
    if schema.keys() & {"enum", "const"}:
        return ", ".join(f"`{inline(word)}`" for word in schema.get("enum", [schema.get("const")]))
    types = schema.get("type", "")
    words = dict.fromkeys(_type_form(name, schema) for name in ([types] if isinstance(types, str) else types))
    bounds = [text.format(schema[bound]) for bound, text in _BOUNDS if bound in schema]
    return " or ".join(words) + (f" ({', '.join(bounds)})" if bounds else "")


def _type_form(name: str, schema: Schema) -> str:
    """Describe one of the types of a schema, with the branch for this type."""
    branch = _branch(name, schema)
    if "$ref" in branch:
        return _link(branch["$ref"])
    items = branch.get("items", schema.get("items"))
    if name == "array" and items:
        return f"list of {_items(items)}"
    if name == "object" and "x-key" in schema:
        return f"mapping from {schema['x-key']['title']} to {_form(_value(schema))}"
    return _TYPES[name]


def _branch(name: str, schema: Schema) -> Schema:
    """Return the branch of a condition on the type, if it is for this type alone; else an empty one."""
    condition = schema.get("if", {})
    branch: Schema = schema.get("then" if condition.get("type") == name else "else", {}) if "type" in condition else {}
    return {} if "if" in branch else branch


def _items(items: Schema) -> str:
    links = [_link(branch["$ref"]) for branch in _leaves(items)]
    return " or ".join(links) if links else _form(items)


def _leaves(schema: Schema) -> Iterator[Schema]:
    for key in ("then", "else"):
        branch = schema.get(key, {})
        if "$ref" in branch:
            yield branch
        elif "if" in branch:
            yield from _leaves(branch)


def _values(schema: Schema) -> str:
    described = _value(schema).get("description", "")
    return f" The value: {described}" if described else ""


def _value(schema: Schema) -> Schema:
    """Return the schema of the values under keys that the map chooses."""
    value: Schema = next(value for pattern, value in schema["patternProperties"].items() if pattern != "^x-")
    return value


def _rules(schema: Schema) -> Iterator[str]:
    """Yield a list of rules between keys, as far as the schema has them in words."""
    lines = [
        f"- Needed: {branch['x-missing']}."
        for branch in (schema, *schema.get("allOf", ()))
        for branch in (branch.get("then", {}),)
        if "x-missing" in branch
    ]
    for rule in (schema, *schema.get("allOf", ())):
        refused: dict[str, list[str]] = {}
        for key, branch in rule.get("then", {}).get("properties", {}).items():
            if "not" in branch:
                refused.setdefault(branch["description"], []).append(f"`{key}`")
        lines += [f"- {', '.join(keys)} {why}." for why, keys in refused.items()]
    if lines:
        yield "\n".join(lines) + "\n"


def _link(pointer: str) -> str:
    steps = pointer.removeprefix("#/$defs/").split("/")
    return f"[{steps[-1].replace('_', ' ')}](#{_heading(steps[0]).lower().replace(' ', '-')})"


def _heading(name: str) -> str:
    return name.replace("_", " ").capitalize()


if __name__ == "__main__":
    print(render(schema_json()), end="")  # noqa: T201  this entry exists to print: it writes docs/language.md
