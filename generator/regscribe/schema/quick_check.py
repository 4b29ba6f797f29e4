"""A JSON Schema as nested functions: a quick yes to documents that keep to it, which nearly all do.

A no gives no reason: jsonschema finds the mistakes. Nothing is guessed: a document that comes to a keyword which is not
in `KEYWORDS` gets no yes either. Values are plain, as `source` reads them: of exactly the types in `TYPES`.
"""

import operator
import re
from collections.abc import Callable, Mapping, Sequence
from decimal import Decimal
from functools import cache, lru_cache
from types import NoneType
from typing import Any, TypeAlias

from regscribe.schema.schemas import MAP, exact, given_twice, resolved, schema_json
from regscribe.source import Plain

Check: TypeAlias = Callable[[Plain], bool]
Schema: TypeAlias = Mapping[str, Any]
Part: TypeAlias = Callable[[Any], Check]
"""Compiles a schema within the schema."""

TYPES: dict[str, set[type]] = {
    "object": {dict},
    "array": {list},
    "string": {str},
    "integer": {int},
    "number": {int, Decimal},
    "boolean": {bool},
    "null": {NoneType},
}
_ANNOTATIONS = frozenset(
    {"$schema", "$id", "$comment", "title", "description", "default", "defaultSnippets", "doNotSuggest"}
)


class UnknownKeywordError(Exception):
    """A value comes to a keyword that is not in `KEYWORDS`."""


def certainly_valid(value: Plain, language: str = MAP) -> bool:
    """Whether jsonschema need not be asked."""
    try:
        return _check_of(language)(value)
    except UnknownKeywordError:
        return False


@cache
def _check_of(language: str) -> Check:
    return compile_schema(schema_json(language))


def compile_schema(schema: Schema) -> Check:
    """Return the check of a schema, which may refer to its `$defs`; each of its parts is compiled once."""
    definitions, checks = schema.get("$defs", {}), dict[int, Check]()

    def part(node: Any) -> Check:  # noqa: ANN401  JSON
        key = id(node)
        if key not in checks:
            checks[key] = lambda value: checks[key](value)  # noqa: PLW0108 - the next line puts another in its place
            checks[key] = _compile(resolved(node, definitions), part) if isinstance(node, dict) else lambda _: node
        return checks[key]

    return part(schema)


def _compile(schema: Schema, part: Part) -> Check:
    words = [word for word in schema if word not in _ANNOTATIONS and not word.startswith("x-")]
    makers = dict.fromkeys(KEYWORDS.get(word, _unknown) for word in words)
    return _all_of([make(schema, part) for make in makers])


def _all_of(checks: Sequence[Check]) -> Check:
    if len(checks) == 1:
        return checks[0]

    def valid(value: Plain) -> bool:
        for check in checks:  # noqa: SIM110  all() costs a generator for each value
            if not check(value):
                return False
        return True

    return valid


def _unknown(_: Schema, __: Part) -> Check:
    def refuse(_: Plain) -> bool:
        raise UnknownKeywordError

    return refuse


def _type(schema: Schema, _: Part) -> Check:
    names = [schema["type"]] if isinstance(schema["type"], str) else schema["type"]
    allowed = frozenset(kind for name in names for kind in TYPES[name])
    return lambda value: type(value) in allowed


def _one_of(choices: Sequence[bool | int | str | None]) -> Check:
    """Compare as JSON does: true is not 1 there."""
    allowed = frozenset((type(choice) is bool, choice) for choice in choices)
    return lambda value: type(value) not in {dict, list} and (type(value) is bool, value) in allowed


def _pattern(schema: Schema, _: Part) -> Check:
    search = re.compile(exact(schema["pattern"])).search
    return lambda value: type(value) is not str or search(value) is not None


def _unique(schema: Schema, _: Part) -> Check:
    return lambda value: not schema["uniqueItems"] or type(value) is not list or not given_twice(value)


def _limit(word: str, kind: str, holds: Callable[[Any, Any], bool]) -> Callable[[Schema, Part], Check]:
    """Compare a number, or the size of anything else, with the value of a keyword."""
    kinds = TYPES[kind]

    def make(schema: Schema, _: Part) -> Check:
        bound = schema[word]
        if kind == "number":
            return lambda value: type(value) not in kinds or holds(value, bound)
        return lambda value: type(value) not in kinds or holds(len(value), bound)

    return make


def _required(schema: Schema, _: Part) -> Check:
    needed = frozenset(schema["required"])
    return lambda value: type(value) is not dict or needed <= value.keys()


def _dependent(schema: Schema, _: Part) -> Check:
    needed = [(key, frozenset(others)) for key, others in schema["dependentRequired"].items()]
    return lambda value: type(value) is not dict or all(keys <= value.keys() for key, keys in needed if key in value)


def _members(schema: Schema, part: Part) -> Check:
    """`properties`, `patternProperties` and `additionalProperties`, which is for keys that neither of the two has."""
    known = schema.get("properties", {})
    patterns = [(re.compile(exact(key)).search, part(one)) for key, one in schema.get("patternProperties", {}).items()]
    rest = part(schema.get("additionalProperties", True))

    @lru_cache(maxsize=1024)  # compiled when a document has the key: a map uses few of all that there are
    def check_of(key: str) -> Check:
        own = [part(known[key])] if key in known else []
        return _all_of([*own, *(check for search, check in patterns if search(key))] or [rest])

    def valid(value: Plain) -> bool:
        return type(value) is not dict or all(check_of(key)(one) for key, one in value.items())

    return valid


def _elements(schema: Schema, part: Part) -> Check:
    """`prefixItems` for the first elements, `items` for those after them."""
    first = [part(one) for one in schema.get("prefixItems", [])]
    rest = part(schema.get("items", True))

    def valid(value: Plain) -> bool:
        if type(value) is not list:
            return True
        return all(check(one) for check, one in zip(first, value, strict=False)) and all(map(rest, value[len(first) :]))

    return valid


def _condition(schema: Schema, part: Part) -> Check:
    """`if`, and of `then` and `else` the one that applies."""
    test, then, other = (part(schema.get(word, True)) for word in ("if", "then", "else"))
    return lambda value: then(value) if test(value) else other(value)


def _any_of(schema: Schema, part: Part) -> Check:
    checks = [part(one) for one in schema["anyOf"]]
    return lambda value: any(check(value) for check in checks)


def _not(schema: Schema, part: Part) -> Check:
    check = part(schema["not"])
    return lambda value: not check(value)


KEYWORDS: Mapping[str, Callable[[Schema, Part], Check]] = {
    "type": _type,
    "enum": lambda schema, _: _one_of(schema["enum"]),
    "const": lambda schema, _: _one_of([schema["const"]]),
    "pattern": _pattern,
    "minLength": _limit("minLength", "string", operator.ge),
    "maxLength": _limit("maxLength", "string", operator.le),
    "minimum": _limit("minimum", "number", operator.ge),
    "maximum": _limit("maximum", "number", operator.le),
    "exclusiveMinimum": _limit("exclusiveMinimum", "number", operator.gt),
    "exclusiveMaximum": _limit("exclusiveMaximum", "number", operator.lt),
    "minItems": _limit("minItems", "array", operator.ge),
    "maxItems": _limit("maxItems", "array", operator.le),
    "uniqueItems": _unique,
    "prefixItems": _elements,
    "items": _elements,
    "minProperties": _limit("minProperties", "object", operator.ge),
    "maxProperties": _limit("maxProperties", "object", operator.le),
    "required": _required,
    "dependentRequired": _dependent,
    "properties": _members,
    "patternProperties": _members,
    "additionalProperties": _members,
    "allOf": lambda schema, part: _all_of([part(one) for one in schema["allOf"]]),
    "anyOf": _any_of,
    "not": _not,
    "if": _condition,
    "then": _condition,
    "else": _condition,
}
