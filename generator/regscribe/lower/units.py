"""Engineering units: those known to everybody, the map's own, and units that change with a condition."""

from regscribe.lower.conditions import condition
from regscribe.lower.names import unknown
from regscribe.lower.node import Value, items_of
from regscribe.lower.rules import UNKNOWN_UNIT
from regscribe.lower.scope import Scope
from regscribe.model import Case, Cases, always

KNOWN = (
    *("°C", "°F", "K", "%", "s", "ms", "min", "h", "d", "V", "mV", "A", "mA", "Ω", "Hz", "kHz", "bar", "mbar", "Pa"),
    *("kPa", "psi", "m", "mm", "m/s", "rpm", "W", "kW", "Wh", "kWh", "VA", "var", "baud", "0.1 s", "0.01 s", "words"),
)
"""Unit symbols that a map may use without declaring them."""


def own_symbols(root: Value) -> tuple[str, ...]:
    """The plain unit symbols that a map declares."""
    return tuple(name for name, node in items_of(root, "units") if not node.is_list)


def unit_of(node: Value | None, scope: Scope) -> tuple[Cases[str], str]:
    """The unit symbol by case, and the id where the map names a unit with cases; RS0311 for an unknown one."""
    if node is None:
        return always(""), ""
    name = node.text()
    for key, cases in items_of(scope.map, "units"):
        if key == name and cases.is_list:
            return cases_at(cases, scope), name
    return always(_symbol(node, scope)), ""


def cases_at(node: Value, scope: Scope) -> Cases[str]:
    """The cases of the unit that stands at `node`."""
    return scope.once(node.path, lambda: tuple(_case(case, scope) for case in node.elements()))


def _case(node: Value, scope: Scope) -> Case[str]:
    symbol = node.child("symbol")
    return Case(condition(node.child("when"), scope), _symbol(symbol, scope, cases=False) if symbol else "")


def _symbol(node: Value, scope: Scope, *, cases: bool = True) -> str:
    own = own_symbols(scope.map) if node.text() not in KNOWN else ()
    if node.text() and node.text() not in (*KNOWN, *own):
        by_case = [name for name, each in items_of(scope.map, "units") if each.is_list] if cases else []
        unknown(node, UNKNOWN_UNIT, "unit", node.text(), [*by_case, *own, *KNOWN])
    return node.text()


def rescaled(node: Value, scope: Scope) -> str:
    """The unit with cases whose registers the device converts; RS0311 where the map has none of that name."""
    by_case = [name for name, each in items_of(scope.map, "units") if each.is_list]
    if node.text() not in by_case:
        unknown(node, UNKNOWN_UNIT, "unit with cases", node.text(), by_case)
    return node.text()
