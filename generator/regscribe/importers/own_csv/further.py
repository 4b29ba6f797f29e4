"""The keys of a register that the column `more` says: as they are, or in words only."""

import re
from collections.abc import Callable
from typing import Any

from regscribe.draft.numbers import plain
from regscribe.evidence.cell_compare import number, objects
from regscribe.files import OneLine

ORDERS = ("big", "little")
CODE = r"-?[0-9]{1,20}(?:\.[0-9]{1,20})?"
PLAIN_CODES = re.compile(rf"{CODE}(\.\.{CODE})?|nan|inf|-inf")
PLAIN_RANGE = re.compile(r"-?[0-9]+(\.[0-9]+)?\.\.-?[0-9]+(\.[0-9]+)?")
FURTHER: dict[str, Callable[[object], bool]] = {
    "word_order": lambda value: value in ORDERS or isinstance(value, list),
    "byte_order": lambda value: value in ORDERS,
    "valid": lambda value: bool(PLAIN_RANGE.fullmatch(str(value))),
    "delivered": lambda value: ": " not in str(value),
    "sentinels": lambda value: isinstance(value, dict) and all(map(PLAIN_CODES.fullmatch, value)),
    "at": lambda value: isinstance(value, list),
    **dict.fromkeys(
        ("byte", "functions", "write_at", "layout", "text", "version", "reading", "poll", "good_for", "static"),
        lambda _: True,
    ),
    **dict.fromkeys(
        ("mandatory", "settle", "endurance", "difference", "stays", "danger", "printed", "description"),
        lambda _: True,
    ),
}
"""The keys of the column `more` that a map takes as they are, with what a value must be."""

NEEDED = frozenset({"word_order", "byte_order", "at", "byte", "layout", "text", "version"})
"""Those that say how a number stands in its words: a register whose row says one in words only is left out."""

SCALING = "stored value times"
"""Begins what `transmitted` says of a factor."""


def more(text: str) -> tuple[dict[str, Any], dict[str, object]]:
    """The keys that the column `more` says, and those that it says in words only."""
    found = objects(text) or {}
    keys = {key: value for key, value in found.items() if key in FURTHER and FURTHER[key](value)}
    if isinstance(faults := keys.get("sentinels"), dict):
        keys["sentinels"] = OneLine({_code(code): label for code, label in faults.items()})
    for key in {"delivered"} & keys.keys():
        value = number(str(keys[key]))
        keys[key] = keys[key] if value is None else plain(value)
    return keys, {key: value for key, value in found.items() if key not in keys}


def _code(text: str) -> Any:  # noqa: ANN401 (a key of YAML)
    value = number(text)
    return text if value is None else plain(value)
