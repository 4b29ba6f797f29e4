"""What each keyword of JSON Schema asks of a value, as a function: the keywords that the project's own schemas use.

Values are plain, as `source` reads them: of exactly the types in `TYPES`.
"""

import operator
import re
from collections.abc import Callable, Mapping, Sized
from decimal import Decimal
from types import NoneType
from typing import Any

from regscribe.schema import parts
from regscribe.schema.parts import Check, Part, Schema
from regscribe.schema.schemas import exact, given_twice
from regscribe.source import Plain

TYPES: dict[str, set[type]] = {
    "object": {dict},
    "array": {list},
    "string": {str},
    "integer": {int},
    "number": {int, Decimal},
    "boolean": {bool},
    "null": {NoneType},
}


def _type(schema: Schema, _: Part) -> Check:
    names = [schema["type"]] if isinstance(schema["type"], str) else schema["type"]
    allowed = frozenset(kind for name in names for kind in TYPES[name])
    return lambda value: type(value) in allowed


def _enum(schema: Schema, _: Part) -> Check:
    return _one_of(schema["enum"])


def _const(schema: Schema, _: Part) -> Check:
    return _one_of([schema["const"]])


def _one_of(choices: list[bool | int | str | None]) -> Check:
    """Compare as JSON does: true is not 1 there."""
    allowed = frozenset((type(choice) is bool, choice) for choice in choices)
    return lambda value: type(value) not in {dict, list} and (type(value) is bool, value) in allowed


def _required(schema: Schema, _: Part) -> Check:
    needed = frozenset(schema["required"])
    return lambda value: type(value) is not dict or needed <= value.keys()


def _dependent(schema: Schema, _: Part) -> Check:
    needed = [(key, frozenset(others)) for key, others in schema["dependentRequired"].items()]

    def valid(value: Plain) -> bool:
        return type(value) is not dict or all(key not in value or others <= value.keys() for key, others in needed)

    return valid


def _pattern(schema: Schema, _: Part) -> Check:
    search = re.compile(exact(schema["pattern"])).search
    return lambda value: type(value) is not str or search(value) is not None


def _unique(schema: Schema, _: Part) -> Check:
    return lambda value: not schema["uniqueItems"] or type(value) is not list or not given_twice(value)


def _bound(word: str, holds: Callable[[Any, Any], bool]) -> Callable[[Schema, Part], Check]:
    def make(schema: Schema, _: Part) -> Check:
        bound, numbers = schema[word], TYPES["number"]
        return lambda value: type(value) not in numbers or holds(value, bound)

    return make


def _size(word: str, kind: type[Sized], holds: Callable[[Any, Any], bool]) -> Callable[[Schema, Part], Check]:
    def make(schema: Schema, _: Part) -> Check:
        bound = schema[word]
        return lambda value: not isinstance(value, kind) or holds(len(value), bound)

    return make


KEYWORDS: Mapping[str, Callable[[Schema, Part], Check]] = {
    "type": _type,
    "enum": _enum,
    "const": _const,
    "pattern": _pattern,
    "minLength": _size("minLength", str, operator.ge),
    "maxLength": _size("maxLength", str, operator.le),
    "minimum": _bound("minimum", operator.ge),
    "maximum": _bound("maximum", operator.le),
    "exclusiveMinimum": _bound("exclusiveMinimum", operator.gt),
    "exclusiveMaximum": _bound("exclusiveMaximum", operator.lt),
    "minItems": _size("minItems", list, operator.ge),
    "maxItems": _size("maxItems", list, operator.le),
    "uniqueItems": _unique,
    "prefixItems": parts.elements,
    "items": parts.elements,
    "minProperties": _size("minProperties", dict, operator.ge),
    "maxProperties": _size("maxProperties", dict, operator.le),
    "required": _required,
    "dependentRequired": _dependent,
    "properties": parts.members,
    "patternProperties": parts.members,
    "additionalProperties": parts.members,
    "allOf": parts.every,
    "anyOf": parts.some,
    "not": parts.none,
    "if": parts.condition,
    "then": parts.condition,
    "else": parts.condition,
}
