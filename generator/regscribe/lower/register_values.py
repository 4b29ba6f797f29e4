"""Which values a register takes: its range, special values, sentinels, default and version pattern.

A range may be a union or differ by case; limits may be registers or open, and have decimals from a register.
"""

from fractions import Fraction

from regscribe.lower.conditions import both, cases_of, condition_of, excludes
from regscribe.lower.labels import identifier_of, label_of
from regscribe.lower.node import ZERO, Value
from regscribe.lower.rules import BAD_DEFAULT, REVERSED
from regscribe.lower.scales import Scaling, decimals_rule
from regscribe.lower.scope import Scope
from regscribe.lower.terms import term_of
from regscribe.lower.texts import ends, key_ends, unknown
from regscribe.lower.tree import TreeNode
from regscribe.model import (
    ALWAYS,
    NAN,
    Case,
    Cases,
    Condition,
    Conversion,
    Enum,
    Interval,
    Kind,
    Limit,
    Number,
    Open,
    Range,
    Sentinel,
    Special,
    always,
    show,
)
from regscribe_runtime.values.kinds import OCTETS

_NOT_GIVEN = Open("not given")


def range_of(entry: TreeNode, scaling: tuple[Scaling, ...], scope: Scope) -> Cases[Range]:
    """The range of a register by case; where the map gives none, the ends of its scale."""
    node = entry.settings.get("range")
    if node is None:
        return _between_ends(scaling)
    cases = ranges_at(node, scope)
    if "range_decimals" not in entry.settings:
        return cases
    rules = decimals_rule(entry.settings["range_decimals"], scope)
    return tuple(part for case in cases for part in _with_decimals(case, rules))


def ranges_at(node: Value | None, scope: Scope) -> Cases[Range]:
    """The ranges that stand at `node` by case; none without it."""
    if node is None:
        return ()
    if any(element.child("is") for element in node.elements()):
        return cases_of(node, scope, lambda case: _range(case.child("is") or case, scope))
    return always(_range(node, scope))


def _between_ends(scaling: tuple[Scaling, ...]) -> Cases[Range]:
    if not any(part.ends for part in scaling):
        return ()
    limits = [(part.when, sorted(part.ends) if part.ends else (_NOT_GIVEN, _NOT_GIVEN)) for part in scaling]
    return tuple(Case(when, Range((Interval(low, high),))) for when, (low, high) in limits)


def _range(node: Value, scope: Scope) -> Range:
    return Range(tuple(_interval(element, scope) for element in node.elements()))


def _interval(node: Value, scope: Scope) -> Interval:
    if not node.is_mapping:
        return Interval(*ends(node))
    low, high = _limit(node.child("from"), scope), _limit(node.child("to"), scope)
    if isinstance(low, Number) and isinstance(high, Number) and low > high:
        message = f"the range is reversed: from {show(low)} is more than to {show(high)}"
        node.report(REVERSED, message, remedy=f"write from: {show(high)}, to: {show(low)}")
    return Interval(low, high)


def _limit(node: Value | None, scope: Scope) -> Limit:
    if node is None:
        return _NOT_GIVEN
    stated = node.child("open")
    return Open(stated.text()) if stated else term_of(node, scope)


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


def specials_of(entry: TreeNode) -> tuple[Special, ...]:
    """The special values of a register."""
    found = []
    for _, node in entry.settings.items_of("special"):
        label, means = label_of(node), node.child("means")
        name = identifier_of(node, label).upper()
        found.append(Special(node.key_number(), label, name, means.number() if means else None))
    return tuple(found)


def sentinels_of(entry: TreeNode, scope: Scope) -> tuple[Sentinel, ...]:
    """The stored numbers of a register that are faults, of all cases."""
    node = entry.settings.get("sentinels")
    if node is None or node.is_mapping:
        return tuple(_sentinel(each, ALWAYS) for _, each in entry.settings.items_of("sentinels"))
    return tuple(
        _sentinel(each, condition_of(case, scope)) for case in node.elements() for _, each in case.items_of("is")
    )


def _sentinel(node: Value, when: Condition) -> Sentinel:
    label = label_of(node)
    name = identifier_of(node, label).upper()
    if node.key == NAN.value:
        return Sentinel(NAN, name, label, when=when)
    low, high = key_ends(node) if ".." in node.key else (node.key_number(), None)
    return Sentinel(low, name, label, high, when)


Beginning = tuple[Fraction | str | None, Cases[Fraction | str]]
"""A value that a register begins with, or else such values by case."""


def beginnings_of(
    node: Value | None, kind: Kind, enum: Enum | None, specials: tuple[Special, ...], scope: Scope
) -> Beginning:
    """The `default` or `delivered` value of a register, or its cases."""
    if node is None or not node.is_list:
        return beginning_of(node, kind, enum, specials), ()

    def make(case: Value) -> Fraction | str:
        return beginning_of(case.child("is"), kind, enum, specials) or ZERO

    return None, cases_of(node, scope, make)


def beginning_of(
    node: Value | None, kind: Kind, enum: Enum | None, specials: tuple[Special, ...]
) -> Fraction | str | None:
    """The `default` or `delivered` value as one of use; RS0322 where it names no member or special value.

    Manuals print the code of a special value here, too: it is the number that the code stands for.
    """
    if node is None:
        return None
    value = named_value(node, kind, enum, specials, BAD_DEFAULT)
    if value in {special.means for special in specials}:
        return value
    return next((special.value for special in specials if special.code == value), value)


def named_value(node: Value, kind: Kind, enum: Enum | None, specials: tuple[Special, ...], rule: str) -> Fraction | str:
    """A value of use as a map spells it: a number, a text or version, or the id of an enum member or special value."""
    if kind in OCTETS:
        return node.text()
    if not node.is_text:
        return node.number()
    text = node.text()
    named = {name: Fraction(code) for name, code in (enum.codes if enum else {}).items()}
    named |= {special.id.lower(): special.value for special in specials}
    if text.lower() in named:
        return named[text.lower()]
    if kind is Kind.VERSION:
        return text
    unknown(node, rule, "member or special value", text, named)
    return ZERO
