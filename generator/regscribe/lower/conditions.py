"""Conditions: names, mappings and lists of them become a flat conjunction of tests."""

from collections.abc import Callable
from fractions import Fraction
from typing import TypeVar

from regscribe.lower.node import ZERO, Value
from regscribe.lower.rules import BAD_MATCHER, UNKNOWN_CONDITION, UNKNOWN_GIVEN, WRONG_SORT
from regscribe.lower.scope import Scope
from regscribe.lower.subject import Subject, code_of_text, subject_of
from regscribe.lower.texts import ends, unknown
from regscribe.model import ALWAYS, Case, Cases, Condition, Is, WriteCondition

Made = TypeVar("Made")

_SETS = ("in", "not_in")


def condition(node: Value | None, scope: Scope) -> Condition:
    """The condition at a `when`: a name, tests by subject, or a list of these; None: always."""
    if node is None:
        return ALWAYS
    if node.is_text:
        return _named(node, scope)
    if node.is_mapping:
        return Condition(tuple(test for key, matcher in node.items() for test in _tests(key, matcher, scope)))
    if not node.is_list:
        node.report(
            WRONG_SORT, f"`{node.text()}` is no condition", remedy="write a name, a mapping, or a list of these"
        )
        return ALWAYS
    parts = [Condition() if part.is_list else condition(part, scope) for part in node.elements()]
    return parts[0] if len(parts) == 1 else both(*parts)


def _named(node: Value, scope: Scope) -> Condition:
    found = scope.named(node, "conditions", rule=UNKNOWN_CONDITION, what="condition")
    if found is None or not found.is_mapping:
        return Condition((), name=node.text())
    return scope.once(found.path, lambda: Condition(condition(found, scope).tests, name=node.text()))


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


def excludes(one: Condition, other: Condition) -> bool:
    """Whether the two plainly cannot hold together: a test and its contrary, or codes that have none in common."""
    return any(_contrary(test, against) for test in one.tests for against in other.tests)


def _contrary(test: Is, other: Is) -> bool:
    if test._replace(negated=not test.negated) == other:
        return True
    if test.subject != other.subject or test.negated or other.negated or not (test.codes and other.codes):
        return False
    return not any(low <= to and of <= high for low, high in test.codes for of, to in other.codes)


def _tests(key: str, matcher: Value, scope: Scope) -> list[Is]:
    if key == "given":
        givens = ((element.child("not"), element) for element in matcher.elements())
        return [Is("", given=_given(no or yes, scope, "boolean"), negated=no is not None) for no, yes in givens]
    subject = subject_of(matcher, key, scope)
    return [] if subject is None else [_test(matcher, subject, scope, negated=False)]


def _given(node: Value, scope: Scope, kind: str) -> str:
    found = scope.named(node, "givens", rule=UNKNOWN_GIVEN, what="given")
    stated = found.child("type") if found else None
    if stated and stated.text() != kind:
        message = f"the given `{node.text()}` is of type {stated.text()}, {kind} is needed here"
        node.report(UNKNOWN_GIVEN, message, remedy=f"refer to a given of type {kind}")
    return node.text()


def _test(matcher: Value, subject: Subject, scope: Scope, *, negated: bool) -> Is:
    test = Is(subject.entry.path, field=subject.field, bits=subject.bits)
    for key, node in matcher.items():
        if key == "not":
            return _test(node, subject, scope, negated=not negated)
        if key in _SETS:
            given = _given(node, scope, "codes")
            return test._replace(given=given, negated=negated != (key == "not_in"))
        unknown(matcher, BAD_MATCHER, "matcher", key, [*_SETS, "not"])
    codes = tuple(_code(node, subject, scope) for node in matcher.elements() if not matcher.is_mapping)
    return test._replace(codes=codes, negated=negated)


def _code(node: Value, subject: Subject, scope: Scope) -> tuple[Fraction, Fraction]:
    if node.is_mapping or node.is_list:
        remedy = "a list holds numbers, ranges and enum members; use one `not`, `in` or `not_in` beside no others"
        node.report(BAD_MATCHER, "this cannot stand in a list of codes", remedy=remedy)
        return ZERO, ZERO
    if node.is_text and ".." in node.text():
        return ends(node)
    code = code_of_text(node, subject, scope) if node.is_text else node.number()
    return code, code
