"""Nested arrays as the picture of an array shows them: levels, elements that are drawn, addresses, offsets, steps."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from regscribe.emit.outline import Branch, Leaf, leaves
from regscribe.emit.words import LETTERS
from regscribe.model import Array, View

SHOWN = 3
"""Elements that are drawn before the gap, if there are more than one beyond them."""


@dataclass(frozen=True, slots=True)
class Level:
    """An array of the tree as its first model has it; those around it are shown at their first element."""

    branch: Branch

    @property
    def depth(self) -> int:
        """Return how many arrays it stands in."""
        return len(self.branch.arrays)

    @property
    def array(self) -> Array:
        """Return the array itself."""
        return self.branch.array.first

    @property
    def key(self) -> tuple[str, ...]:
        """Return the ids of this array and those it stands in, outermost first."""
        return tuple(array.id for array in (*self.branch.arrays, self.array))

    @property
    def letter(self) -> str:
        """Return the letter of its index in formulas."""
        return LETTERS[min(self.depth, len(LETTERS) - 1)]

    @property
    def path(self) -> str:
        """Return how a program names an element: `programs[1].segments[j]`."""
        outer = "".join(f"{array.id}[{array.first}]." for array in self.branch.arrays)
        return f"{outer}{self.array.id}[{self.letter}]"

    @property
    def gap(self) -> bool:
        """Whether elements are left out before the last one."""
        return self.array.count > SHOWN + 1

    @property
    def elements(self) -> tuple[int, ...]:
        """Return the elements that are drawn, counted from 0."""
        count = self.array.count
        return (*range(SHOWN), count - 1) if self.gap else tuple(range(count))

    def span(self, child: Leaf | Branch, element: int) -> tuple[int, int]:
        """Return the first and last address (in the base views) of a member in an element counted from 0."""
        ends = [_ends(leaf, self.depth, element) for leaf in leaves((child,))]
        return min(low for low, _ in ends), max(high for _, high in ends)

    @property
    def step(self) -> int | None:
        """Return by how many addresses the members move from one element to the next; None if not all alike."""
        bases = {(base.stride // base.space.each) for base in map(_base, leaves(self.branch.children))}
        steps = {stride * self.array.stride for stride in bases}
        return steps.pop() if len(steps) == 1 and self.array.count > 1 else None

    @property
    def start(self) -> int | None:
        """Return the first address of the first element if its members stand together, apart from other elements."""
        spans = [self.span(child, 0) for child in self.branch.children]
        low, high = min(first for first, _ in spans), max(last for _, last in spans)
        plain = not any(_base(leaf).space.part_bits for leaf in leaves(self.branch.children))
        together = plain and self.step is not None and high - low < self.step
        return low if together and len(spans) > 1 else None


def lettered_name(name: str) -> str:
    """Return the name of a member with the letters of its indices: `Prog. {i} cycles` as `Prog. i cycles`."""
    return re.sub(r"\{([ij])\}", r"\1", name)


def levels(branch: Branch) -> Iterator[Level]:
    """Yield an array and the arrays in it, outer ones first."""
    yield Level(branch)
    for child in branch.children:
        if isinstance(child, Branch):
            yield from levels(child)


def _base(leaf: Leaf) -> View:
    return leaf.register.first.base


def _ends(leaf: Leaf, depth: int, element: int) -> tuple[int, int]:
    """Return the span of a register over all elements of the arrays inside the one at `depth`."""
    base = _base(leaf)
    low = leaf.register.first.address + base.stride * leaf.arrays[depth].stride * element
    inner = sum(base.stride * array.stride * (array.count - 1) for array in leaf.arrays[depth + 1 :])
    return min(low, low + inner), max(low, low + inner) + base.words - 1
