"""Every state of the device that a set of conditions tells apart: brute force over a few representative values."""

from collections import defaultdict
from fractions import Fraction
from math import prod
from typing import Any, NamedTuple

from regscribe.checks.rule import RuleScope
from regscribe.model import AnyOf, Condition, Is, show
from regscribe.reference.states import ANYTHING, combinations, domain, domain_of_given, representatives

MOST_STATES = 10_000
"""Conditions with more states than this are not judged: no manual comes near it."""

Atom = tuple[str, str]
"""What varies: a register or field (`subject`, ""), or whether its value is among a given's codes (`subject`, id)."""

State = dict[Atom, Any]


class Verdict(NamedTuple):
    """Verdict on conditions in order: places of those that can hold and of those that are ever the first to hold.

    `uncovered` describes a state in which none holds. Of more than MOST_STATES states, all count as possible.
    """

    possible: frozenset[int]
    reached: frozenset[int]
    uncovered: str


def verdict(conditions: tuple[Condition, ...], scope: RuleScope) -> Verdict:
    """Judge conditions in order; the answer is kept in the scope, since many registers share their cases."""
    return scope.once(("verdict", conditions), lambda: _judge(conditions, scope))


def _judge(conditions: tuple[Condition, ...], scope: RuleScope) -> Verdict:
    choices = _choices([test for condition in conditions for test in condition.leaves], scope)
    everything = frozenset(range(len(conditions)))
    if prod(map(len, choices.values())) > MOST_STATES:
        return Verdict(everything, everything, "")
    possible: set[int] = set()
    reached: set[int] = set()
    uncovered = ""
    for state in combinations(choices):
        held = [place for place, condition in enumerate(conditions) if _holds(condition, state)]
        possible.update(held)
        reached.update(held[:1])
        if not held and not uncovered:
            uncovered = _describe(state)
    return Verdict(frozenset(possible), frozenset(reached), uncovered)


def _choices(tests: list[Is], scope: RuleScope) -> dict[Atom, tuple[Any, ...]]:
    """Values of every atom: 0 and 1 for a given, else those that the codes tell apart, or all choices."""
    atoms: defaultdict[Atom, list[Is]] = defaultdict(list)
    for test in tests:
        atoms[_atom(test)].append(test)
    choices: dict[Atom, tuple[Any, ...]] = {}
    for atom, (first, *others) in atoms.items():
        codes = [code for test in (first, *others) for code in test.codes]
        choices[atom] = (Fraction(0), Fraction(1)) if first.asks_given else _values(first, codes, scope)
    return choices


def _atom(test: Is) -> Atom:
    return test.subject if test.register else "", test.given


def _values(test: Is, codes: list[tuple[Any, Any]], scope: RuleScope) -> tuple[Any, ...]:
    register = scope.registers.get(test.register)
    if register:
        return representatives(ANYTHING if test.version else domain(register, test.field), codes)
    given = next((one for one in scope.register_map.givens if one.id == test.given), None)
    if given is None:
        return representatives(ANYTHING, codes)
    return given.choices or representatives(domain_of_given(given), codes)


def _holds(condition: Condition, state: State) -> bool:
    return all(_passes(test, state) for test in condition.tests)


def _passes(test: Is | AnyOf, state: State) -> bool:
    if isinstance(test, AnyOf):
        return any(_holds(condition, state) for condition in test.conditions) is not test.negated
    value = state[_atom(test)]
    found = bool(value) if test.asks_given else test.lists(value)
    return found is not test.negated


def _describe(state: State) -> str:
    parts = []
    for (subject, given), value in state.items():
        if not given:
            parts.append(f"{subject} = {show(value)}")
        elif not subject and not isinstance(value, Fraction | int):
            parts.append(f"{given} = {value}")
        elif subject:
            parts.append(f"{subject} {'in' if value else 'not in'} {given}")
        else:
            parts.append(f"{'' if value else 'not '}{given}")
    return ", ".join(parts)
