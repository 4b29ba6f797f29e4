"""What several models have in common: each thing once, with the models that differ."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from regscribe.model import Model

T = TypeVar("T")
U = TypeVar("U")


@dataclass(frozen=True, slots=True)
class Stated(Generic[T]):
    """A fact with the models of which it is true; no models: of all that are asked."""

    models: tuple[str, ...]
    value: T


@dataclass(frozen=True, slots=True)
class Merged(Generic[T]):
    """One thing of a family: its key and what each model that has it makes of it, in the order of the models."""

    key: str
    versions: tuple[tuple[Model, T], ...]

    @property
    def first(self) -> T:
        """Return what the first model that has it makes of it."""
        return self.versions[0][1]

    @property
    def models(self) -> tuple[str, ...]:
        """Return the names of the models that have it."""
        return tuple(model.name for model, _ in self.versions)

    def states(self, fact: Callable[[Model, T], U]) -> tuple[Stated[U], ...]:
        """Return the fact once for all models that agree; no model names where all do."""
        if len(self.versions) == 1:
            return (Stated((), fact(*self.versions[0])),)
        found = models_by((model.name, fact(model, version)) for model, version in self.versions)
        if len(found) == 1:
            return (Stated((), next(iter(found))),)
        return tuple(Stated(tuple(names), value) for value, names in found.items())


def models_by(pairs: Iterable[tuple[str, T]]) -> dict[T, list[str]]:
    """Return each value of pairs of a model's name and a value once, with the names of the models that have it."""
    found: dict[T, list[str]] = {}
    for model, value in pairs:
        found.setdefault(value, []).append(model)
    return found


def merge(models: Sequence[Model], parts: Callable[[Model], Iterable[T]], key: Callable[[T], str]) -> list[Merged[T]]:
    """Merge the parts of all models by key, in the order of the first model; others stand after their predecessor."""
    versions: dict[str, list[tuple[Model, T]]] = {}
    order: list[str] = []
    for model in models:
        order = _insert(order, _collect(model, parts(model), key, versions))
    return [Merged(name, tuple(versions[name])) for name in order]


def _collect(
    model: Model, parts: Iterable[T], key: Callable[[T], str], versions: dict[str, list[tuple[Model, T]]]
) -> list[str]:
    names: list[str] = []
    for part in parts:
        name = key(part)
        versions.setdefault(name, []).append((model, part))
        names.append(name)
    return names


def _insert(order: list[str], names: list[str]) -> list[str]:
    """Add the names that are new, each after the name before it."""
    known = set(order)
    after: dict[str, list[str]] = {}
    place = ""
    for name in names:
        if name in known:
            place = name
        else:
            after.setdefault(place, []).append(name)
    merged = list(after.get("", ()))
    for name in order:
        merged += [name, *after.get(name, ())]
    return merged
