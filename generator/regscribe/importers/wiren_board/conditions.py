"""Conditions of Wiren Board's templates (`mode==1&&(fan>=2||fan!=0)`) as conditions of the language."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from regscribe.draft.numbers import plain
from regscribe.importers.shared.exact import number

TOKEN = re.compile(r"\s*(\|\||&&|[()]|==|!=|>=|<=|>|<|-?\d[\w.]*|[A-Za-z_]\w*)")
MOST_DEPTH = 20
MOST_TOKENS = 400


@dataclass(frozen=True, slots=True)
class Reference:
    """A parameter that conditions ask: a register by its id, or a given with its title and default."""

    id: str
    title: str = ""
    default: Fraction | None = None
    given: bool = False

    @property
    def subject(self) -> str:
        """What a condition calls it."""
        return f"given.{self.id}" if self.given else self.id


class ConditionError(Exception):
    """A condition is not understood."""


def condition_of(text: str, references: Mapping[str, Reference]) -> tuple[Any, frozenset[str]]:
    """Return the condition, and the ids of the parameters that it asks. Raises ConditionError."""
    tokens: list[str] = []
    at = 0
    while at < len(text.rstrip()):
        found = TOKEN.match(text, at)
        if found is None or len(tokens) >= MOST_TOKENS:
            message = f"`{text[at : at + 20]}` is not understood"
            raise ConditionError(message)
        tokens.append(found[1])
        at = found.end()
    parser = _Parser(tokens, references)
    when = parser.any(0)
    if parser.rest:
        message = f"`{parser.rest[0]}` is not understood"
        raise ConditionError(message)
    return when, frozenset(parser.asked)


class _Parser:
    """Takes one token after the other; `||` binds less than `&&`."""

    def __init__(self, tokens: list[str], references: Mapping[str, Reference]) -> None:
        self.rest = tokens
        self.references = references
        self.asked: set[str] = set()

    def any(self, depth: int) -> Any:  # noqa: ANN401 - a condition in plain values
        """Conditions of which one must hold."""
        parts = [self._all(depth)]
        while self.rest[:1] == ["||"]:
            self.rest = self.rest[1:]
            parts.append(self._all(depth))
        return parts[0] if len(parts) == 1 else {"any": parts}

    def _all(self, depth: int) -> Any:  # noqa: ANN401 - as above
        parts = [self._one(depth)]
        while self.rest[:1] == ["&&"]:
            self.rest = self.rest[1:]
            parts.append(self._one(depth))
        if len(parts) == 1:
            return parts[0]
        return [inner for part in parts for inner in (part if isinstance(part, list) else [part])]

    def _one(self, depth: int) -> Any:  # noqa: ANN401 - as above
        if self.rest[:1] == ["("] and depth < MOST_DEPTH:
            self.rest = self.rest[1:]
            inner = self.any(depth + 1)
            self._expect(")")
            return inner
        name, sign, text = (*self.rest[:3], "", "", "")[:3]
        value, own = number(text), self.references.get(name)
        if own is None and sign in MATCHERS:
            message = f"there is no parameter {name}"
            raise ConditionError(message)
        if own is None or value is None or sign not in MATCHERS:
            message = f"`{' '.join(self.rest[:3])}` compares no parameter with a number"
            raise ConditionError(message)
        self.rest = self.rest[3:]
        self.asked.add(own.id)
        return {own.subject: MATCHERS[sign](plain(value))}

    def _expect(self, token: str) -> None:
        if self.rest[:1] != [token]:
            message = f"`{token}` is missing"
            raise ConditionError(message)
        self.rest = self.rest[1:]


MATCHERS: Mapping[str, Callable[[Any], Any]] = {
    "==": lambda value: value,
    "!=": lambda value: {"not": value},
    ">=": lambda value: {"from": value},
    "<=": lambda value: {"to": value},
    ">": lambda value: {"not": {"to": value}},
    "<": lambda value: {"not": {"from": value}},
}
"""Tests of the language by the signs of a template."""
