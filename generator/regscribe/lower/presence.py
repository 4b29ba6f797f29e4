"""Which models have a thing: the keys `models` and `except`."""

from regscribe.lower.names import unknown
from regscribe.lower.node import Value, elements_of
from regscribe.lower.rules import UNKNOWN_MODEL

Models = tuple[str, ...]


def present(node: Value, among: Models, every: Models) -> Models:
    """The models of `among` that a register, array, command, member or field is on; RS0314 for names of no model."""
    only = node.child("models")
    listed = named_models(only.elements(), every) if only else among
    left_out = named_models(elements_of(node, "except"), every)
    return tuple(model for model in among if model in listed and model not in left_out)


def named_models(nodes: list[Value], every: Models) -> Models:
    """The models that a list names; RS0314 for names of no model."""
    for node in nodes:
        if node.text() not in every:
            unknown(node, UNKNOWN_MODEL, "model", node.text(), every)
    return tuple(node.text() for node in nodes if node.text() in every)
