"""Sets of registers: which one a use names, and what of it is put there."""

from regscribe.lower.node import Value
from regscribe.lower.repeats import indices
from regscribe.lower.rules import SET_IN_ITSELF, TOO_MANY_ELEMENTS, UNKNOWN_REGISTER, UNKNOWN_SET
from regscribe.lower.texts import known_name, unknown
from regscribe.model.identifiers import snake, unindexed

MOST = 65536
"""Registers that sets put into one model: there are no more addresses."""

DEEPEST = 16
"""Sets within sets."""

_REMEDY = "look for a set that is used often in a set that is used often"


def set_named(node: Value, sets: Value, around: tuple[str, ...]) -> Value | None:
    """The set that `node` names; None with RS0333 where there is none, RS0334 where it is one of those `around` it.

    RS0331 where there are not addresses enough for all that the set brings, before any of it is looked at.
    """
    name = node.text_of("set")
    at = node.child("set") or node
    table = sets.child(name)
    if table is None:
        unknown(at, UNKNOWN_SET, "set", name, [key for key, _ in sets.items()])
        return None
    if name in around:
        message = f"the set contains itself: {' -> '.join((*around, name))}"
        at.report(SET_IN_ITSELF, message, remedy="put its registers into a set of their own, and use that twice")
        return None
    if _size(name, sets, DEEPEST) > MOST:
        message = f"the set brings more than {MOST} registers, or sets within sets more than {DEEPEST} deep"
        node.report(TOO_MANY_ELEMENTS, message, remedy=_REMEDY)
        return None
    return table


def _size(name: str, sets: Value, depth: int) -> int:
    """How many registers a set has with all sets and arrays in it, `depth` sets deep at most."""
    sizes = sets.context.sizes
    if name not in sizes:
        if not depth:
            return MOST + 1
        sizes[name] = 0  # of a set that contains itself
        sizes[name] = _size_of_elements(sets.elements_of(name), sets, depth - 1)
    return sizes[name]


def _size_of_elements(nodes: list[Value], sets: Value, depth: int) -> int:
    total = 0
    for node in nodes:
        if node.child("set"):
            total += _size(node.text_of("set"), sets, depth)
        elif node.child("registers"):
            first, last = indices(node.child("repeat"))
            total += (last - first + 1) * _size_of_elements(node.elements_of("registers"), sets, depth)
        else:
            total += 1
    return total


def included_elements(table: Value, node: Value, model: str) -> list[Value]:
    """The elements of a set but those that `except_ids` of `node` names.

    RS0301 for an id that the set does not have, RS0331 where sets have grown beyond all addresses.
    """
    ids = dict.fromkeys(_id(element) for element in table.elements())
    set_name, left_out = node.text_of("set"), node.elements_of("except_ids")
    names = {known_name(each, UNKNOWN_REGISTER, "register", ids, of=set_name) for each in left_out}
    kept = [element for element in table.elements() if _id(element) not in names]
    grown = node.context.grown
    grown[model] = grown.get(model, 0) + len(kept)
    if grown[model] <= MOST:
        return kept
    message = f"sets put more than {MOST} registers into {model}"
    node.report(TOO_MANY_ELEMENTS, message, remedy=_REMEDY)
    return []


def _id(node: Value) -> str:
    if node.child("set"):
        return ""
    return node.text_of("id") or snake(unindexed(node.text_of("name")))
