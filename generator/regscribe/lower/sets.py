"""Sets of registers: which one a use names, and what of it is put there."""

from regscribe.lower.interval_text import whole_ends
from regscribe.lower.names import unknown
from regscribe.lower.node import Value, elements_of, text_of, texts_of
from regscribe.lower.rules import SET_IN_ITSELF, TOO_MANY_ELEMENTS, UNKNOWN_REGISTER, UNKNOWN_SET
from regscribe.model.identifiers import snake, unindexed

MOST = 65536
"""Registers that sets put into one model: there are no more addresses."""

DEEPEST = 16
"""Sets within sets."""

_REMEDY = "look for a set that is used often in a set that is used often"


def table_of(node: Value, sets: Value | None, around: tuple[str, ...]) -> Value | None:
    """The set that `node` names; RS0333 where there is none, RS0334 where it is one of those `around` it."""
    name = text_of(node, "set")
    at = node.child("set") or node
    table = sets.child(name) if sets else None
    if table is None:
        unknown(at, UNKNOWN_SET, "set", name, [key for key, _ in sets.items()] if sets else [])
        return None
    if name in around:
        message = f"the set contains itself: {' -> '.join((*around, name))}"
        at.report(SET_IN_ITSELF, message, remedy="put its registers into a set of their own, and use that twice")
        return None
    return table if _fits(node, sets) else None


def _fits(node: Value, sets: Value | None) -> bool:
    """Whether there are addresses enough for all that a set brings; RS0331 where not, before any of it is looked at."""
    if _size(text_of(node, "set"), sets, node.context.sizes, DEEPEST) <= MOST:
        return True
    message = f"the set brings more than {MOST} registers, or sets within sets more than {DEEPEST} deep"
    node.report(TOO_MANY_ELEMENTS, message, remedy=_REMEDY)
    return False


def _size(name: str, sets: Value | None, known: dict[str, int], depth: int) -> int:
    """How many registers a set has with all sets and arrays in it, `depth` sets deep at most."""
    if name not in known:
        if not depth:
            return MOST + 1
        known[name] = 0  # of a set that contains itself
        table = sets.child(name) if sets else None
        known[name] = _sum(table.elements() if table else [], sets, known, depth - 1)
    return known[name]


def _sum(nodes: list[Value], sets: Value | None, known: dict[str, int], depth: int) -> int:
    total = 0
    for node in nodes:
        if node.child("set"):
            total += _size(text_of(node, "set"), sets, known, depth)
        elif node.child("registers"):
            total += _repeats(node) * _sum(elements_of(node, "registers"), sets, known, depth)
        else:
            total += 1
    return total


def _repeats(node: Value) -> int:
    repeat = node.child("repeat")
    first, last = whole_ends(repeat) if repeat else (1, 1)
    return last - first + 1


def left_of(table: Value, node: Value, model: str) -> list[Value]:
    """The elements of a set but those that `except_ids` of `node` names.

    RS0301 for an id that the set does not have, RS0331 where sets have grown beyond all addresses.
    """
    ids = {_id(element): element for element in table.elements()}
    for left_out in elements_of(node, "except_ids"):
        if left_out.text() not in ids:
            unknown(left_out, UNKNOWN_REGISTER, "register", left_out.text(), ids, of=text_of(node, "set"))
    names = set(texts_of(node, "except_ids"))
    kept = [element for element in table.elements() if _id(element) not in names]
    if node.context.grow(model, len(kept)) <= MOST:
        return kept
    message = f"sets put more than {MOST} registers into {model}"
    node.report(TOO_MANY_ELEMENTS, message, remedy=_REMEDY)
    return []


def _id(node: Value) -> str:
    if node.child("set"):
        return ""
    return text_of(node, "id") or snake(unindexed(text_of(node, "name")))
