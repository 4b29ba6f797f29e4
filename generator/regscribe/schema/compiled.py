"""A JSON Schema as nested functions: a quick yes for what keeps to it, which is nearly every document.

A no gives no reason: jsonschema finds the mistakes. Nothing is guessed: a keyword that is not known here is a no, too,
where a document comes to it. What jsonschema refuses is never a yes.
"""

from functools import cache
from typing import Any

from regscribe.schema.keywords import KEYWORDS
from regscribe.schema.parts import Check, Schema, all_of
from regscribe.schema.schemas import MAP, resolved, schema_json
from regscribe.source import Plain

_ANNOTATIONS = frozenset({"$schema", "$id", "title", "description", "default", "examples"})


class UnknownKeywordError(Exception):
    """The schema has a word whose meaning is not known here."""


def certainly_valid(value: Plain, language: str = MAP) -> bool:
    """Whether jsonschema need not be asked."""
    try:
        return _check_of(language)(value)
    except UnknownKeywordError:
        return False


@cache
def _check_of(language: str) -> Check:
    return Compiler(schema_json(language)).check(schema_json(language))


class Compiler:
    """Makes the function of each part of a schema once."""

    def __init__(self, schema: Schema) -> None:
        self._definitions = schema.get("$defs", {})
        self._schema = schema  # kept, so that no other object gets the id of one of its parts
        self._made: dict[int, Check] = {}

    def check(self, node: Any) -> Check:  # noqa: ANN401  JSON
        """Return the function of a part; while it is being made, one that looks it up when it is called."""
        made, key = self._made, id(node)
        if key not in made:
            made[key] = lambda value: made[key](value)  # noqa: PLW0108 - the next line puts another in its place
            made[key] = self._make(resolved(node, self._definitions)) if isinstance(node, dict) else lambda _: node
        return made[key]

    def _make(self, schema: Schema) -> Check:
        words = [word for word in schema if word not in _ANNOTATIONS and not word.startswith("x-")]
        unknown = [word for word in words if not _is_known(word, schema)]
        if unknown:
            return _refusal(unknown)
        return all_of(tuple(make(schema, self.check) for make in dict.fromkeys(KEYWORDS[word] for word in words)))


def _is_known(word: str, schema: Schema) -> bool:
    return word in KEYWORDS and (word not in {"then", "else"} or "if" in schema)


def _refusal(words: list[str]) -> Check:
    def refuse(_: Plain) -> bool:
        raise UnknownKeywordError(*words)

    return refuse
