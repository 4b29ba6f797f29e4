"""Every state of the device that a set of conditions tells apart: brute force over a few representative values."""

from collections import defaultdict
from fractions import Fraction
from math import prod
from typing import NamedTuple

from regscribe.checks.rule import RuleScope
from regscribe.model import Condition, Is, show
from regscribe.reference.states import ANYTHING, combinations, domain, representatives

MOST_STATES = 10_000
"""Conditions with more states than this are not judged: no manual comes near it."""

Atom = tuple[str, str]
"""What varies: a register or field (`subject`, ""), or whether its value is among a given's codes (`subject`, id)."""

State = dict[Atom, Fraction]


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
    choices = _choices([test for condition in conditions for test in condition.tests], scope)
    everything = frozenset(range(len(conditions)))
    if prod(map(len, choices.values())) > MOST_STATES:
        return Verdict(everything, everything, "")
    possible: set[int] = set()
    reached: set[int] = set()
    uncovered = ""
    for state in combinations(choices):
        held = [
            place for place, condition in enumerate(conditions) if all(_passes(test, state) for test in condition.tests)
        ]
        possible.update(held)
        reached.update(held[:1])
        if not held and not uncovered:
            uncovered = _describe(state)
    return Verdict(frozenset(possible), frozenset(reached), uncovered)


def _choices(tests: list[Is], scope: RuleScope) -> dict[Atom, tuple[Fraction, ...]]:
    """Representative values of every atom: 0 and 1 for a given, else those that the codes tell apart."""
    atoms: defaultdict[Atom, list[Is]] = defaultdict(list)
    for test in tests:
        atoms[test.subject, test.given].append(test)
    choices: dict[Atom, tuple[Fraction, ...]] = {atom: (Fraction(0), Fraction(1)) for atom in atoms if atom[1]}
    for atom, (first, *others) in atoms.items():
        if not first.given:
            codes = [code for test in (first, *others) for code in test.codes]
            register = scope.registers.get(first.register)
            choices[atom] = representatives(domain(register, first.field) if register else ANYTHING, codes)
    return choices


def _passes(test: Is, state: State) -> bool:
    value = state[test.subject, test.given]
    found = bool(value) if test.given else test.lists(value)
    return found is not test.negated


def _describe(state: State) -> str:
    parts = []
    for (subject, given), value in state.items():
        if not given:
            parts.append(f"{subject} = {show(value)}")
        elif subject:
            parts.append(f"{subject} {'in' if value else 'not in'} {given}")
        else:
            parts.append(f"{'' if value else 'not '}{given}")
    return ", ".join(parts)
