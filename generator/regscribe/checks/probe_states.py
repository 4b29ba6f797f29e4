"""Every state of the device that a set of conditions tells apart: brute force over a few representative values."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

from regscribe.checks.probe_values import ANYTHING, domain
from regscribe.checks.rule import RuleScope
from regscribe.model import CodeRange, Condition, Test, show

MOST_WORLDS = 10_000
"""Beyond this product nothing is said about the conditions: no manual comes near it."""

Atom = tuple[str, str]
"""What varies: a register or field (`subject`, ""), or whether its value is among a given's codes (`subject`, id)."""

World = dict[Atom, Fraction]


@dataclass(frozen=True, slots=True)
class Verdict:
    """Of several conditions in order: which can hold, which is ever the first that holds, and a state that none covers.

    `known` is False where there were too many states to look at.
    """

    possible: frozenset[int]
    reached: frozenset[int]
    uncovered: str
    known: bool = True


def verdict(conditions: tuple[Condition, ...], scope: RuleScope) -> Verdict:
    """Judge conditions in order; the answer is kept in the scope, since many registers share their cases."""
    key = ("verdict", conditions)
    found = scope.memo.get(key)
    if found is None:
        found = scope.memo[key] = _judge(conditions, scope)
    if not isinstance(found, Verdict):  # pragma: no cover (the key names what is kept)
        raise TypeError
    return found


def _judge(conditions: tuple[Condition, ...], scope: RuleScope) -> Verdict:
    choices = _choices([test for condition in conditions for test in condition.tests], scope)
    count = 1
    for values in choices.values():
        count *= len(values)
    everything = frozenset(range(len(conditions)))
    if count > MOST_WORLDS:
        return Verdict(everything, everything, "", known=False)
    possible: set[int] = set()
    reached: set[int] = set()
    uncovered = ""
    for world in _worlds(choices):
        held = [place for place, condition in enumerate(conditions) if _holds(condition, world)]
        possible.update(held)
        reached.update(held[:1])
        if not held and not uncovered:
            uncovered = _describe(world)
    return Verdict(frozenset(possible), frozenset(reached), uncovered)


def _worlds(choices: dict[Atom, list[Fraction]]) -> Iterator[World]:
    for values in product(*choices.values()):
        yield dict(zip(choices, values, strict=True))


def _atom(test: Test) -> Atom:
    return (test.subject, test.given)


def _choices(tests: list[Test], scope: RuleScope) -> dict[Atom, list[Fraction]]:
    """Representative values of every atom: 0 and 1 for a given, else the ends of stretches and codes."""
    choices: dict[Atom, list[Fraction]] = {}
    for test in tests:
        if test.given:
            choices[_atom(test)] = [Fraction(0), Fraction(1)]
    for test in tests:
        if not test.given and _atom(test) not in choices:
            codes = [code for other in tests if _atom(other) == _atom(test) for code in other.codes]
            choices[_atom(test)] = _representatives(_domain(test, scope), codes)
    return choices


def _domain(test: Test, scope: RuleScope) -> tuple[CodeRange, ...]:
    register = scope.registers.get(test.register)
    return domain(register, test.field) if register else ANYTHING


def _representatives(stretches: tuple[CodeRange, ...], codes: list[CodeRange]) -> list[Fraction]:
    """The ends of all stretches, and the codes with what lies just beside them, as far as the stretches go."""
    wanted = {end for stretch in stretches for end in (stretch.low, stretch.high)}
    beside = {near for code in codes for near in (code.low - 1, code.low, code.high, code.high + 1)}
    wanted |= {value for value in beside if any(stretch.holds(value) for stretch in stretches)}
    # A code range may enclose a whole stretch or only meet it in the middle: the ends above cover both.
    return sorted(wanted)


def _holds(condition: Condition, world: World) -> bool:
    return all(_passes(test, world[_atom(test)]) for test in condition.tests)


def _passes(test: Test, value: Fraction) -> bool:
    found = bool(value) if test.given else any(code.holds(value) for code in test.codes)
    return found is not test.negated


def _describe(world: World) -> str:
    parts = []
    for (subject, given), value in world.items():
        if not given:
            parts.append(f"{subject} = {show(value)}")
        elif subject:
            parts.append(f"{subject} {'in' if value else 'not in'} {given}")
        else:
            parts.append(f"{'' if value else 'not '}{given}")
    return ", ".join(parts)
