"""Groups of registers: what one model has of each, and their order for writing."""

from dataclasses import dataclass

from regscribe.lower.names import identifier, unknown
from regscribe.lower.node import Value, elements_of, text_of, whole_of
from regscribe.lower.rules import UNKNOWN_GROUP
from regscribe.lower.tree import Item, TreeNode, TreePosition, entries_of, items_in, span_of
from regscribe.lower.variants import Models
from regscribe.model import Group


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
