"""What a command changes besides the words that it writes."""

from collections.abc import Mapping
from fractions import Fraction

from regscribe.lower.conditions import condition
from regscribe.lower.node import Value, elements_of, items_of, truth_of
from regscribe.lower.presence import present
from regscribe.lower.scope import Scope, path_of
from regscribe.lower.subject import Subject, code_of_text, subject_of
from regscribe.model import Effect, Kind, Register


def effects_of(command: Value, scope: Scope, registers: Mapping[str, Register]) -> tuple[Effect, ...]:
    """The effects of a command on the model of the scope."""
    nodes = (
        node for node in elements_of(command, "effects") if scope.model in present(node, scope.models, scope.models)
    )
    return tuple(_effect(node, scope, registers) for node in nodes)


def _effect(node: Value, scope: Scope, registers: Mapping[str, Register]) -> Effect:
    return Effect(
        when=condition(node.child("when"), scope),
        sets=tuple(_sets(node, scope, registers)),
        defaults=_defaults(node, scope, registers),
        unlatch=truth_of(node, "unlatch"),
    )


def _sets(effect: Value, scope: Scope, registers: Mapping[str, Register]) -> list[tuple[str, Fraction | str]]:
    found: list[tuple[str, Fraction | str]] = []
    for key, node in items_of(effect, "set"):
        subject = subject_of(node, key, scope)
        if subject is not None:
            path = path_of(subject.entry, subject.name)
            kind = registers[path].kind if path in registers and not subject.field else Kind.NUMBER
            found.append((f"{path}.{subject.field}" if subject.field else path, _value(node, subject, scope, kind)))
    return found


def _value(node: Value, subject: Subject, scope: Scope, kind: Kind) -> Fraction | str:
    if kind is Kind.STRING or (kind is Kind.VERSION and node.is_text):
        return node.text()
    return code_of_text(node, subject, scope) if node.is_text else node.number()


def _defaults(effect: Value, scope: Scope, registers: Mapping[str, Register]) -> tuple[str, ...]:
    node = effect.child("defaults")
    if node is None:
        return ()
    kept = {path_of(scope.register(each), each.text()) for each in elements_of(effect, "keep")}
    if node.is_text:
        writable = (one for one in registers.values() if one.default is not None and one.access.writable)
        return tuple(one.path for one in writable if one.path not in kept)
    named = (path_of(scope.register(each), each.text()) for each in node.elements())
    return tuple(path for path in named if path not in kept)
