"""What no register refers to is looked at all the same, or its mistakes would wait for its first use."""

from regscribe.lower.conditions import condition
from regscribe.lower.enums import enum_at
from regscribe.lower.node import Value, items_of
from regscribe.lower.scales import rule_at, scale_at
from regscribe.lower.scope import Scope
from regscribe.lower.units import cases_at
from regscribe.lower.views import Home, set_at
from regscribe.model import Space, WireType


def look_at_tables(root: Value, scope: Scope) -> None:
    """Lower every named thing of the map for one model and forget it; the mistakes stay in the context.

    What a library or a base declares may be for other maps: there only what is used counts.
    """
    for _, node in _own(root, "conditions"):
        condition(node, scope)
    for name, node in _own(root, "enums"):
        enum_at(node, scope, name)
    for _, node in _own(root, "views"):
        set_at(node, Home(Space.HOLDING, length=1), scope)
    for _, node in _own(root, "decimals"):
        rule_at(node, scope)
    for _, node in _own(root, "scales"):
        scale_at(node, WireType.INT16, scope)
    for _, node in _own(root, "units"):
        if node.is_list:
            cases_at(node, scope)


def _own(root: Value, table: str) -> list[tuple[str, Value]]:
    return [(name, node) for name, node in items_of(root, table) if node.span.file == root.context.document.name]
