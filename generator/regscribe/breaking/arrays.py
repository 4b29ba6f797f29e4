"""Arrays of two versions: their shape, and where their registers stand whatever the shape is."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from regscribe.breaking.change import Difference, Effects
from regscribe.breaking.facts import B, C, Fact, H, N, compared, judged, text
from regscribe.breaking.renames import Renames
from regscribe.breaking.rules import ARRAY
from regscribe.model import Array, Model, Register, Rule

Arrays = Mapping[str, Array]
"""Arrays by id, those in others with dots: `programs.segments`."""


class Shaped(NamedTuple):
    """A difference between the shapes of an array, in both versions."""

    id: str
    old: Array
    new: Array
    difference: Difference


def arrays_of(model: Model) -> dict[str, Array]:
    """All arrays of a model."""
    return dict(_arrays(model.members, ""))


def _arrays(members: tuple[Register | Array, ...], prefix: str) -> Iterator[tuple[str, Array]]:
    for one in members:
        if isinstance(one, Array):
            yield f"{prefix}{one.id}", one
            yield from _arrays(one.members, f"{prefix}{one.id}.")


def home(register: Register, arrays: Arrays) -> int:
    """The `at` of a register in the first elements of the arrays that it is in."""
    at, names = register.at, register.array.split(".") if register.array else []
    for depth, index in enumerate(register.index, start=1):
        array = arrays[".".join(names[:depth])]
        at -= (index - array.first) * array.stride
    return at


def _count(old: Array, new: Array) -> tuple[Rule, Effects]:
    return ARRAY, Effects(C, C) if new.count > old.count else Effects(B, B)


FACTS: tuple[Fact[Array], ...] = (
    Fact(("first",), "first index", judged(ARRAY, N, B), lambda one: str(one.first)),
    Fact(("count",), "number of elements", _count, lambda one: f"{one.count} elements"),
    Fact(("stride",), "stride", judged(ARRAY, B, N), lambda one: f"{one.stride} steps"),
    Fact(("to_end", "counted", "packed"), "how many elements there are", judged(ARRAY, H, H)),
    text("name", "name of the array"),
    text("description", "description of the array"),
    text("section", "section of the array"),
)
"""Facts of an array; `id` pairs them, `members` are compared as registers."""


def shapes(old: Arrays, new: Arrays, renames: Renames) -> Iterator[Shaped]:
    """What differs between the arrays that both versions have."""
    for name, array in old.items():
        if name in new:
            for found in compared(FACTS, array, new[name], renames):
                yield Shaped(name, array, new[name], found)
