"""Parsed values of several files as one tree: each value keeps the place that it came from. Trees are never mutated."""

from collections.abc import Callable, Iterable, Iterator, Mapping

from regscribe.model.identifiers import snake, unindexed
from regscribe.source import SourceNode, SourcePlace

Step = str | int
Location = tuple[Step, ...]
"""Keys and list indices from the top of the tree to a value."""

_OF_REGISTERS = frozenset({"when", "text", "with", "writes", "conditions"})
"""Below these keys stand names of registers, which may be called like any key."""


def mapping(
    members: Mapping[str, SourceNode], place: SourcePlace, keys: Mapping[str, SourcePlace] | None = None
) -> SourceNode:
    """A mapping of these values; a key without a place of its own stands where its value does."""
    places = {key: (keys or {}).get(key, member.place) for key, member in members.items()}
    return SourceNode({key: member.value for key, member in members.items()}, place, places, dict(members))


def listing(elements: Iterable[SourceNode], place: SourcePlace) -> SourceNode:
    """A list of these values."""
    every = list(elements)
    return SourceNode([element.value for element in every], place, elements=every)


def in_file(node: SourceNode, name: str) -> SourceNode:
    """The same tree, with the file's name at each place, which tells it from values of other files."""
    place = node.place._replace(file=name)
    if node.members is not None:
        keys = {key: where._replace(file=name) for key, where in (node.keys or {}).items()}
        return mapping({key: in_file(member, name) for key, member in node.members.items()}, place, keys)
    if node.elements is not None:
        return listing((in_file(element, name) for element in node.elements), place)
    return node._replace(place=place)


def members(node: SourceNode | None) -> dict[str, SourceNode]:
    """The values of a mapping by key, without `x-` keys; none of any other value."""
    every = (node.members if node else None) or {}
    return {key: member for key, member in every.items() if not key.startswith("x-")}


def elements(node: SourceNode | None) -> list[SourceNode]:
    """The elements of a list; none of any other value."""
    return (node.elements if node else None) or []


def branches(node: SourceNode) -> list[tuple[str, SourceNode]]:
    """The mappings and lists in a mapping, by key, without those whose keys name registers."""
    return [
        (key, member)
        for key, member in members(node).items()
        if key not in _OF_REGISTERS and (member.members is not None or member.elements is not None)
    ]


def key_place(node: SourceNode, key: str) -> SourcePlace:
    """Where a key stands; where there is none of that name, where the mapping does."""
    return (node.keys or {}).get(key, node.place)


def text(node: SourceNode | None) -> str:
    """A scalar as text; empty for none."""
    return "" if node is None or node.value is None else str(node.value)


def put(node: SourceNode, key: str, value: SourceNode, origin: SourceNode | None = None) -> SourceNode:
    """The mapping with another value under a key, which stands where it does in `origin` (or else in `node`).

    A new key comes last.
    """
    keys = {**(node.keys or {}), key: key_place(origin or node, key)}
    return mapping({**(node.members or {}), key: value}, node.place, keys)


def cut(node: SourceNode, *keys: str) -> SourceNode:
    """The mapping without some keys."""
    rest = {name: member for name, member in (node.members or {}).items() if name not in keys}
    return mapping(rest, node.place, node.keys)


def kept(node: SourceNode, key: str, keep: Callable[[SourceNode], bool]) -> SourceNode:
    """The mapping with those elements of a list that are to be kept; without the key where none is."""
    have = node.child(key)
    if have is None:
        return node
    left = [each for each in elements(have) if keep(each)]
    return put(node, key, listing(left, have.place)) if left else cut(node, key)


def at(node: SourceNode, location: Location) -> SourceNode | None:
    """The value at a location, if there is one."""
    found: SourceNode | None = node
    for step in location:
        found = found.child(step) if found else None
    return found


def edit(node: SourceNode, location: Location, change: Callable[[SourceNode], SourceNode | None]) -> SourceNode:
    """The tree with `change` applied to what stands at a location that exists; None removes it."""
    step, rest = location[0], location[1:]
    child = node.child(step)
    if child is None:
        return node
    new = edit(child, rest, change) if rest else change(child)
    if node.elements is not None:
        every = (new if place == step else element for place, element in enumerate(node.elements))
        return listing((element for element in every if element is not None), node.place)
    key = str(step)
    return cut(node, key) if new is None else put(node, key, new)


def remove(node: SourceNode, location: Location) -> SourceNode:
    """The tree without what stands at a location."""
    return edit(node, location, lambda _: None)


def id_of(node: SourceNode) -> str:
    """The id of a register, an array or a group: given, or made of its name."""
    return text(node.child("id")) or snake(unindexed(text(node.child("name"))))


def registers(root: SourceNode) -> Iterator[tuple[str, Location]]:
    """Every register and array of a map, in groups and in sets: its id with those of arrays around it, and where."""
    for number, group in enumerate(elements(root.child("groups"))):
        yield from _registers(group.child("registers"), ("groups", number, "registers"), "")
    for name, one in members(root.child("sets")).items():
        yield from _registers(one, ("sets", name), "")


def _registers(node: SourceNode | None, location: Location, prefix: str) -> Iterator[tuple[str, Location]]:
    for number, element in enumerate(elements(node)):
        if element.child("set"):
            continue
        name = f"{prefix}{id_of(element)}"
        yield name, (*location, number)
        yield from _registers(element.child("registers"), (*location, number, "registers"), f"{name}.")
