"""Values that occur several times, stored once: `{"$": 3}` stands for the fourth of the table `shared`."""

import json
from collections import Counter
from typing import Any

Json = Any
SHORT = 16
"""Characters of a value that takes no more room than what would stand for it."""


def shared(document: Json) -> Json:
    """Return a document with the table `shared`, whose entries may refer to those before them."""
    counts: Counter[str] = Counter()
    _count(document, counts)
    table: list[Json] = []
    places: dict[str, int] = {}
    made = {key: _put(value, counts, table, places) for key, value in document.items()}
    return {**made, "shared": table}


def _text(value: Json) -> str:
    return json.dumps(value, ensure_ascii=False, sort_keys=True, separators=(",", ":"))


def _count(value: Json, counts: Counter[str]) -> None:
    text = _text(value)
    counts[text] += 1
    if counts[text] == 1 and isinstance(value, dict | list):
        for each in value.values() if isinstance(value, dict) else value:
            _count(each, counts)


def _put(value: Json, counts: Counter[str], table: list[Json], places: dict[str, int]) -> Json:
    text = _text(value)
    if text in places:
        return {"$": places[text]}
    made = value
    if isinstance(value, dict):
        made = {key: _put(each, counts, table, places) for key, each in value.items()}
    elif isinstance(value, list):
        made = [_put(each, counts, table, places) for each in value]
    if counts[text] > 1 and len(text) > SHORT:
        places[text] = len(table)
        table.append(made)
        return {"$": places[text]}
    return made
