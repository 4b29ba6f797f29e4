"""Conditions: names, mappings and lists of them become a conjunction of tests, which `any` and `not` nest."""

from collections.abc import Callable
from typing import TypeVar

from regscribe.lower.matchers import given_named, test_of, test_of_given
from regscribe.lower.node import Value
from regscribe.lower.rules import CONDITION_IN_ITSELF, UNKNOWN_CONDITION, WRONG_SORT
from regscribe.lower.scope import Scope
from regscribe.lower.subject import subject_of
from regscribe.model import ALWAYS, AnyOf, Case, Cases, Condition, Is, WriteCondition

Made = TypeVar("Made")

_GIVEN = "given."


def condition(node: Value | None, scope: Scope) -> Condition:
    """The condition at a `when`: a name, tests by subject, or a list of these; None: always."""
    if node is None:
        return ALWAYS
    if node.is_text:
        return _named(node, scope)
    if node.is_mapping:
        return Condition(tuple(test for key, part in node.items() for test in _part(key, part, scope)))
    if not node.is_list:
        node.report(
            WRONG_SORT, f"`{node.text()}` is no condition", remedy="write a name, a mapping, or a list of these"
        )
        return ALWAYS
    parts = [Condition() if part.is_list else condition(part, scope) for part in node.elements()]
    return parts[0] if len(parts) == 1 else both(*parts)


def _named(node: Value, scope: Scope) -> Condition:
    if scope.map.mapping_of("givens").child(node.text()) and not scope.map.mapping_of("conditions").child(node.text()):
        message = f"there is no condition `{node.text()}`, but a given"
        node.report(UNKNOWN_CONDITION, message, remedy=f"write {{given: {node.text()}}}")
    found = scope.named(node, "conditions", rule=UNKNOWN_CONDITION, what="condition")
    if found is None or not found.is_mapping or _asks_for_itself(node, scope):
        return Condition((), name=node.text())
    inside = scope.inside(node.text())
    return scope.once(found.path, lambda: Condition(condition(found, inside).tests, name=node.text()))


def _asks_for_itself(node: Value, scope: Scope) -> bool:
    if node.text() not in scope.conditions:
        return False
    around = (*scope.conditions[scope.conditions.index(node.text()) :], node.text())
    remedy = "let it ask for registers"
    node.report(CONDITION_IN_ITSELF, f"the condition asks for itself: {' -> '.join(around)}", remedy=remedy)
    return True


def condition_of(node: Value, scope: Scope) -> Condition:
    """The condition at the `when` of a thing; always where it has none."""
    return condition(node.child("when"), scope)


def cases_of(node: Value, scope: Scope, make: Callable[[Value], Made]) -> Cases[Made]:
    """The results of `make` for the elements of a list, each with the condition at its `when`."""
    return tuple(Case(condition_of(element, scope), make(element)) for element in node.elements())


def write_condition(node: Value | None, scope: Scope) -> WriteCondition | None:
    """Condition of a write, and the reason for it; None where the map states none."""
    return WriteCondition(condition_of(node, scope), node.line_of("reason")) if node else None


def both(*conditions: Condition) -> Condition:
    """The condition that holds where all hold, each test once; where only one has tests, that one with its name."""
    parts = [part for part in conditions if not part.always]
    if len(parts) == 1:
        return parts[0]
    return Condition(tuple(dict.fromkeys(test for part in parts for test in part.tests)))


def exclusive(cases: Cases[Made]) -> Cases[Made]:
    """The same cases, each under the condition that it is the first that holds."""
    found: list[Case[Made]] = []
    for place, (when, then) in enumerate(cases):
        others = [one.when for one in cases[:place] if not excludes(when, one.when)]
        found.append(Case(both(when, Condition(tuple(map(negated, others)))), then))
    return tuple(found)


def excludes(one: Condition, other: Condition) -> bool:
    """Whether the two plainly cannot hold together: a test and its contrary, or codes that have none in common."""
    return any(_contrary(test, against) for test in one.tests for against in other.tests)


def _contrary(test: Is | AnyOf, other: Is | AnyOf) -> bool:
    if test._replace(negated=not test.negated) == other:
        return True
    if isinstance(test, Is) and isinstance(other, Is):
        return test.subject == other.subject and bool(test.codes and other.codes) and _disjoint(test, other)
    return _none_beside(test, other) or _none_beside(other, test)


def _none_beside(mixed: Is | AnyOf, single: Is | AnyOf) -> bool:
    """Whether a test excludes each alternative of another."""
    if mixed.negated or not isinstance(mixed, AnyOf):
        return False
    return all(excludes(each, Condition((single,))) for each in mixed.conditions)


def _disjoint(test: Is, other: Is) -> bool:
    """Whether no code meets both tests of one subject."""
    if test.negated and other.negated:
        return False
    if test.negated or other.negated:
        inner, outer = (other, test) if test.negated else (test, other)
        return all(any(low <= of and to <= high for low, high in outer.codes) for of, to in inner.codes)
    return not any(low <= to and of <= high for low, high in test.codes for of, to in other.codes)


def _part(key: str, part: Value, scope: Scope) -> list[Is | AnyOf]:
    if key == "given":
        givens = ((element.child("not"), element) for element in part.elements())
        return [Is("", given=given_named(no or yes, scope, "boolean"), negated=no is not None) for no, yes in givens]
    if key == "any":
        return [AnyOf(tuple(condition(one, scope) for one in part.elements()))]
    if key == "not":
        return [negated(condition(part, scope))]
    if key.startswith(_GIVEN):
        return [*test_of_given(part, key.removeprefix(_GIVEN), scope)]
    subject = subject_of(part, key, scope)
    return [] if subject is None else [test_of(part, subject, scope)]


def negated(found: Condition) -> Is | AnyOf:
    """The test that a condition does not hold."""
    if len(found.tests) == 1:
        return found.tests[0]._replace(negated=not found.tests[0].negated)
    return AnyOf((found,), negated=True)
