"""Computed values: numbers that follow from several registers."""

from regscribe.lower.conditions import condition_of
from regscribe.lower.node import Value
from regscribe.lower.register_values import ranges_at
from regscribe.lower.scope import Scope
from regscribe.lower.terms import term_of
from regscribe.lower.units import unit_of
from regscribe.model import Computed


def computed_of(root: Value, scope: Scope) -> tuple[Computed, ...]:
    """The computed values that a model has."""
    return tuple(_computed(node, scope) for _, node in root.items_of("computed") if scope.has(node))


def _computed(node: Value, scope: Scope) -> Computed:
    unit, _ = unit_of(node.child("unit"), scope)
    return Computed(
        id=node.key,
        name=node.line_of("name") or node.key,
        term=term_of(node.child("is"), scope),
        unit=unit[0].then,
        valid=ranges_at(node.child("valid"), scope),
        when=condition_of(node, scope),
        description=node.text_of("description"),
        section=node.text_of("source"),
        span=node.key_span,
    )
