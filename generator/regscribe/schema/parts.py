"""The keywords of JSON Schema that hold schemas: of the members of a mapping, of a list's elements, by condition."""

import re
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from regscribe.schema.schemas import exact
from regscribe.source import Plain

Check: TypeAlias = Callable[[Plain], bool]
Schema: TypeAlias = Mapping[str, Any]
Part: TypeAlias = Callable[[Any], Check]
"""Makes the function of a schema within the schema."""


def all_of(checks: tuple[Check, ...]) -> Check:
    """Join functions: all must say yes."""
    if len(checks) == 1:
        return checks[0]

    def valid(value: Plain) -> bool:
        for check in checks:  # noqa: SIM110  all() costs a generator for each value
            if not check(value):
                return False
        return True

    return valid


class _Members(dict[str, Check]):
    """The functions of the keys that documents have had so far: a map uses few of all that there are."""

    def __init__(self, schemas: Schema, part: Part) -> None:
        super().__init__()
        self.schemas = schemas
        self._part = part

    def __missing__(self, key: str) -> Check:
        check = self[key] = self._part(self.schemas[key])
        return check


def members(schema: Schema, part: Part) -> Check:
    """`properties`, `patternProperties` and `additionalProperties`, which is for keys that neither of the two has."""
    known = _Members(schema.get("properties", {}), part)
    patterns = [(re.compile(exact(pattern)).search, part(one)) for pattern, one in _patterns(schema)]
    rest = part(schema.get("additionalProperties", True))

    def other(key: str, value: Plain) -> bool:
        checks = [check for search, check in patterns if search(key)]
        return all(check(value) for check in checks) if checks or key in known.schemas else rest(value)

    def valid(value: Plain) -> bool:
        if type(value) is not dict:
            return True
        for key, one in value.items():
            found = key in known.schemas
            if (found and not known[key](one)) or ((patterns or not found) and not other(key, one)):
                return False
        return True

    return valid


def _patterns(schema: Schema) -> Any:  # noqa: ANN401  JSON
    return schema.get("patternProperties", {}).items()


def elements(schema: Schema, part: Part) -> Check:
    """`prefixItems` for the first elements, `items` for those after them."""
    first = [part(one) for one in schema.get("prefixItems", [])]
    rest = part(schema.get("items", True))

    def valid(value: Plain) -> bool:
        if type(value) is not list:
            return True
        return all(check(one) for check, one in zip(first, value, strict=False)) and all(map(rest, value[len(first) :]))

    return valid


def condition(schema: Schema, part: Part) -> Check:
    """`if`, and of `then` and `else` the one that applies."""
    test, then, other = (part(schema.get(word, True)) for word in ("if", "then", "else"))
    return lambda value: then(value) if test(value) else other(value)


def every(schema: Schema, part: Part) -> Check:
    """`allOf`."""
    return all_of(tuple(part(one) for one in schema["allOf"]))


def some(schema: Schema, part: Part) -> Check:
    """`anyOf`."""
    checks = [part(one) for one in schema["anyOf"]]
    return lambda value: any(check(value) for check in checks)


def none(schema: Schema, part: Part) -> Check:
    """`not`."""
    check = part(schema["not"])
    return lambda value: not check(value)
