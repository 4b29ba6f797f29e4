"""Units: symbols that a map may use, and those that differ by case."""

from collections.abc import Iterable

from regscribe.lower.conditions import cases_of
from regscribe.lower.node import Value, brief
from regscribe.lower.rules import UNKNOWN_UNIT
from regscribe.lower.scope import Scope
from regscribe.lower.texts import known_name
from regscribe.model import Cases, always
from regscribe.model.nearest import nearest
from regscribe.model.units import KNOWN_UNITS, meant_unit
from regscribe.schema import inline


def own_units(root: Value) -> tuple[str, ...]:
    """The plain unit symbols that a map declares."""
    return tuple(name for name, node in root.items_of("units") if not node.is_list)


def unit_notes(root: Value) -> tuple[tuple[str, str], ...]:
    """What plain unit symbols stand for, as far as the map says."""
    every = ((name, node.line_of("description")) for name, node in root.items_of("units") if not node.is_list)
    return tuple((name, text) for name, text in every if text)


def unit_of(node: Value | None, scope: Scope) -> tuple[Cases[str], str]:
    """The unit symbol by case, and the id where the map names a unit with cases; RS0311 for an unknown one."""
    if node is None:
        return always(""), ""
    if node.is_list:
        return unit_at(node, scope), ""
    name, units = node.text(), dict(scope.map.items_of("units"))
    if name in units and units[name].is_list:
        return unit_at(units[name], scope), name
    return always(_symbol(node, scope, [key for key, unit in units.items() if unit.is_list])), ""


def unit_at(node: Value, scope: Scope) -> Cases[str]:
    """The symbols of the unit with cases that stands at `node`, in `units` or at a register."""

    def make(case: Value) -> str:
        return _symbol(case.child("symbol") or case.child("is"), scope)

    return scope.once(node.path, lambda: cases_of(node, scope, make))


def _symbol(node: Value | None, scope: Scope, by_case: Iterable[str] = ()) -> str:
    name = node.text() if node else ""
    if node and name and name not in KNOWN_UNITS and name not in (own := own_units(scope.map)):
        near = meant_unit(name) or nearest(name, (*by_case, *own, *KNOWN_UNITS))
        guess = f"did you mean `{near}`? Else " if near else ""
        remedy = f"{guess}declare it under `units:`, as {inline(name)}: {{}}"
        node.report(UNKNOWN_UNIT, f"there is no unit `{brief(name)}`", remedy=remedy, replacement=near)
    return name


def rescaled(node: Value | None, scope: Scope) -> str:
    """The unit with cases whose registers the device converts; RS0311 where the map has none of that name."""
    if node is None:
        return ""
    by_case = [name for name, unit in scope.map.items_of("units") if unit.is_list]
    return known_name(node, UNKNOWN_UNIT, "unit with cases", by_case)
