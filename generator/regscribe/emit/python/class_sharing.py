"""Sharing between the classes of several models: what some models have in common is declared once."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar


class _Item(Protocol):
    @property
    def id(self) -> str: ...


T = TypeVar("T", bound=_Item)


@dataclass(frozen=True, slots=True)
class Shared(Generic[T]):
    """Items that exactly `models` have, in their order, and the name of the class that declares them."""

    name: str
    models: tuple[str, ...]
    items: tuple[T, ...]


def suffix(models: Sequence[str]) -> str:
    """Model names as part of a class name."""
    return "".join("".join(c for c in model if c.isascii() and c.isalnum()) for model in models)


def partition(items: Mapping[str, Sequence[T]], name: Callable[[Sequence[str]], str]) -> list[Shared[T]]:
    """Split the items of all models into classes: each item stands in one, for exactly the models that have it.

    `name` gives the class of some models its name.
    """
    owners: dict[str, list[tuple[T, list[str]]]] = {}
    for model, own in items.items():
        for item in own:
            same_id = owners.setdefault(item.id, [])
            found = next((models for other, models in same_id if other == item), None)
            if found is None:
                same_id.append((item, [model]))
            else:
                found.append(model)
    groups: dict[tuple[str, ...], list[T]] = {}
    for same_id in owners.values():
        for item, models in same_id:
            groups.setdefault(tuple(models), []).append(item)
    return [Shared(name(models), models, tuple(own)) for models, own in groups.items()]
