"""Commands: each step becomes the words of one request; effects are what changes besides."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import NamedTuple

from regscribe.lower.blocks import block_named
from regscribe.lower.conditions import both, condition_of
from regscribe.lower.node import Value
from regscribe.lower.register_values import named_value
from regscribe.lower.registers import register_of
from regscribe.lower.rules import IDLE_KEY, NOT_CONSTANT, UNKNOWN_ARGUMENT, UNKNOWN_MEMBER, UNKNOWN_VIEW
from regscribe.lower.scope import Scope
from regscribe.lower.subject import Subject, code_of_text, subject_of
from regscribe.lower.texts import identifier, known_name
from regscribe.lower.tree import TreeNode, TreePosition
from regscribe.lower.variants import settings_of
from regscribe.model import (
    Access,
    Command,
    CommandStep,
    Condition,
    Effect,
    Kind,
    Protocol,
    Register,
    Rounding,
    Space,
    View,
)
from regscribe.reference import RefusedError, UnknownValueError, encode
from regscribe_runtime.values.kinds import OCTETS

TAKEN = "taken"
"""The name of the only view of an argument that is written to a register."""
_INSTEAD = "choose another value or view, or give the `words` that the manual prints"


@dataclass(frozen=True, slots=True)
class CommandScope:
    """What the steps of a command refer to: the names, registers and protocol of one model."""

    scope: Scope
    registers: dict[str, Register]
    protocol: Protocol


class Arguments(NamedTuple):
    """The arguments of a command: where the map declares each, and the register that it is written as."""

    nodes: dict[str, Value]
    taken: dict[str, Register]


def commands_of(root: Value, device: CommandScope) -> tuple[Command, ...]:
    """The commands that a model has."""
    return tuple(_command(node, device) for _, node in root.items_of("commands") if device.scope.has(node))


def _command(node: Value, device: CommandScope) -> Command:
    nodes = dict(node.items_of("arguments"))
    arguments = Arguments(nodes, {name: _argument(each, node.key, device) for name, each in nodes.items()})
    steps = [_step_when(step, device, arguments) for step in node.elements_of("steps")]
    _report_idle(node, {step.argument for step, _ in steps})
    return Command(
        id=node.key if node.key.isidentifier() else identifier(node, label=node.key, given=None),
        name=node.text_of("name", node.key),
        steps=tuple(step for step, _ in steps),
        step_registers=tuple(path for _, path in steps),
        arguments=tuple(arguments.taken.items()),
        when=both(condition_of(node, device.scope), *_existence(steps, device)),
        description=node.text_of("description"),
        section=node.text_of("source"),
        danger=node.text_of("danger"),
        effects=tuple(_effect(effect, device) for effect in node.elements_of("effects") if device.scope.has(effect)),
        span=node.key_span,
    )


def _existence(steps: list[tuple[CommandStep, str]], device: CommandScope) -> Iterator[Condition]:
    """The conditions under which the registers exist that a command writes in any case."""
    targets = (path for step, path in steps if step.when.always and path in device.registers)
    return (device.registers[path].when for path in targets)


def _argument(node: Value, command: str, device: CommandScope) -> Register:
    """An argument as a register that is only written; where a step writes a register with it, that tells its type."""
    scope, settings = device.scope, settings_of([node])
    stated: dict[str, int | str] = {"at": 0, "access": Access.WRITE.value, "name": node.key}
    settings.update({key: Value(node.context, node.path, value) for key, value in stated.items()})
    place = TreePosition(scope.model, scope.models, scope.models, "", "", scope.map.mapping_of("sets"))
    return register_of(TreeNode(node, node.key, f"{command}.{node.key}", settings, place), scope)


def _report_idle(node: Value, used: set[str]) -> None:
    for name, each in node.items_of("arguments"):
        if name not in used:
            each.report(IDLE_KEY, f"no step sends the argument `{name}`", remedy="remove it, or send it", at_key=True)


def _named_argument(node: Value | None, arguments: Arguments) -> str:
    """The argument that the `value` of a step names; empty where it names none."""
    name = node.child("argument") if node else None
    return known_name(name, UNKNOWN_ARGUMENT, "argument", arguments.nodes) if name else ""


def _from_register(name: str, target: Register, view: View, arguments: Arguments) -> None:
    """Let an argument be of the type of the register that a step writes with it."""
    node, own = arguments.nodes[name], arguments.taken[name]
    keys = {key for key, _ in node.items()} - {"description"}
    if keys or own.views[0].name == TAKEN:
        message = f"the argument `{name}` is written to `{target.path}`, which has a type of its own"
        node.report(IDLE_KEY, message, remedy="remove its keys, or write `at` in place of `register`", at_key=True)
        return
    views = (view._replace(name=TAKEN, preferred=False),)
    arguments.taken[name] = replace(
        target,
        id=name,
        path=own.path,
        name=name,
        description=own.description,
        access=Access.WRITE,
        views=views,
        aliases=(),
        unlock="",
        apply="",
        danger="",
        stays="",
        group="",
        writable=None,
        governs=None,
        persistence="",
    )


def _step_when(node: Value, device: CommandScope, arguments: Arguments) -> tuple[CommandStep, str]:
    step, path = _step(node, device, arguments)
    return step._replace(when=condition_of(node, device.scope)), path


def _step(node: Value, device: CommandScope, arguments: Arguments) -> tuple[CommandStep, str]:
    """A step, and the path of the register that it names."""
    argument = _named_argument(node.child("value"), arguments)
    register = node.child("register")
    if node.child("wait"):
        return CommandStep(0, 0, (), node.whole_of("wait")), ""
    if register is None:
        own = arguments.taken.get(argument)
        words = (0,) * own.views[0].words if own else unsigned(node.wholes_of("words"))
        function = _function(node, len(words), None, device)
        block = block_named(node, device.scope.map)
        return CommandStep(function, node.whole_of("at"), words, block=block, argument=argument), ""
    entry = device.scope.register(register)
    if entry is None:
        return CommandStep(0, 0, ()), register.text()
    target = device.registers[entry.path]
    if node.child("view"):
        view = view_of(node.child("view"), target)
    else:  # where the base view is for reading alone, the first one that a write may address
        view = next((each for each in target.views if each.writable), target.base)
    value = node.child("value")
    if argument in arguments.nodes:
        _from_register(argument, target, view, arguments)
        words = (0,) * view.words
    else:
        words = _words_of_value(value, target, view) if value else unsigned(node.wholes_of("words"))
    function = _function(node, len(words), view, device)
    return CommandStep(function, view.address(target.at), words, block=target.block, argument=argument), entry.path


def step_of_value(node: Value, register: str, device: CommandScope) -> tuple[CommandStep, str]:
    """The step that writes a value to a register, whose name is the key of `node`, and the register's path."""
    entry = device.scope.register(node, register, at_key=True)
    if entry is None:
        return CommandStep(0, 0, ()), register
    target = device.registers[entry.path]
    words = _words_of_value(node, target, target.write_view)
    function = _function(node, len(words), target.write_view, device)
    return CommandStep(function, target.write_view.address(target.at), words), entry.path


def _function(node: Value, count: int, view: View | None, device: CommandScope) -> int:
    if node.child("function"):
        return node.whole_of("function")
    has = device.protocol.functions
    usual = Space.HOLDING if set(has) & set(Space.HOLDING.write_functions) else Space.COIL
    space = view.space if view else node.choice_of("space", usual)
    single, several = space.write_functions or Space.HOLDING.write_functions
    allowed = [code for code in device.protocol.functions if not view or view.allows(code)]
    alone = count == space.each and single in allowed
    return single if alone and (space.each == 1 or several not in allowed) else several


def view_of(node: Value | None, register: Register) -> View:
    """The view of a register that `node` names, the base view where it is None; RS0323 for an unknown one."""
    if node is None:
        return register.base
    views = {view.name: view for view in register.views}
    return views.get(known_name(node, UNKNOWN_VIEW, "view", views, of=register.path), register.base)


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
    scope = device.scope
    subjects = [(each, subject_of(each, key, scope)) for key, each in node.items_of("set")]
    return Effect(
        when=condition_of(node, scope),
        sets=tuple((subject.path, _value(each, subject, device)) for each, subject in subjects if subject),
        defaults=_defaults(node, device),
        unlatch=node.truth_of("unlatch"),
    )


def _value(node: Value, subject: Subject, device: CommandScope) -> Fraction | str:
    register = None if subject.field else device.registers.get(subject.path)
    if register and (register.kind in OCTETS or (register.kind is Kind.VERSION and node.is_text)):
        return node.text()
    return code_of_text(node, subject, device.scope) if node.is_text else node.number()


def _defaults(effect: Value, device: CommandScope) -> tuple[str, ...]:
    """The registers that an effect returns to their defaults, but those that it keeps."""
    node = effect.child("defaults")
    if node is None:
        return ()
    kept = [device.scope.path(each) for each in effect.elements_of("keep")]
    if node.is_text:
        named = [one.path for one in device.registers.values() if one.default is not None and one.access.writable]
    else:
        named = [device.scope.path(each) for each in node.elements()]
    return tuple(path for path in named if path not in kept)
