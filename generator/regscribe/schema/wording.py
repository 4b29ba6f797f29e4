"""Values and schemas in words, for messages and for the reference of the language."""

import re
from collections.abc import Mapping
from decimal import Decimal
from typing import Any

from regscribe.source import NumberFormError, resolve, shorten

_PLAIN = re.compile(r"(?:-(?=[0-9]))?[\w°µ][\w°µ%./()'+=-]*(?: [\w°µ%./()'+=-]+)*\Z")


def title(schema: Mapping[str, Any]) -> str:
    """Name what the schema describes."""
    return str(schema.get("title", "this"))


def example(schema: Mapping[str, Any]) -> str:
    """Show an example in the notation of the map; empty if the schema has none."""
    examples = schema.get("x-examples", ())
    return f"for example `{inline(examples[0])}`" if examples else ""


def inline(value: object) -> str:
    """Write a value of the schema on one line of YAML, with quotes where YAML would take a text for something else."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {inline(element)}" for key, element in value.items()) + "}"
    if isinstance(value, list):
        return f"[{', '.join(inline(element) for element in value)}]"
    if not isinstance(value, str):
        return str(value).lower() if isinstance(value, bool) else str(value)
    try:
        plain = bool(_PLAIN.match(value)) and isinstance(resolve(value), str)
    except NumberFormError:
        plain = False
    return value if plain else "'" + value.replace("'", "''") + "'"


def describe(value: object) -> str:
    """Name a value of a map in a message: short, printable, its parts left out."""
    if value is None:
        return "empty (null)"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, list):
        return f"a list of {len(value)}"
    if isinstance(value, dict):
        return f"a mapping of {len(value)}"
    if isinstance(value, str):
        return f"`{shorten(value)}`" if value else "an empty text"
    return f"the number {shorten(f'{value:f}' if isinstance(value, Decimal) else str(value))}"
