"""Ranges: plain, unions, by case, with limits that are registers or open, and with decimals from a register."""

from regscribe.lower.conditions import both, condition, excludes
from regscribe.lower.interval_text import ends
from regscribe.lower.node import Value, text_of
from regscribe.lower.rules import REVERSED
from regscribe.lower.scales import Scaling, decimals_rule
from regscribe.lower.scope import Scope, path_of
from regscribe.lower.tree import TreeNode
from regscribe.model import Case, Cases, Conversion, Interval, Limit, Number, Open, Range, Ref, always, show

_NOT_GIVEN = Open("not given")


def range_of(entry: TreeNode, scaling: tuple[Scaling, ...], scope: Scope) -> Cases[Range]:
    """The range of a register by case; where the map gives none, the ends of its scale."""
    node = entry.settings.get("range")
    if node is None:
        return _of_scale(scaling)
    cases = _cases(node, scope)
    if "range_decimals" not in entry.settings:
        return cases
    rules = decimals_rule(entry.settings["range_decimals"], scope)
    return tuple(part for case in cases for part in _with_decimals(case, rules))


def _of_scale(scaling: tuple[Scaling, ...]) -> Cases[Range]:
    if not any(part.ends for part in scaling):
        return ()
    ends = ((part.when, sorted(part.ends) if part.ends else (_NOT_GIVEN, _NOT_GIVEN)) for part in scaling)
    return tuple(Case(when, Range((Interval(low, high),))) for when, (low, high) in ends)


def _cases(node: Value, scope: Scope) -> Cases[Range]:
    if any(element.child("is") for element in node.elements()):
        return tuple(_case(element, scope) for element in node.elements())
    return always(_range(node, scope))


def _case(node: Value, scope: Scope) -> Case[Range]:
    return Case(condition(node.child("when"), scope), _range(node.child("is") or node, scope))


def _range(node: Value, scope: Scope) -> Range:
    return Range(tuple(_interval(element, scope) for element in node.elements()))


def _interval(node: Value, scope: Scope) -> Interval:
    if not node.is_mapping:
        return Interval(*ends(node))
    interval = Interval(_limit(node.child("from"), scope), _limit(node.child("to"), scope))
    low, high = interval
    if isinstance(low, Number) and isinstance(high, Number) and low > high:
        message = f"the range is reversed: from {show(low)} is more than to {show(high)}"
        node.report(REVERSED, message, remedy=f"write from: {show(high)}, to: {show(low)}")
    return interval


def _limit(node: Value | None, scope: Scope) -> Limit:
    if node is None:
        return _NOT_GIVEN
    if node.is_mapping:
        return Open(text_of(node, "open"))
    if node.is_number:
        return node.number()
    return Ref(path_of(scope.register(node), node.text()))


def _with_decimals(case: Case[Range], rules: Cases[Conversion]) -> Cases[Range]:
    """A case for each condition of a decimals rule, with its decimals; last the case itself, unless one must hold."""
    numbers = any(isinstance(limit, Number) for each in case.then.intervals for limit in (each.low, each.high))
    dividing = max((number for number, rule in enumerate(rules, start=1) if rule.then.decimals), default=0)
    found: list[Case[Range]] = []
    for rule in rules[: dividing if numbers else 0]:
        if excludes(case.when, rule.when):
            continue
        scaled = Range(case.then.intervals, rule.then.decimals)
        if set(rule.when.tests) <= set(case.when.tests):
            return (*found, Case(case.when, scaled))
        found.append(Case(both(rule.when, case.when), scaled))
    return (*found, case)
