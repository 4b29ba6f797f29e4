"""Tables of facts: which fields of a thing are compared together, under which rule, and how a difference is judged."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

from regscribe.breaking.change import TEXT_ONLY, Difference, Effect, Effects
from regscribe.breaking.field_roles import UNCOMPARED
from regscribe.breaking.plain import field_names, plain, plain_field, renamed_field
from regscribe.breaking.renames import SAME_NAMES, Renames
from regscribe.breaking.rules import TEXT
from regscribe.emit.words import Wording, condition_words, one_line
from regscribe.model import Condition, Rule, show
from regscribe_runtime.values.numbers import Number, brief

T = TypeVar("T")

N, C, H, B = Effect.NONE, Effect.COMPATIBLE, Effect.BEHAVIOURAL, Effect.BREAKING
"""The effects as the tables spell them: none, compatible, behavioural, breaking."""

Judge = Callable[[T, T], tuple[Rule, Effects]]
"""Says under which rule a difference between two things falls, and what it does."""

EXACT = Wording(condition=condition_words)
"""Words that say the tests of a condition, whatever its name is."""


def judged(rule: Rule, wire: Effect, api: Effect) -> Judge[object]:
    """A judge that always says the same."""
    return lambda _, __: (rule, Effects(wire, api))


@dataclass(frozen=True, slots=True)
class Fact(Generic[T]):
    """Fields that make one fact, what it is called, its words, and who judges a difference."""

    fields: tuple[str, ...]
    what: str
    judge: Judge[T]
    words: Callable[[T], str] = field(default=lambda _: "")

    def states(self, thing: T, renames: Renames, *, texts: bool) -> tuple[object, ...]:
        """The fact as plain values."""
        return tuple(plain_field(thing, name, renames, texts=texts) for name in self.fields)

    def told(self, thing: T) -> str:
        """The fact in words, which no two different ones should share."""
        return self.words(thing) or ", ".join(shown(getattr(thing, name)) for name in self.fields)


def text(name: str, what: str = "") -> Fact[Any]:
    """A fact that only readers see."""
    return Fact((name,), what or name, lambda _, __: (TEXT, TEXT_ONLY), lambda thing: _quoted(getattr(thing, name)))


def _quoted(value: object) -> str:
    """A text in quotes, so that it does not read as a part of the sentence; nothing for what is no text."""
    return f'"{one_line(value)}"' if isinstance(value, str) and value else ""


def compared(facts: Sequence[Fact[T]], old: T, new: T, renames: Renames = SAME_NAMES) -> Iterator[Difference]:
    """The facts that differ between two versions of a thing."""
    for fact in facts:
        found = _compared(fact, old, new, renames)
        if found:
            yield found


def _compared(fact: Fact[T], old: T, new: T, renames: Renames) -> Difference | None:
    rule, effects = fact.judge(old, new)
    only_texts = rule is TEXT
    if fact.states(old, renames, texts=only_texts) != fact.states(new, renames.now, texts=only_texts):
        return Difference(rule, fact.what, effects, *_words(fact, old, new, renames))
    if fact.states(old, renames, texts=True) != fact.states(new, renames.now, texts=True):
        return Difference(TEXT, f"text of {fact.what}", TEXT_ONLY, *_words(fact, old, new, renames))
    return None


def _words(fact: Fact[T], old: T, new: T, renames: Renames) -> tuple[str, str]:
    """Words of both versions; of what has no words of its own, or the same ones, the first part that differs."""
    if fact.words(old) != fact.words(new):
        return fact.told(old), fact.told(new)
    for name in fact.fields:
        one, other = renamed_field(old, name, renames), getattr(new, name)
        if plain(one, renames, texts=True) != plain(other, renames.now, texts=True):
            return first_difference(one, other, renames)
    return fact.told(old), fact.told(new)


def first_difference(old: object, new: object, renames: Renames = SAME_NAMES, where: str = "") -> tuple[str, str]:
    """The first part that differs, with the way to it: `outputs[0].pid.band timer` and `outputs[0].pid.band level`."""
    for way, one, other in _parts(old, new, renames, where):
        if plain(one, renames, texts=True) != plain(other, renames.now, texts=True):
            return first_difference(one, other, renames, way)
    before, after = shown(old), shown(new)
    if before == after:
        before, after = brief(old), brief(new)
    return f"{where} {before}".strip(), f"{where} {after}".strip()


def _parts(old: object, new: object, renames: Renames, where: str) -> Iterator[tuple[str, object, object]]:
    """The parts of two alike values, each with the way to it."""
    if type(old) is not type(new):
        return
    for name in field_names(old):
        if name not in UNCOMPARED:
            yield f"{where}.{name}" if where else name, renamed_field(old, name, renames), getattr(new, name)
    if isinstance(old, tuple) and isinstance(new, tuple) and type(old) is tuple and len(old) == len(new):
        deep = where and any(field_names(one) for one in old)
        for place, (one, other) in enumerate(zip(old, new, strict=True)):
            yield f"{where}[{place}]" if deep else where, one, other


def shown(value: object) -> str:
    """A value of the model in a few words: numbers as decimals, lists with commas, nothing as `none`."""
    if value in EMPTY:
        return "none"
    if isinstance(value, Condition):
        return condition_words(value)
    if isinstance(value, str):
        return one_line(value)
    if isinstance(value, Number):
        return show(value) if not isinstance(value, bool) else "yes" if value else "no"
    names = [name for name in field_names(value) if name not in UNCOMPARED]
    if names:
        return " ".join(f"{name} {shown(getattr(value, name))}" for name in names if _says(value, name))
    return ", ".join(map(shown, value)) if isinstance(value, tuple) else str(value)


EMPTY = (None, (), "")
"""What says nothing."""


def _says(value: object, name: str) -> bool:
    found = getattr(value, name)
    return found is not False and found not in EMPTY
