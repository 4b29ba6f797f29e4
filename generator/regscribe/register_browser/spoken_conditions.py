"""Conditions in words, beside their tests."""

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from regscribe.emit.words import condition_words
from regscribe.export.json import plain
from regscribe.model import Condition, Model
from regscribe.register_browser.exact import exact
from regscribe.visible import json_text

Json = Any


def with_words(facts: Json, record: object, model: Model) -> Json:
    """Return the facts of a register (or another record) with `words` in each condition that asks something."""
    words = {json_text(exact(plain(one))): condition_words(one, model) for one in _conditions(record) if one.tests}
    return _spoken(facts, words) if words else facts


def _conditions(value: object) -> Iterator[Condition]:
    if isinstance(value, Condition):
        yield value
    if isinstance(value, tuple):
        for each in value:
            yield from _conditions(each)
    elif is_dataclass(value):
        for item in fields(value):
            yield from _conditions(getattr(value, item.name))


def _spoken(value: Json, words: dict[str, str]) -> Json:
    if isinstance(value, list):
        return [_spoken(each, words) for each in value]
    if not isinstance(value, dict):
        return value
    found = {name: _spoken(each, words) for name, each in value.items()}
    spoken = words.get(json_text(value)) if "tests" in value else None
    return found | {"words": spoken} if spoken else found
