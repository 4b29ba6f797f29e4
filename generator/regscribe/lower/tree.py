"""The registers and arrays that one model has, with their paths and the keys that count, before any meaning."""

from dataclasses import dataclass, replace
from typing import NamedTuple

from regscribe.lower.node import Value
from regscribe.lower.repeats import counter_of, goes_to_end, indices
from regscribe.lower.rules import ON_NO_MODEL, TOO_MANY_ELEMENTS
from regscribe.lower.sets import included_elements, set_named
from regscribe.lower.texts import identifier
from regscribe.lower.variants import Keys, Models, present, settings_of, with_variants
from regscribe.model import Span

ADDRESSES = 65536


class PlacedCondition(NamedTuple):
    """A `when`, and the paths of the elements around it from the inside out.

    With `least`, the node names instead what must be at least that, for an element of an array to exist.
    """

    node: Value
    prefixes: tuple[str, ...]
    least: int = 0


@dataclass(frozen=True, slots=True)
class TreePosition:
    """Where a list of registers stands on one model: inside which group, arrays and elements.

    `among` are the models that the surroundings exist on, `sets` is the map's table of sets, `layers` the `each`
    defaults from the outside in, `prefixes` the paths of the surrounding elements from the inside out, `shift` the
    steps that the elements add to `at`. `over` are the keys that a use of a set lays over those of its registers,
    `open` the names of the sets around, `block` the block that addresses count from. `whens` are the conditions of the
    surroundings, each with the paths of the elements around it.
    """

    model: str
    every: Models
    among: Models
    group: str
    section: str
    sets: Value
    layers: tuple[Value, ...] = ()
    prefixes: tuple[str, ...] = ()
    array: str = ""
    index: tuple[int, ...] = ()
    shift: int = 0
    elements: int = 1
    over: tuple[Value, ...] = ()
    open: tuple[str, ...] = ()
    block: str = ""
    page: int = 0
    whens: tuple["PlacedCondition", ...] = ()

    def under(self, node: Value) -> tuple["PlacedCondition", ...]:
        """The conditions here, with that of `node`."""
        when = node.child("when")
        return (*self.whens, PlacedCondition(when, self.prefixes)) if when else self.whens

    def path(self, name: str) -> str:
        """The path of a register or array of this name."""
        return f"{self.prefixes[0]}{name}" if self.prefixes else name


@dataclass(frozen=True, slots=True)
class TreeNode:
    """One register of one model (one element of an array): its names, and the keys that count for it.

    It exists while all of `whens` hold.
    """

    node: Value
    id: str
    path: str
    settings: Keys
    place: TreePosition
    whens: tuple[PlacedCondition, ...] = ()

    @property
    def qualified_id(self) -> str:
        """The id with the arrays around it, which tells it from registers of the same id in other arrays."""
        return "_".join((*self.place.array.split("."), self.id)) if self.place.array else self.id


@dataclass(frozen=True, slots=True)
class TreeBranch:
    """An array of one model: what each element holds."""

    node: Value
    id: str
    first: int
    stride: int
    section: str
    elements: tuple[tuple["Item", ...], ...]
    to_end: bool = False
    counted: PlacedCondition | None = None
    block: str = ""


Item = TreeNode | TreeBranch


def span_of(node: Value) -> Span:
    """Where the `id`, or else the name, or else the thing itself stands."""
    return (node.child("id") or node.child("name") or node).span


def name_of(node: Value) -> str:
    """The id of a register, an array or a group: given, or made of its name; RS0317 where there is none."""
    return identifier(node.child("name") or node, label=node.text_of("name"), given=node.child("id"))


def items_in(nodes: list[Value], place: TreePosition) -> tuple[Item, ...]:
    """The registers and arrays of a list that the model of `place` has, those of sets among them."""
    items: list[Item] = []
    for node in nodes:
        if node.child("set"):
            items += _set(node, place)
            continue
        has = _models(node, place)
        name = name_of(node)
        if place.model in has and node.child("registers"):
            items.append(_branch(node, name, replace(place, among=has)))
        elif place.model in has:
            items.append(_register(node, name, has, place))
    return tuple(items)


def _set(node: Value, place: TreePosition) -> tuple[Item, ...]:
    """The registers of the set that `node` puts here."""
    each = node.child("set_each")
    has = _models(node, place)
    table = set_named(node, place.sets, place.open)
    registers = included_elements(table, node, place.model) if table and place.model in has else []
    inside = replace(
        place,
        among=has,
        shift=place.shift + node.whole_of("shift"),
        over=(each, *place.over) if each else place.over,
        open=(*place.open, node.text_of("set")),
        whens=place.under(node),
    )
    return items_in(registers, inside)


def _models(node: Value, place: TreePosition) -> Models:
    """The models that a register, an array or a use of a set is on; RS0321 where they are none."""
    has = present(node, place.among, place.every)
    if not has and place.among:
        at = node.child("except") or node.child("models") or node
        message = f"`{node.text_of('name', node.text_of('set'))}` is on no model"
        at.report(ON_NO_MODEL, message, remedy=f"its surroundings are on: {', '.join(place.among)}")
    return has


def _register(node: Value, name: str, has: Models, place: TreePosition) -> TreeNode:
    parts = [with_variants(each, place.model, place.every, place.every) for each in place.layers]
    parts += [with_variants(node, place.model, has, place.every), *([over] for over in place.over)]
    settings = settings_of([layer for part in parts for layer in part])
    own: tuple[PlacedCondition, ...] = ()
    if settings.pop("when", None):  # each counts, none takes the place of another
        found = (settings_of(part).get("when") for part in parts)
        own = tuple(PlacedCondition(when, place.prefixes) for when in found if when)
    return TreeNode(node, name, place.path(name), settings, place, (*place.whens, *own))


def _branch(node: Value, name: str, place: TreePosition) -> TreeBranch:
    repeat = node.child("repeat")
    first, last = indices(repeat)
    elements = node.elements_of("registers")
    count = (last - first + 1) * place.elements * len(elements)
    if repeat and count > ADDRESSES:
        message = (
            f"{count} registers in {place.elements} x {last - first + 1} elements have no room in {ADDRESSES} addresses"
        )
        repeat.report(TOO_MANY_ELEMENTS, message, remedy="give the index of the first and the last element, as 1..8")
        last = first
    stride, each = node.whole_of("stride", 1), node.child("each")
    sources = [over.text_of("source") for over in place.over if over.child("source")]
    inside = replace(
        place,
        layers=(*place.layers, each) if each else place.layers,
        whens=place.under(node),
        section=sources[-1] if sources else node.text_of("source", place.section),
        array=f"{place.array}.{name}" if place.array else name,
        elements=(last - first + 1) * place.elements,
    )
    branches = []
    counted = counter_of(repeat)
    for index in range(first, last + 1):
        least = (PlacedCondition(counted, place.prefixes, index - first + 1),) if counted else ()
        element = replace(
            inside,
            whens=(*inside.whens, *least),
            prefixes=(f"{place.path(name)}[{index}].", *place.prefixes),
            index=(*place.index, index),
            shift=place.shift + stride * (index - first),
        )
        branches.append(items_in(elements, element))
    to_end = goes_to_end(repeat, place.block, nested=bool(place.array))
    around = PlacedCondition(counted, place.prefixes) if counted else None
    return TreeBranch(node, name, first, stride, inside.section, tuple(branches), to_end, around, place.block)


def entries_of(items: tuple[Item, ...]) -> list[TreeNode]:
    """The registers of all elements, in order."""
    entries: list[TreeNode] = []
    for item in items:
        if isinstance(item, TreeNode):
            entries.append(item)
        else:
            for element in item.elements:
                entries.extend(entries_of(element))
    return entries
