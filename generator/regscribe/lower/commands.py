"""Commands: each step becomes the words of one request; effects are what changes besides."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from regscribe.lower.conditions import condition
from regscribe.lower.names import identifier, unknown
from regscribe.lower.node import Value, elements_of, items_of, text_of, truth_of, whole_of, wholes_of
from regscribe.lower.rules import NOT_CONSTANT, UNKNOWN_MEMBER, UNKNOWN_VIEW
from regscribe.lower.scope import Scope, path_of
from regscribe.lower.special_values import named_value
from regscribe.lower.subject import Subject, code_of_text, subject_of
from regscribe.model import Command, CommandStep, Effect, Kind, Protocol, Register, Rounding, Space, View
from regscribe.reference import RefusedError, UnknownValueError, encode

_INSTEAD = "choose another value or view, or give the `words` that the manual prints"


@dataclass(frozen=True, slots=True)
class CommandScope:
    """What the steps of a command need to know of the model they are for."""

    scope: Scope
    registers: dict[str, Register]
    protocol: Protocol


def commands_of(root: Value, device: CommandScope) -> tuple[Command, ...]:
    """The commands that a model has."""
    commands = items_of(root, "commands")
    return tuple(_command(name, node, device) for name, node in commands if device.scope.has(node))


def _command(name: str, node: Value, device: CommandScope) -> Command:
    steps = [_step(step, device) for step in elements_of(node, "steps")]
    return Command(
        id=identifier(node, label=name, given=None) if not name.isidentifier() else name,
        name=text_of(node, "name", name),
        steps=tuple(step for step, _ in steps),
        step_registers=tuple(path for _, path in steps),
        description=text_of(node, "description"),
        section=text_of(node, "source"),
        danger=text_of(node, "danger"),
        effects=tuple(_effect(one, device) for one in elements_of(node, "effects") if device.scope.has(one)),
        span=node.key_span,
    )


def _step(node: Value, device: CommandScope) -> tuple[CommandStep, str]:
    """A step, and the path of the register that it names."""
    register = node.child("register")
    if node.child("wait"):
        return CommandStep(0, 0, (), whole_of(node, "wait")), ""
    if register is None:
        words = unsigned(wholes_of(node, "words"))
        function = _function(node, len(words), None, device)
        return CommandStep(function, whole_of(node, "at"), words), ""
    entry = device.scope.register(register)
    if entry is None:
        return CommandStep(0, 0, ()), register.text()
    target = device.registers[entry.path]
    view = view_of(node.child("view"), target) if node.child("view") else _written_view(target)
    value = node.child("value")
    words = _words_of_value(value, target, view) if value else unsigned(wholes_of(node, "words"))
    function = _function(node, len(words), view, device)
    return CommandStep(function, view.address(target.at), words), entry.path


def _function(node: Value, count: int, view: View | None, device: CommandScope) -> int:
    if node.child("function"):
        return whole_of(node, "function")
    single, several = (Space.COIL if view and view.space is Space.COIL else Space.HOLDING).write_functions
    allowed = [code for code in device.protocol.functions if not view or view.allows(code)]
    return single if count == 1 and single in allowed else several


def _written_view(register: Register) -> View:
    """The base view, or the first one that a write may address where the base view is for reading alone."""
    return next((view for view in register.views if view.writable), register.base)


def view_of(node: Value | None, register: Register) -> View:
    """The view of a register that `node` names, the base view where it is None; RS0323 for an unknown one."""
    found = [view for view in register.views if node is None or view.name == node.text()]
    if not found and node is not None:
        unknown(node, UNKNOWN_VIEW, "view", node.text(), [view.name for view in register.views], of=register.path)
    return found[0] if found else register.base


def unsigned(words: tuple[int, ...]) -> tuple[int, ...]:
    """Words as they stand on the wire, 0 to 65535; the map may write them with a sign."""
    return tuple(word & 0xFFFF for word in words)


def _words_of_value(node: Value, register: Register, view: View) -> tuple[int, ...]:
    """The words that transmit the value in a view; RS0326 where they are not constant or cannot carry it."""
    value = named_value(node, register.kind, register.enum, register.specials, UNKNOWN_MEMBER)
    if any(case.then.multiply == 0 for case in register.scale):
        node.report(NOT_CONSTANT, f"the scale of `{register.path}` is zero", remedy=_INSTEAD)
        return ()
    # A range is none of the words: whether the device takes the value may depend on other registers.
    unlimited = replace(register, range=())
    try:
        return encode(unlimited, view, value, rounded=view.rounding is not Rounding.NONE)
    except UnknownValueError as unknown:
        message = f"what `{register.path}` sends for {node.text()} depends on other registers: {unknown}"
    except RefusedError as refused:
        message = f"{node.text()} cannot be sent as {view.type} of `{register.path}`: {refused}"
    node.report(NOT_CONSTANT, message, remedy=_INSTEAD)
    return ()


def _effect(node: Value, device: CommandScope) -> Effect:
    return Effect(
        when=condition(node.child("when"), device.scope),
        sets=tuple(_sets(node, device)),
        defaults=_defaults(node, device),
        unlatch=truth_of(node, "unlatch"),
    )


def _sets(effect: Value, device: CommandScope) -> Iterator[tuple[str, Fraction | str]]:
    for key, node in items_of(effect, "set"):
        subject = subject_of(node, key, device.scope)
        if subject is not None:
            yield subject.path, _value(node, subject, device)


def _value(node: Value, subject: Subject, device: CommandScope) -> Fraction | str:
    register = None if subject.field else device.registers.get(subject.path)
    if register and (register.kind is Kind.STRING or (register.kind is Kind.VERSION and node.is_text)):
        return node.text()
    return code_of_text(node, subject, device.scope) if node.is_text else node.number()


def _defaults(effect: Value, device: CommandScope) -> tuple[str, ...]:
    """The registers that an effect returns to their defaults, but those that it keeps."""
    node = effect.child("defaults")
    if node is None:
        return ()
    kept = _paths(elements_of(effect, "keep"), device.scope)
    every = [one.path for one in device.registers.values() if one.default is not None and one.access.writable]
    named = every if node.is_text else _paths(node.elements(), device.scope)
    return tuple(path for path in named if path not in kept)


def _paths(nodes: list[Value], scope: Scope) -> list[str]:
    return [path_of(scope.register(node), node.text()) for node in nodes]
