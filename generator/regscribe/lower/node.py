"""A value of the map together with its place, and the collector of what is wrong with the values."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from enum import StrEnum
from fractions import Fraction
from typing import Any, TypeVar

from regscribe.lower.rules import WRONG_SORT
from regscribe.model import Diagnostic, Related, Span, exact, parse
from regscribe.source import Document, Path

Choice = TypeVar("Choice", bound=StrEnum)

ZERO = Fraction(0)
_LONGEST_NUMBER = 100
_LONGEST_SHOWN = 60


def brief(text: str) -> str:
    """The text as it may stand in a message: on one line, printable, cut where it is long."""
    line = "".join(letter if letter.isprintable() else " " for letter in text[: _LONGEST_SHOWN + 1])
    return line if len(line) <= _LONGEST_SHOWN else f"{line[:_LONGEST_SHOWN]}…"


@dataclass(frozen=True, slots=True)
class Collector:
    """The document in work and the diagnostics found in it so far; `sizes` of sets, and how far models have `grown`.

    `offered` are the defaults for several registers, by the path of where they stand, `taken` the paths of all keys
    that count for some register. Registers are lowered once for each model and element, so a finding counts once per
    rule and place.
    """

    document: Document
    found: dict[tuple[str, Span], Diagnostic] = field(default_factory=dict)
    grown: dict[str, int] = field(default_factory=dict)
    sizes: dict[str, int] = field(default_factory=dict)
    offered: dict[Path, "Value"] = field(default_factory=dict)
    taken: set[Path] = field(default_factory=set)

    def report(
        self, rule: str, message: str, *, span: Span, remedy: str = "", related: tuple[Related, ...] = ()
    ) -> None:
        """Keep a diagnostic, unless the same rule spoke at the same place already."""
        self.found.setdefault((rule, span), Diagnostic(rule, message, span, help=remedy, related=related))

    def grow(self, model: str, registers: int) -> int:
        """Count registers that sets put into a model; return how many there are so far."""
        self.grown[model] = self.grown.get(model, 0) + registers
        return self.grown[model]

    def spoke(self, rule: str, span: Span) -> bool:
        """Whether the rule spoke at this place already."""
        return (rule, span) in self.found

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What was found, in the order of the file."""
        return sorted(self.found.values(), key=lambda diagnostic: (diagnostic.span, diagnostic.rule))


@dataclass(frozen=True, slots=True)
class Value:
    """One value of the document: `value` as `regscribe.source` gives it, `path` from the top.

    The readers (`text`, `number`, ...) are total: where the value is of another sort they report RS0330 and return a
    placeholder, so that lowering goes on and finds the other mistakes.
    """

    context: Collector
    path: Path
    value: Any

    @property
    def span(self) -> Span:
        """Where the value stands."""
        return self.context.document.span(self.path)

    @property
    def key_span(self) -> Span:
        """Where the key of the value stands."""
        return self.context.document.key_span(self.path)

    @property
    def key(self) -> str:
        """The last step of the path, as text."""
        return str(self.path[-1]) if self.path else ""

    def report(
        self, rule: str, message: str, *, remedy: str = "", at_key: bool = False, related: tuple[Related, ...] = ()
    ) -> None:
        """Report a mistake at this value (or at its key)."""
        span = self.key_span if at_key else self.span
        self.context.report(rule, message, span=span, remedy=remedy, related=related)

    def child(self, key: str) -> "Value | None":
        """The value of a key; None where the key is absent or null."""
        value = self.value.get(key) if isinstance(self.value, dict) else None
        return None if value is None else Value(self.context, (*self.path, key), value)

    def items(self) -> Iterator[tuple[str, "Value"]]:
        """Keys and values of a mapping, without `x-` keys; nothing for any other value."""
        if isinstance(self.value, dict):
            for key, value in self.value.items():
                if not key.startswith("x-"):
                    yield key, Value(self.context, (*self.path, key), value)

    def values(self) -> list["Value"]:
        """The values of a mapping, without `x-` keys; nothing for any other value."""
        return [node for _, node in self.items()]

    def elements(self) -> list["Value"]:
        """The values of a list; a single value counts as a list of one, null as an empty one."""
        if isinstance(self.value, list):
            return [Value(self.context, (*self.path, index), value) for index, value in enumerate(self.value)]
        return [] if self.value is None else [self]

    @property
    def is_mapping(self) -> bool:
        """Whether the value has keys."""
        return isinstance(self.value, dict)

    @property
    def is_list(self) -> bool:
        """Whether the value is a list."""
        return isinstance(self.value, list)

    @property
    def is_text(self) -> bool:
        """Whether the value is text."""
        return isinstance(self.value, str)

    @property
    def is_number(self) -> bool:
        """Whether the value is a number; true and false are none."""
        return isinstance(self.value, int | Decimal) and not isinstance(self.value, bool)

    def text(self) -> str:
        """The value as text; numbers and truth values are spelled as in YAML."""
        if isinstance(self.value, bool):
            return "true" if self.value else "false"
        if isinstance(self.value, str | int | Decimal):
            return str(self.value)
        return self._wrong("text", "")

    def number(self) -> Fraction:
        """The value as an exact number; true counts 1 and false 0."""
        if isinstance(self.value, int):
            return Fraction(self.value)
        if isinstance(self.value, Decimal):
            try:
                return exact(self.value)
            except ValueError:
                return self._wrong("a finite number", Fraction(0))
        return self._wrong("a number", Fraction(0))

    def whole(self) -> int:
        """The value as a whole number."""
        number = self.number()
        return number.numerator if number.denominator == 1 else self._wrong("a whole number", 0)

    def truth(self) -> bool:
        """The value as true or false."""
        return self.value if isinstance(self.value, bool) else self._wrong("true or false", other=False)

    def choice(self, otherwise: Choice) -> Choice:
        """The value as one of the choices of the enumeration that `otherwise` is of."""
        among = type(otherwise)
        try:
            return among(self.value)
        except ValueError:
            return self._wrong(f"one of {', '.join(among)}", otherwise)

    def key_whole(self) -> int:
        """The key as a whole number."""
        number = self.key_number()
        if number.denominator == 1:
            return number.numerator
        self.report(WRONG_SORT, f"the key {self.key} is no whole number", remedy="write a whole number", at_key=True)
        return 0

    def key_number(self) -> Fraction:
        """The key as an exact number."""
        if len(self.key) <= _LONGEST_NUMBER:
            try:
                return parse(self.key)
            except ValueError:
                pass
        self.report(WRONG_SORT, f"the key `{brief(self.key)}` is no number", remedy="write a number", at_key=True)
        return Fraction(0)

    _Other = TypeVar("_Other")

    def _wrong(self, wanted: str, other: _Other) -> _Other:
        kind = {dict: "a mapping", list: "a list", str: "a text", bool: "a truth value"}.get(
            type(self.value), "a number"
        )
        shown = "" if isinstance(self.value, dict | list) else f" ({brief(str(self.value))})"
        self.report(WRONG_SORT, f"`{self.key}` is {kind}{shown}, not {wanted}", remedy=f"write {wanted}")
        return other


def text_of(node: Value, key: str, otherwise: str = "") -> str:
    """The text of a key, or `otherwise` where it is absent."""
    child = node.child(key)
    return child.text().strip() if child else otherwise


def line_of(node: Value, key: str) -> str:
    """The text of a key on one line, empty where it is absent."""
    return " ".join(text_of(node, key).split())


def whole_of(node: Value, key: str, otherwise: int = 0) -> int:
    """The whole number of a key, or `otherwise` where it is absent."""
    child = node.child(key)
    return child.whole() if child else otherwise


def fraction_of(node: Value, key: str, otherwise: Fraction = ZERO) -> Fraction:
    """The exact number of a key, or `otherwise` where it is absent."""
    child = node.child(key)
    return child.number() if child else otherwise


def choice_of(node: Value, key: str, otherwise: Choice) -> Choice:
    """The choice of a key, or `otherwise` where it is absent."""
    child = node.child(key)
    return child.choice(otherwise) if child else otherwise


def truth_of(node: Value, key: str, *, otherwise: bool = False) -> bool:
    """The truth value of a key, or `otherwise` where it is absent."""
    child = node.child(key)
    return child.truth() if child else otherwise


def wholes_of(node: Value, key: str, otherwise: tuple[int, ...] = ()) -> tuple[int, ...]:
    """The list of whole numbers of a key, or `otherwise` where it is absent."""
    child = node.child(key)
    return tuple(element.whole() for element in child.elements()) if child else otherwise


def texts_of(node: Value, key: str, otherwise: tuple[str, ...] = ()) -> tuple[str, ...]:
    """The list of texts of a key, or `otherwise` where it is absent."""
    child = node.child(key)
    return tuple(element.text() for element in child.elements()) if child else otherwise


def elements_of(node: Value | None, key: str) -> list[Value]:
    """The elements of the list of a key; none where it is absent."""
    child = node.child(key) if node else None
    return child.elements() if child else []


def items_of(node: Value | None, key: str) -> list[tuple[str, Value]]:
    """The keys and values of the mapping of a key; none where it is absent."""
    child = node.child(key) if node else None
    return list(child.items()) if child else []
