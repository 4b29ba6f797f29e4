"""A value of the map together with its place, and the collector of what is wrong with the values."""

from dataclasses import dataclass, field
from decimal import Decimal
from enum import StrEnum
from fractions import Fraction
from typing import Any, TypeVar

from regscribe.lower.rules import WRONG_SORT
from regscribe.model import Diagnostic, Related, Span, exact, parse
from regscribe.source import Document, Path

Choice = TypeVar("Choice", bound=StrEnum)
Other = TypeVar("Other")

ZERO = Fraction(0)
_LONGEST_NUMBER = 100
_LONGEST_SHOWN = 60


def brief(text: str) -> str:
    """The text as it may stand in a message: on one line, printable, cut where it is long."""
    line = "".join(letter if letter.isprintable() else " " for letter in text[: _LONGEST_SHOWN + 1])
    return line if len(line) <= _LONGEST_SHOWN else f"{line[:_LONGEST_SHOWN]}…"


@dataclass(frozen=True, slots=True)
class Collector:
    """State of lowering one document, and the diagnostics found in it so far.

    Registers are lowered once for each model and element, so `found` keeps one diagnostic per rule and place.
    `sizes` are the numbers of registers of each set, `grown` those that sets put into each model. `defaults` are
    the mappings of defaults for several registers, by their paths, `used` the paths of all keys that have an effect on
    some register.
    """

    document: Document
    found: dict[tuple[str, Span], Diagnostic] = field(default_factory=dict)
    grown: dict[str, int] = field(default_factory=dict)
    sizes: dict[str, int] = field(default_factory=dict)
    defaults: dict[Path, "Value"] = field(default_factory=dict)
    used: set[Path] = field(default_factory=set)

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """What was found, in the order of the file."""
        return sorted(self.found.values(), key=lambda diagnostic: (diagnostic.span, diagnostic.rule))


class Keyed:
    """Readers of single keys, for a mapping of the document and for the merged keys of a register alike.

    Each gives what the key holds, or `otherwise` (nothing, for lists) where it is absent.
    """

    __slots__ = ()

    def child(self, key: str) -> "Value | None":
        """The value of a key; None where the key is absent or null."""
        raise NotImplementedError

    def text_of(self, key: str, otherwise: str = "") -> str:
        """Text of a key without blanks around it."""
        child = self.child(key)
        return child.text().strip() if child else otherwise

    def line_of(self, key: str) -> str:
        """Text of a key on one line."""
        return " ".join(self.text_of(key).split())

    def whole_of(self, key: str, otherwise: int = 0) -> int:
        """Whole number of a key."""
        child = self.child(key)
        return child.whole() if child else otherwise

    def fraction_of(self, key: str, otherwise: Fraction = ZERO) -> Fraction:
        """Exact number of a key."""
        child = self.child(key)
        return child.number() if child else otherwise

    def choice_of(self, key: str, otherwise: Choice) -> Choice:
        """Choice of a key, among those of the enumeration that `otherwise` is of."""
        child = self.child(key)
        return child.choice(otherwise) if child else otherwise

    def truth_of(self, key: str, *, otherwise: bool = False) -> bool:
        """Truth value of a key."""
        child = self.child(key)
        return child.truth() if child else otherwise

    def wholes_of(self, key: str, otherwise: tuple[int, ...] = ()) -> tuple[int, ...]:
        """Whole numbers in the list of a key."""
        child = self.child(key)
        return tuple(element.whole() for element in child.elements()) if child else otherwise

    def texts_of(self, key: str, otherwise: tuple[str, ...] = ()) -> tuple[str, ...]:
        """Texts in the list of a key."""
        child = self.child(key)
        return tuple(element.text() for element in child.elements()) if child else otherwise

    def elements_of(self, key: str) -> list["Value"]:
        """Elements of the list of a key."""
        child = self.child(key)
        return child.elements() if child else []

    def items_of(self, key: str) -> list[tuple[str, "Value"]]:
        """Keys and values of the mapping of a key."""
        child = self.child(key)
        return child.items() if child else []


@dataclass(frozen=True, slots=True)
class Value(Keyed):
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
        self,
        rule: str,
        message: str,
        *,
        remedy: str = "",
        at_key: bool = False,
        related: tuple[Related, ...] = (),
        replacement: str = "",
    ) -> None:
        """Report a mistake at this value (or at its key), unless the same rule spoke there already."""
        span = self.key_span if at_key else self.span
        said = Diagnostic(rule, message, span, help=remedy, related=related, replacement=replacement)
        self.context.found.setdefault((rule, span), said)

    def child(self, key: str) -> "Value | None":
        """The value of a key; None where the key is absent or null."""
        value = self.value.get(key) if isinstance(self.value, dict) else None
        return None if value is None else Value(self.context, (*self.path, key), value)

    def mapping_of(self, key: str) -> "Value":
        """The value of a key, an empty mapping where the key is absent or null."""
        return self.child(key) or Value(self.context, (*self.path, key), {})

    def items(self) -> list[tuple[str, "Value"]]:
        """Keys and values of a mapping, without `x-` keys; nothing for any other value."""
        if not isinstance(self.value, dict):
            return []
        return [
            (key, Value(self.context, (*self.path, key), value))
            for key, value in self.value.items()
            if not key.startswith("x-")
        ]

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
                return self._wrong("a finite number", ZERO)
        return self._wrong("a number", ZERO)

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
        return ZERO

    def _wrong(self, wanted: str, other: Other) -> Other:
        kinds = {dict: "a mapping", list: "a list", str: "a text", bool: "a truth value"}
        kind = kinds.get(type(self.value), "a number")
        shown = "" if isinstance(self.value, dict | list) else f" ({brief(str(self.value))})"
        self.report(WRONG_SORT, f"`{self.key}` is {kind}{shown}, not {wanted}", remedy=f"write {wanted}")
        return other
