"""Pairs of things of two versions: by id, then by what they are where that is unique; never by a guess."""

from collections import defaultdict
from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")

Content = Callable[[T], Hashable]
"""What a thing is, whatever it is called; of the old version and of the new one alike."""


@dataclass(frozen=True, slots=True)
class Pairs(Generic[T]):
    """Things of both versions, and those of one alone; `uncertain` are of these, and may be the same or not."""

    both: tuple[tuple[T, T], ...]
    removed: tuple[T, ...]
    added: tuple[T, ...]
    uncertain: tuple[tuple[T, T], ...] = ()


def paired(
    olds: Sequence[T],
    news: Sequence[T],
    name: Callable[[T], Hashable],
    contents: Sequence[Content[T]],
    hint: Content[T] | None = None,
) -> Pairs[T]:
    """Pair by name, then by each of `contents` in turn where one thing of each version has it and no other.

    What `hint` says of both alike makes a pair uncertain.
    """
    known = {name(one): one for one in news}
    both = [(one, known[name(one)]) for one in olds if name(one) in known]
    removed = [one for one in olds if name(one) not in known]
    names = {name(one) for one in olds}
    added = [one for one in news if name(one) not in names]
    for content in contents:
        found = _unique(removed, added, content)
        both += found
        gone, come = {id(one) for one, _ in found}, {id(other) for _, other in found}
        removed = [one for one in removed if id(one) not in gone]
        added = [one for one in added if id(one) not in come]
    uncertain = _unique(removed, added, hint) if hint and removed and added else []
    return Pairs(tuple(both), tuple(removed), tuple(added), tuple(uncertain))


def _unique(olds: Sequence[T], news: Sequence[T], content: Content[T]) -> list[tuple[T, T]]:
    """Those that are alike, and like no other of either version."""
    if not olds or not news:
        return []
    found: defaultdict[Hashable, tuple[list[T], list[T]]] = defaultdict(lambda: ([], []))
    for side, things in enumerate((olds, news)):
        for one in things:
            found[content(one)][side].append(one)
    return [(one[0], other[0]) for one, other in found.values() if len(one) == len(other) == 1]
