"""Registers of arrays folded: those of all elements that differ in their addresses alone, by steps, are one entry."""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

from regscribe.export.device import Point
from regscribe.model.diagnostic import NOWHERE

LETTERS = "ijklmn"
INDEX = re.compile(r"\[\d+\]")
NUMBER = re.compile(r"\d+")


@dataclass(frozen=True, slots=True)
class Entry:
    """A register, or the same one of all elements of arrays; `point` is that of the first element.

    `spans` are the first and last index of each array around it and the step of addresses from one to the next,
    outermost first; empty: it stands for itself. `last` is the name of the last element's.
    """

    point: Point
    spans: tuple[tuple[int, int, int], ...] = ()
    last: str = ""

    @property
    def id(self) -> str:
        """Its name: without indexes where it stands for all elements."""
        if not self.spans:
            return self.point.id
        return INDEX.sub("", self.point.path).replace(".", "_")

    @property
    def arguments(self) -> str:
        """The arguments of its macro of the address: `(i, j)`; empty where it stands for itself."""
        return f"({', '.join(LETTERS[: len(self.spans)])})" if self.spans else ""

    def address(self, first: int) -> str:
        """The expression of the address of an element, `first` being that of the first one."""
        steps = (
            f" + {step}u * ((unsigned)({letter}) - {low}u)"
            for letter, (low, _, step) in zip(LETTERS, self.spans, strict=False)
        )
        return f"({first}u{''.join(steps)})" if self.spans else f"{first}u"


def entries(points: Sequence[Point]) -> Iterator[Entry]:
    """The points in their order, those of arrays folded at the place of the first element where that says the same."""
    alike: dict[str, list[Point]] = {}
    for point in points:
        alike.setdefault(INDEX.sub("[]", point.path), []).append(point)
    folded = {path: _folded(some) for path, some in alike.items()}
    for point in points:
        path = INDEX.sub("[]", point.path)
        found = folded[path]
        if found is None:
            yield Entry(point)
        elif point is alike[path][0]:
            yield found


def _folded(points: Sequence[Point]) -> Entry | None:
    """One entry for the registers of all elements; None where they differ in more than their places."""
    first = points[0]
    if len(points) == 1 or len({_said(point) for point in points}) > 1:
        return None
    by_index = {point.register.index: point for point in points}
    ends = [(min(column), max(column)) for column in zip(*by_index, strict=True)]
    if len(by_index) < len(points) or len(ends) > len(LETTERS):
        return None
    if set(by_index) != set(product(*(range(low, high + 1) for low, high in ends))):
        return None
    steps = [_step(by_index, place, ends) for place in range(len(ends))]
    for index, point in by_index.items():
        moved = sum(step * (at - low) for step, at, (low, _) in zip(steps, index, ends, strict=True))
        apart = 0 if point.write is None or first.write is None else point.write - first.write
        if point.address - first.address != moved or (point.write is not None and apart != moved):
            return None
    spans = tuple((low, high, step) for (low, high), step in zip(ends, steps, strict=True))
    return Entry(first, spans, points[-1].register.name)


def _step(by_index: dict[tuple[int, ...], Point], place: int, ends: list[tuple[int, int]]) -> int:
    start = tuple(low for low, _ in ends)
    second = (*start[:place], start[place] + 1, *start[place + 1 :])
    return by_index[second].address - by_index[start].address if second in by_index else 0


def _said(point: Point) -> object:
    """All that a point says beside its place and the numbers in its names."""
    one = point.register
    plain = replace(
        one,
        path="",
        at=0,
        index=(),
        aliases=(),
        default=None,
        delivered=None,
        default_cases=(),
        delivered_cases=(),
        rules=(),
        span=NOWHERE,
        views=(),
        range=(),
        valid=(),
        name=NUMBER.sub("#", one.name),
        symbol=NUMBER.sub("#", one.symbol),
        printed="",
        description=NUMBER.sub("#", one.description),
    )
    view = point.view._replace(offset=0)
    return repr(replace(point, register=plain, address=0, write=None if point.write is None else 0, view=view))
