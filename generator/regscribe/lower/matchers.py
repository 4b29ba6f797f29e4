"""What a test asks for: codes, ranges with open ends, versions, members by id, and what is given."""

import re
from fractions import Fraction

from regscribe.lower.node import ZERO, Value
from regscribe.lower.rules import BAD_MATCHER, UNKNOWN_GIVEN, UNKNOWN_MEMBER
from regscribe.lower.scope import Scope
from regscribe.lower.subject import Subject, code_of_text
from regscribe.lower.texts import ends, known_name, ordered, unknown, version_of
from regscribe.model import BOTTOM, TOP, Is, Kind
from regscribe_runtime.values.versions import version_key

_SETS = ("in", "not_in")
_ENDS = ("from", "to")
_VERSION = re.compile(r"[0-9]{1,6}(\.[0-9]{1,6}){0,3}")


def given_named(node: Value, scope: Scope, kind: str) -> str:
    """The id of the given that `node` names; RS0312 where there is none of the kind."""
    found = scope.named(node, "givens", rule=UNKNOWN_GIVEN, what="given")
    stated = found.child("type") if found else None
    if stated and stated.text() != kind:
        message = f"the given `{node.text()}` is of type {stated.text()}, {kind} is needed here"
        node.report(UNKNOWN_GIVEN, message, remedy=f"refer to a given of type {kind}")
    return node.text()


def test_of_given(matcher: Value, name: str, scope: Scope) -> list[Is]:
    """The test of a number or a choice that is given; RS0312 and none where there is no such given."""
    table = scope.map.mapping_of("givens")
    known = {key: node for key, node in table.items() if node.text_of("type") in {"number", "choice"}}
    if name not in known:
        unknown(matcher, UNKNOWN_GIVEN, "given of type number or choice", name, known, at_key=True)
        return []
    codes, negated = _NumberCodes(known[name]).codes(matcher, negated=False)
    return [Is("", codes, given=name, negated=negated)]


def test_of(matcher: Value, subject: Subject, scope: Scope) -> Is:
    """The test of a register or of a bit field."""
    test = Is(subject.entry.path, field=subject.field, bits=subject.bits)
    return _tested(test, matcher, subject, scope, negated=False)


def _tested(test: Is, matcher: Value, subject: Subject, scope: Scope, *, negated: bool) -> Is:
    for key, node in matcher.items():
        if key == "not":
            return _tested(test, node, subject, scope, negated=not negated)
        if key in _SETS:
            given = given_named(node, scope, "codes")
            return test._replace(given=given, negated=negated != (key == "not_in"))
        if key not in _ENDS:
            unknown(matcher, BAD_MATCHER, "matcher", key, [*_SETS, *_ENDS, "not"])
    reader = _SubjectCodes(subject, scope)
    codes, negated = reader.codes(matcher, negated=negated)
    return test._replace(codes=codes, negated=negated, version=reader.is_text)


class _Codes:
    """Reads codes of a matcher; what one end is, a subclass tells."""

    def codes(self, matcher: Value, *, negated: bool) -> tuple[tuple[tuple[object, object], ...], bool]:
        """The codes that the matcher lists, and whether they are those that do not hold."""
        if matcher.is_mapping and matcher.child("not"):
            return self.codes(matcher.mapping_of("not"), negated=not negated)
        return tuple(map(self._code, matcher.elements())), negated

    def _code(self, node: Value) -> tuple[object, object]:
        if node.is_list or (node.is_mapping and not {key for key, _ in node.items()} <= {*_ENDS}):
            remedy = "a list holds numbers, ranges and enum members; use one `not`, `in` or `not_in` beside no others"
            node.report(BAD_MATCHER, "this cannot stand in a list of codes", remedy=remedy)
            return ZERO, ZERO
        if node.is_mapping:
            low, high = node.child("from"), node.child("to")
            first = self._end(low) if low else Fraction(BOTTOM)
            return ordered(node, first, self._end(high) if high else Fraction(TOP))
        if node.is_text and ".." in node.text():
            return ends(node)
        code = self._end(node)
        return code, code

    def _end(self, node: Value) -> Fraction:
        raise NotImplementedError


class _SubjectCodes(_Codes):
    """Codes of a register or of a bit field; those of a text are versions."""

    def __init__(self, subject: Subject, scope: Scope) -> None:
        self._subject, self._scope = subject, scope
        settings = subject.entry.settings
        self.is_text = not subject.field and (
            settings.text_of("type") == "string" or settings.text_of("kind") == Kind.STRING
        )
        self._groups = (0, 0) if subject.field else version_of(settings.child("version"))

    def _end(self, node: Value) -> Fraction:
        text = node.text()
        if self.is_text or (self._groups[0] and "." in text):
            return self._version(node, text)
        return code_of_text(node, self._subject, self._scope) if node.is_text else node.number()

    def _version(self, node: Value, text: str) -> Fraction:
        digits, size = self._groups
        parts = text.split(".")
        room = digits // size if size else len(parts)
        if not _VERSION.fullmatch(text) or len(parts) > room or (size and max(map(len, parts)) > size):
            node.report(BAD_MATCHER, f"`{text}` is no version of this register", remedy="write its parts, as 1.2.0")
            return ZERO
        if self.is_text:
            return Fraction(version_key(text) or 0)
        padded = [part.zfill(size) for part in parts] + ["0" * size] * (room - len(parts))
        return Fraction(int("".join(padded)))


class _NumberCodes(_Codes):
    """Codes of a given: numbers, or the texts of a choice."""

    def __init__(self, given: Value) -> None:
        self._choices = given.texts_of("choices") if given.text_of("type") == "choice" else ()

    def _code(self, node: Value) -> tuple[object, object]:
        if not self._choices or node.is_mapping or node.is_list:
            return super()._code(node)
        name = known_name(node, UNKNOWN_MEMBER, "choice", self._choices)
        return name, name

    def _end(self, node: Value) -> Fraction:
        if self._choices:
            node.report(BAD_MATCHER, "choices have no order", remedy="list the choices that hold")
            return ZERO
        return node.number()
