"""Commands: each step becomes the words of one request."""

from dataclasses import dataclass

from regscribe.lower.command_words import words_of_value
from regscribe.lower.effects import effects_of
from regscribe.lower.names import identifier, unknown
from regscribe.lower.node import Value, elements_of, items_of, text_of, whole_of, wholes_of
from regscribe.lower.presence import present
from regscribe.lower.rules import UNKNOWN_VIEW
from regscribe.lower.scope import Scope
from regscribe.model import Command, CommandStep, Protocol, Register, Space, View


@dataclass(frozen=True, slots=True)
class CommandScope:
    """What the steps of a command need to know of the model they are for."""

    scope: Scope
    registers: dict[str, Register]
    protocol: Protocol


def commands_of(root: Value, device: CommandScope) -> tuple[Command, ...]:
    """The commands that a model has."""
    models = device.scope.models
    return tuple(
        _command(name, node, device)
        for name, node in items_of(root, "commands")
        if device.scope.model in present(node, models, models)
    )


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
        effects=effects_of(node, device.scope, device.registers),
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
    words = words_of_value(value, target, view) if value else unsigned(wholes_of(node, "words"))
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
