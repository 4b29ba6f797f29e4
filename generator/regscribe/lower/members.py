"""What one model has: its groups in their order for writing, its registers, and arrays both folded and expanded."""

from dataclasses import dataclass

from regscribe.lower.names import identifier, unknown
from regscribe.lower.node import Value, elements_of, text_of, whole_of
from regscribe.lower.registers import folded, register_of
from regscribe.lower.rules import UNKNOWN_GROUP
from regscribe.lower.scope import Scope
from regscribe.lower.tree import Item, TreeBranch, TreeNode, TreePosition, entries_of, items_in, span_of
from regscribe.lower.variants import Models
from regscribe.model import Array, Group, Register


@dataclass(frozen=True, slots=True)
class Bundle:
    """One group in the map, with what one model has of it."""

    node: Value
    id: str
    items: tuple[Item, ...]

    @property
    def entries(self) -> list[TreeNode]:
        """Its registers, arrays expanded."""
        return entries_of(self.items)


def bundles_of(root: Value, model: str, models: Models) -> list[Bundle]:
    """The groups of the map with the registers that `model` has, in the manual's order."""
    return [_bundle(node, root, model, models) for node in elements_of(root, "groups")]


def _bundle(node: Value, root: Value, model: str, models: Models) -> Bundle:
    name = identifier(node.child("name") or node, label=text_of(node, "name"), given=node.child("id"))
    each = node.child("each")
    place = TreePosition(
        model=model,
        every=models,
        among=models,
        group=name,
        section=text_of(node, "source"),
        layers=(each,) if each else (),
        sets=root.child("sets"),
    )
    return Bundle(node, name, items_in(elements_of(node, "registers"), place))


def groups_of(bundles: list[Bundle], root: Value) -> tuple[Group, ...]:
    """The groups that a model has something of; a group that is empty in the map itself is kept for the checks."""
    places = _write_order(root, [bundle.id for bundle in bundles])
    kept = [bundle for bundle in bundles if bundle.entries or not elements_of(bundle.node, "registers")]
    return tuple(_group(bundle, places.get(bundle.id)) for bundle in kept)


def _write_order(root: Value, known: list[str]) -> dict[str, int]:
    """The place of each group that the map's `write_order` lists, from 1; RS0332 for unknown groups."""
    places: dict[str, int] = {}
    for place, node in enumerate(elements_of(root, "write_order"), start=1):
        if node.text() not in known:
            unknown(node, UNKNOWN_GROUP, "group", node.text(), known)
        places.setdefault(node.text(), place)
    return places


def _group(bundle: Bundle, place: int | None) -> Group:
    node = bundle.node
    return Group(
        id=bundle.id,
        name=text_of(node, "name", bundle.id),
        members=tuple(entry.path for entry in bundle.entries),
        description=text_of(node, "description"),
        section=text_of(node, "source"),
        order=whole_of(node, "order") if node.child("order") else place,
        span=span_of(node),
    )


def members_of(items: tuple[Item, ...], scope: Scope) -> tuple[tuple[Register | Array, ...], tuple[Register, ...]]:
    """The members with arrays folded, and all registers with arrays expanded."""
    members: list[Register | Array] = []
    registers: list[Register] = []
    for item in items:
        made = [register_of(entry, scope) for entry in entries_of((item,))]
        members += made if isinstance(item, TreeNode) else [_array(item, scope)]
        registers += made
    return tuple(members), tuple(registers)


def _array(branch: TreeBranch, scope: Scope) -> Array:
    return Array(
        id=branch.id,
        name=text_of(branch.node, "name", branch.id),
        first=branch.first,
        count=len(branch.elements),
        stride=branch.stride,
        members=tuple(
            folded(one, scope) if isinstance(one, TreeNode) else _array(one, scope) for one in branch.elements[0]
        ),
        description=text_of(branch.node, "description"),
        section=branch.section,
        span=span_of(branch.node),
    )
