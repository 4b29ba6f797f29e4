"""Merges what several models have: each thing once, with the models that differ."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from regscribe.model import Model

T = TypeVar("T")
U = TypeVar("U")


@dataclass(frozen=True, slots=True)
class Stated(Generic[T]):
    """A fact with the names of the models that it is true of; none: of all models in question."""

    models: tuple[str, ...]
    value: T


@dataclass(frozen=True, slots=True)
class Merged(Generic[T]):
    """One thing of a family: its key and its version in each model that has it, in the order of the models."""

    key: str
    versions: tuple[tuple[Model, T], ...]

    @property
    def first(self) -> T:
        """The version of the first model that has it."""
        return self.versions[0][1]

    @property
    def models(self) -> tuple[str, ...]:
        """The names of the models that have it."""
        return tuple(model.name for model, _ in self.versions)

    def states(self, fact: Callable[[Model, T], U]) -> tuple[Stated[U], ...]:
        """Return the fact once for all models that agree; no model names where all do."""
        found = models_by((model.name, fact(model, version)) for model, version in self.versions)
        return tuple(Stated(tuple(names) if len(found) > 1 else (), value) for value, names in found.items())


def models_by(pairs: Iterable[tuple[str, T]]) -> dict[T, list[str]]:
    """Return each value of pairs of a model's name and a value once, with the names of the models that have it."""
    found: dict[T, list[str]] = {}
    for model, value in pairs:
        found.setdefault(value, []).append(model)
    return found


def merge(models: Sequence[Model], parts: Callable[[Model], Iterable[T]], key: Callable[[T], str]) -> list[Merged[T]]:
    """Merge the parts of all models by key, in the order of the first model; others stand after their predecessor."""
    versions: dict[str, list[tuple[Model, T]]] = {}
    orders: list[list[str]] = []
    for model in models:
        keyed = [(key(part), part) for part in parts(model)]
        orders.append([name for name, _ in keyed])
        for name, part in keyed:
            versions.setdefault(name, []).append((model, part))
    return [Merged(name, tuple(versions[name])) for name in merged_order(orders)]


def merged_order(orders: Iterable[Iterable[str]]) -> list[str]:
    """Return the names of several orders in one, each new name after the one that it follows in its own order."""
    merged: list[str] = []
    for order in orders:
        known = set(merged)
        following: dict[str, dict[str, None]] = {}
        place = ""
        for name in order:
            if name in known:
                place = name
            else:
                following.setdefault(place, {})[name] = None
        merged = [*following.get("", ()), *(new for name in merged for new in (name, *following.get(name, ())))]
    return merged
