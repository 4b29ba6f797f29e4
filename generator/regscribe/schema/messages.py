"""Violations of the JSON Schema as messages for people who write maps; a message never holds a whole value."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING, Any

from regscribe.model.nearest import nearest
from regscribe.schema import rules
from regscribe.schema.wording import describe, example, title

if TYPE_CHECKING:
    from jsonschema import ValidationError

_TYPES = {
    "string": "a text",
    "integer": "a whole number",
    "number": "a number",
    "boolean": "true or false",
    "array": "a list",
    "object": "a mapping",
    "null": "null",
}
_YES_OR_NO = {"yes", "no", "on", "off", "y", "n", "true", "false"}
_LISTED = 12
"""Words of a longer list are not all named where it is clear which one is meant."""
_COMPARISONS = {
    "minimum": "at least",
    "maximum": "at most",
    "exclusiveMinimum": "more than",
    "exclusiveMaximum": "less than",
}
_COUNTS = {
    "minLength": ("at least", "character"),
    "maxLength": ("at most", "character"),
    "minItems": ("at least", "element"),
    "maxItems": ("at most", "element"),
    "minProperties": ("at least", "key"),
    "maxProperties": ("at most", "key"),
}


@dataclass(frozen=True, slots=True)
class Complaint:
    """One mistake: `path` leads to the value, or (`at_key`) to its key.

    Of complaints of one rule at one place with the same `subject` (None: its message), the first is shown.
    `replacement` is the key or the word that was probably meant.
    """

    rule: str
    path: tuple[str | int, ...]
    message: str
    advice: str
    at_key: bool = False
    subject: str | None = None
    replacement: str = ""


@dataclass(frozen=True, slots=True)
class Violation:
    """An error of jsonschema, typed: `kind` is the keyword of `schema` that `instance` breaks, `bound` its value."""

    kind: str
    path: tuple[str | int, ...]
    schema: Mapping[str, Any]
    bound: Any
    instance: Any


def violation(error: "ValidationError") -> Violation:
    """Convert an error, without its message, which holds the whole instance."""
    schema = error.schema if isinstance(error.schema, dict) else {}
    return Violation(str(error.validator), tuple(error.absolute_path), schema, error.validator_value, error.instance)


def complaints(error: Violation, places: Mapping[str, Sequence[str]]) -> Iterator[Complaint]:
    """Yield the messages of one violation: one for each key concerned; `places` are what has a key, by the key."""
    kind = error.kind
    if kind == "additionalProperties":
        yield from _unknown_keys(error, places)
    elif kind in {"required", "dependentRequired"}:
        yield from _missing_keys(error)
    elif kind == "not":
        said = f"`{error.path[-1]}` {error.schema.get('description', 'cannot stand here')}"
        yield Complaint(rules.EXCLUSIVE_KEYS, error.path, said, "delete one of the two", at_key=True)
    elif kind == "type":
        yield _wrong_type(error)
    elif kind == "pattern":
        form = str(error.schema.get("x-form", error.schema.get("description", ""))).rstrip(".")
        said = f"{describe(error.instance)} is not in the form of {title(error.schema)}: {form}"
        yield Complaint(rules.WRONG_FORM, error.path, said, example(error.schema))
    elif kind in _COUNTS or kind == "uniqueItems":
        yield _wrong_count(error)
    else:
        yield _not_allowed(error)


def _unknown_keys(error: Violation, places: Mapping[str, Sequence[str]]) -> Iterator[Complaint]:
    schema = error.schema
    known = list(schema.get("properties", ()))
    patterns = schema.get("patternProperties", ())
    for key in error.instance:
        if key in known or any(re.search(pattern, key) for pattern in patterns):
            continue
        shown, path = describe(key), (*error.path, key)
        if "x-key" in schema and not nearest(key.lower(), known):
            form = schema["x-key"]
            said = f"{shown} is not in the form of {form['title']}: {form['description']}"
            yield Complaint(rules.WRONG_FORM, path, said, example(form), at_key=True)
        else:
            said = f"unknown key {shown} in {title(schema)}"
            meant = _meant(key, schema["properties"], error.instance)
            elsewhere = f"{shown} is a key of: {', '.join(places[key])}; " if key in places else ""
            advice = f"did you mean `{meant}`?" if meant else f"{elsewhere}the keys here are: {', '.join(known)}"
            yield Complaint(rules.UNKNOWN_KEY, path, said, advice, at_key=True, replacement=meant)


def _meant(key: str, known: Mapping[str, Mapping[str, Any]], given: Mapping[str, Any]) -> str:
    """Guess the key that was meant: one that other tools call so (best one that is not given), or spelled nearly so."""
    also = [name for name, details in known.items() if key.lower() in details.get("x-also", ())]
    return min(also, key=given.__contains__, default="") or nearest(key.lower(), known)


def _missing_keys(error: Violation) -> Iterator[Complaint]:
    needed = error.bound
    if error.kind == "dependentRequired":
        needed = [key for given, keys in error.bound.items() if given in error.instance for key in keys]
    where = f" in {title(error.schema)}" if "title" in error.schema else ""
    for key in needed:
        if key in error.instance:
            continue
        said = error.schema.get("x-missing", f"`{key}`")
        details = error.schema.get("properties", {}).get(key, {})
        meaning = str(details.get("description", "")).split(". ")[0].rstrip(".")
        advice = ", ".join(filter(None, (f"add {said}{f' ({meaning})' if meaning else ''}", example(details))))
        yield Complaint(rules.MISSING_KEY, error.path, f"{said} is missing{where}", advice, at_key=True, subject=key)


def _wrong_type(error: Violation) -> Complaint:
    types = [error.bound] if isinstance(error.bound, str) else list(error.bound)
    allowed = [_TYPES[name] for name in types]
    wanted = " or ".join([", ".join(allowed[:-1]), allowed[-1]] if allowed[1:] else allowed)
    said = f"{title(error.schema)} must be {wanted}; this is {describe(error.instance)}"
    advice = _instead(error) or _retype(error.instance, types) or example(error.schema)
    return Complaint(rules.WRONG_TYPE, error.path, said, advice, subject="")


def _instead(error: Violation) -> str:
    """Say what the language writes for a value that others spell so, or for a `number` or a `list` in this place."""
    known: Mapping[str, str] = error.schema.get("x-instead", {})
    if isinstance(error.instance, str):
        written = known.get(re.sub(r"[\s_-]", "", error.instance[:100]).lower(), "")
    elif isinstance(error.instance, list):
        written = known.get("list", "")
    else:
        number = isinstance(error.instance, int | Decimal) and not isinstance(error.instance, bool)
        written = known.get("number", "").format(describe(error.instance).split()[-1]) if number else ""
    return f"write {written if '`' in written else f'`{written}`'}" if written else ""


def _retype(instance: object, types: Sequence[str]) -> str:
    """Say how to write the value that was probably meant."""
    if instance is None:
        return "write a value after the `:`, or delete the key"
    if "boolean" in types and isinstance(instance, str) and instance.lower() in _YES_OR_NO:
        return "write true or false, without quotes"
    if "string" in types and isinstance(instance, bool | int | Decimal):
        return "put it in quotes if a text is meant (8E1 or 007 are numbers to YAML)"
    if "array" in types and "object" not in types and isinstance(instance, str | int):
        return "put it in brackets: [..]"
    return ""


def _wrong_count(error: Violation) -> Complaint:
    if error.kind == "uniqueItems":
        said = f"an element of {title(error.schema)} is given twice"
        return Complaint(rules.WRONG_COUNT, error.path, said, "delete one of the two")
    bound, unit = _COUNTS[error.kind]
    limit, size = error.bound, len(error.instance)
    said = f"{title(error.schema)} must have {bound} {limit} {unit}{'' if limit == 1 else 's'}; this has {size}"
    return Complaint(rules.WRONG_COUNT, error.path, said, example(error.schema))


def _not_allowed(error: Violation) -> Complaint:
    kind, value = error.kind, error.bound
    if kind in _COMPARISONS:
        said = f"{title(error.schema)} must be {_COMPARISONS[kind]} {value}; this is {describe(error.instance)}"
        return Complaint(rules.VALUE_NOT_ALLOWED, error.path, said, example(error.schema))
    choices = [str(choice) for choice in (value if kind == "enum" else [value])]
    near = nearest(error.instance.lower(), choices) if isinstance(error.instance, str) else ""
    allowed, instead = ", ".join(f"`{choice}`" for choice in choices), _instead(error)
    said = f"{describe(error.instance)} is not allowed for {title(error.schema)}"
    if not instead or len(choices) <= _LISTED:
        said += f"; allowed: {allowed}"
    advice = instead or (f"did you mean `{near}`?" if near else "write one of the allowed words")
    if kind != "enum":
        return Complaint(rules.VALUE_NOT_ALLOWED, error.path, said, f"write {allowed}")
    word = instead.removeprefix("write ").strip("`")
    meant = word if word in choices else "" if instead else near
    return Complaint(rules.VALUE_NOT_ALLOWED, error.path, said, advice, replacement=meant)
