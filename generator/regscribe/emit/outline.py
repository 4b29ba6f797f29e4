"""The registers of all models as one tree in the manual's order, arrays folded."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from regscribe.emit.common_values import Merged, merge
from regscribe.emit.words import LETTERS
from regscribe.model import Array, Model, Register, View

INDEX = re.compile(r"\[\d+\]")


@dataclass(frozen=True, slots=True)
class Leaf:
    """One register of the family, and the arrays that it is in, outermost first (their first elements are shown)."""

    register: Merged[Register]
    arrays: tuple[Array, ...] = ()

    @property
    def group(self) -> str:
        """The id of its group."""
        return self.register.first.group


@dataclass(frozen=True, slots=True)
class Branch:
    """An array with the registers and arrays of one element."""

    array: Merged[Array]
    arrays: tuple[Array, ...]
    children: tuple["Leaf | Branch", ...]

    @property
    def group(self) -> str:
        """The group of its first register."""
        return next((leaf.group for leaf in leaves(self.children)), "")


Node = Leaf | Branch


def pattern(path: str) -> str:
    """Return a path with its indices left out: `segments[].ramp_time` for every element."""
    return INDEX.sub("[]", path)


def lettered(path: str) -> str:
    """Return a path with letters for its indices: `segments[i].ramp_time`."""
    letters = iter(LETTERS)
    return INDEX.sub(lambda _: f"[{next(letters, 'n')}]", path)


def outline(models: Sequence[Model]) -> tuple[Node, ...]:
    """Merge the members of all models."""
    return _nodes(models, {model.name: model.members for model in models}, ())


def leaves(nodes: Iterable[Node]) -> Iterator[Leaf]:
    """Yield the registers of a tree in order."""
    for node in nodes:
        if isinstance(node, Leaf):
            yield node
        else:
            yield from leaves(node.children)


def _nodes(
    models: Sequence[Model], members: dict[str, tuple[Register | Array, ...]], arrays: tuple[Array, ...]
) -> tuple[Node, ...]:
    nodes: list[Node] = []
    for shared in merge(models, lambda model: members[model.name], _key):
        registers = tuple((model, item) for model, item in shared.versions if isinstance(item, Register))
        if registers:
            nodes.append(Leaf(Merged(shared.key, registers), arrays))
            continue
        versions = tuple((model, item) for model, item in shared.versions if isinstance(item, Array))
        inner = {model.name: array.members for model, array in versions}
        children = _nodes([model for model, _ in versions], inner, (*arrays, versions[0][1]))
        nodes.append(Branch(Merged(shared.key, versions), arrays, children))
    return tuple(nodes)


def _key(member: Register | Array) -> str:
    return pattern(member.path) if isinstance(member, Register) else f"array {member.id}"


def aliases(register: Register) -> tuple[View, ...]:
    """Return the base view as it stands at each further address."""
    base = register.base
    return tuple(base._replace(offset=base.offset + alias - register.address) for alias in register.aliases)


def formula(view: View, at: int, arrays: Sequence[Array]) -> str:
    """Return the address of any element: `8004 + 2*(i - 1)`; the plain address outside arrays."""
    terms = [view.space.spelled(view.address(at))]
    for array, letter in zip(arrays, LETTERS, strict=False):
        stride = view.stride * array.stride // view.space.each
        steps = f"({letter} {'-' if array.first > 0 else '+'} {abs(array.first)})" if array.first else letter
        terms.append(steps if stride == 1 else f"{stride}*{steps}")
    return " + ".join(terms)


def last_address(view: View, at: int, arrays: Sequence[Array]) -> int:
    """Return the address of the last element; the address itself outside arrays."""
    return view.address(at) + sum(view.stride * array.stride * (array.count - 1) for array in arrays)
