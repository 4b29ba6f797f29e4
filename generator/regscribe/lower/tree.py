"""The registers and arrays that one model has, with their paths and the keys that count, before any meaning."""

from dataclasses import dataclass, replace

from regscribe.lower.interval_text import whole_ends
from regscribe.lower.names import identifier
from regscribe.lower.node import Value, elements_of, text_of, whole_of
from regscribe.lower.rules import ON_NO_MODEL, TOO_MANY_ELEMENTS
from regscribe.lower.sets import left_of, table_of
from regscribe.lower.variants import Keys, Models, present, settings_of, with_variants
from regscribe.model import Span

ADDRESSES = 65536


@dataclass(frozen=True, slots=True)
class TreePosition:
    """Where a list of registers stands on one model: inside which group, arrays and elements.

    `among` are the models that the surroundings exist on, `layers` the `each` defaults from the outside in, `prefixes`
    the paths of the surrounding elements from the inside out, `shift` the steps that the elements add to `at`.
    `over` are the keys that a use of a set lays over those of its registers; `sets` is the map's table of sets, `open`
    the names of the sets around.
    """

    model: str
    every: Models
    among: Models
    group: str
    section: str
    layers: tuple[Value, ...] = ()
    prefixes: tuple[str, ...] = ()
    array: str = ""
    index: tuple[int, ...] = ()
    shift: int = 0
    elements: int = 1
    over: tuple[Value, ...] = ()
    sets: Value | None = None
    open: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class TreeNode:
    """One register of one model (one element of an array): its names, and the keys that count for it."""

    node: Value
    id: str
    path: str
    settings: Keys
    place: TreePosition

    @property
    def span(self) -> Span:
        """Where its `id`, or else its name, stands."""
        return span_of(self.node)

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


Item = TreeNode | TreeBranch


def span_of(node: Value) -> Span:
    """Where the `id`, or else the name, or else the thing itself stands."""
    return (node.child("id") or node.child("name") or node).span


def items_in(nodes: list[Value], place: TreePosition) -> tuple[Item, ...]:
    """The registers and arrays of a list that the model of `place` has, those of sets among them."""
    items: list[Item] = []
    for node in nodes:
        if node.child("set"):
            items += _set(node, place)
            continue
        has = _models(node, place)
        name = identifier(node.child("name") or node, label=text_of(node, "name"), given=node.child("id"))
        if place.model in has and node.child("registers"):
            items.append(_branch(node, name, replace(place, among=has)))
        elif place.model in has:
            items.append(_entry(node, name, has, place))
    return tuple(items)


def _set(node: Value, place: TreePosition) -> tuple[Item, ...]:
    """The registers of the set that `node` puts here."""
    name, each = text_of(node, "set"), node.child("set_each")
    has = _models(node, place)
    table = table_of(node, place.sets, place.open)
    registers = left_of(table, node, place.model) if table and place.model in has else []
    inside = replace(
        place,
        among=has,
        shift=place.shift + whole_of(node, "shift"),
        over=(each, *place.over) if each else place.over,
        open=(*place.open, name),
    )
    return items_in(registers, inside)


def _models(node: Value, place: TreePosition) -> Models:
    """The models that a register, an array or a use of a set is on; RS0321 where they are none."""
    has = present(node, place.among, place.every)
    if not has and place.among:
        at = node.child("except") or node.child("models") or node
        message = f"`{text_of(node, 'name', text_of(node, 'set'))}` is on no model"
        at.report(ON_NO_MODEL, message, remedy=f"its surroundings are on: {', '.join(place.among)}")
    return has


def _entry(node: Value, name: str, has: Models, place: TreePosition) -> TreeNode:
    layers = [part for each in place.layers for part in with_variants(each, place.model, place.every, place.every)]
    settings = settings_of([*layers, *with_variants(node, place.model, has, place.every), *place.over])
    return TreeNode(node=node, id=name, path=_inside(place, name), settings=settings, place=place)


def _inside(place: TreePosition, name: str) -> str:
    return f"{place.prefixes[0]}{name}" if place.prefixes else name


def _branch(node: Value, name: str, place: TreePosition) -> TreeBranch:
    repeat = node.child("repeat")
    first, last = whole_ends(repeat) if repeat else (1, 1)
    count = (last - first + 1) * place.elements * len(elements_of(node, "registers"))
    if repeat and count > ADDRESSES:
        message = (
            f"{count} registers in {place.elements} x {last - first + 1} elements have no room in {ADDRESSES} addresses"
        )
        repeat.report(TOO_MANY_ELEMENTS, message, remedy="give the index of the first and the last element, as 1..8")
        last = first
    stride = whole_of(node, "stride", 1)
    each = node.child("each")
    inside = replace(
        place,
        layers=(*place.layers, each) if each else place.layers,
        section=_section(node, place),
        array=f"{place.array}.{name}" if place.array else name,
        elements=(last - first + 1) * place.elements,
    )
    elements = tuple(_element(node, name, inside, step, first) for step in range(last - first + 1))
    return TreeBranch(node=node, id=name, first=first, stride=stride, section=inside.section, elements=elements)


def _section(node: Value, place: TreePosition) -> str:
    """Where an array is described: as the use of its set says, else as it says itself, else as its surroundings do."""
    told = [text_of(each, "source") for each in place.over if each.child("source")]
    return told[-1] if told else text_of(node, "source", place.section)


def _element(node: Value, name: str, place: TreePosition, step: int, first: int) -> tuple[Item, ...]:
    prefix = f"{_inside(place, name)}[{first + step}]."
    inside = replace(
        place,
        prefixes=(prefix, *place.prefixes),
        index=(*place.index, first + step),
        shift=place.shift + whole_of(node, "stride", 1) * step,
    )
    return items_in(elements_of(node, "registers"), inside)


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
