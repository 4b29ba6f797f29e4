"""Steps of a write: its request, checks before it, commands around it."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Protocol

from regscribe_runtime.errors import (
    ConditionNotMet,
    NotApplied,
    NotWritten,
    RegscribeError,
    ValueRefused,
    WriteUnknown,
    is_lost,
)
from regscribe_runtime.errors import lost as failed
from regscribe_runtime.operations.locate import base_of
from regscribe_runtime.operations.read import exists, know
from regscribe_runtime.operations.read_back import RegisterWrite
from regscribe_runtime.operations.session import Operation, Pause, Session, Task
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.presence import seen
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Words
from regscribe_runtime.values.conditions import Condition, Givens, State
from regscribe_runtime.values.facts import CommandStep
from regscribe_runtime.values.views import View
from regscribe_runtime.wire.requests import MASK_REGISTER, Request


class Sendable(Protocol):
    """A command as it is sent."""

    id: str
    danger: str
    steps: tuple[CommandStep, ...]
    arguments: Mapping[str, Register[Any]]
    when: Condition


WORD = 0xFFFF
EEPROM = frozenset({"eeprom", "both"})
"""Persistence of registers whose writes wear a memory out."""


def write_request(session: Session, view: View, address: int, words: Words) -> Request:
    """The request that writes words at an address in a view."""
    allowed = [code for code in session.protocol.functions if view.allows(code)]
    single, several = view.space.write_functions
    alone = len(words) == view.space.each and single in allowed
    function = single if alone and (view.space.each == 1 or several not in allowed) else several
    return Request(function, address, len(words), words)


def send(session: Session, one: RegisterWrite) -> Operation[None]:
    """Send one write; afterwards, also after an error, the remembered value of the register is forgotten."""
    here = session.registers.get(one.path, one.register)
    if here.at != one.register.at:
        raise ValueRefused(one.path, f"it moved meanwhile: {', '.join(here.counters)} changed; write it once more")
    try:
        if one.bits:
            request = Request(MASK_REGISTER, one.address, 1, (~one.bits & WORD, one.words[0] & one.bits))
        else:
            request = write_request(session, one.view, one.address, one.words)
        yield from session.exchange(request)
    finally:
        session.forget([one.path])
        if one.register.persistence in EEPROM:
            session.wear.add(one.path, written=1)


def check_confirmation(register: Register[Any], *, confirm: bool) -> None:
    """Refuse a dangerous write that is not confirmed."""
    if register.danger and not confirm:
        raise ValueRefused(register.path, f"writing it is dangerous ({register.danger}): pass confirm=True")


def check_condition(register: Register[Any], state: State, givens: Givens) -> None:
    """Refuse a write whose condition does not hold in `state`."""
    if register.writable is None:
        return
    when, reason = register.writable
    if not when.holds(state, givens):
        raise ConditionNotMet(register.path, reason, seen(when, state, givens))


def condition_needs(register: Register[Any]) -> tuple[str, ...]:
    """The registers that decide whether a register can be written."""
    return register.writable.when.registers if register.writable else ()


def run(command: Sendable, *, confirm: bool, values: Mapping[str, object] = MappingProxyType({})) -> Task[None]:
    """Send the steps of a command with `values` for its arguments; afterwards everything remembered is forgotten."""

    def task(session: Session) -> Operation[None]:
        if command.danger and not confirm:
            raise ValueRefused(command.id, f"this command is dangerous ({command.danger}): pass confirm=True")
        yield from exists(session, command.id, command.when)
        given = yield from _words_of_arguments(session, command, values)
        steps = [one._replace(words=given.get(one.argument, one.words)) for one in command.steps]
        try:
            for number, step in enumerate(steps, start=1):
                if (yield from _holds(session, step.when)):
                    yield from _send_step(session, command, number, step)
        finally:
            session.forget()

    return task


def _holds(session: Session, when: Condition) -> Operation[bool]:
    """Whether a condition holds now, by what the device says."""
    state = yield from know(session, when.registers, fresh=True)
    return when.holds(state, session.givens)


def _words_of_arguments(
    session: Session, command: Sendable, values: Mapping[str, object]
) -> Operation[dict[str, Words]]:
    """The words of each argument; ValueRefused for one that is missing, strange, or of a value that it cannot have."""
    for name in (*command.arguments, *values):
        if (name in values) is not (name in command.arguments):
            known = ", ".join(command.arguments) or "none"
            what = "is no argument" if name in values else "is needed"
            raise ValueRefused(command.id, f"`{name}` {what}; its arguments are: {known}")
    found = {}
    for name, register in command.arguments.items():
        view = register.write_view()
        state = yield from know(session, (*register.needs(view), *register.limit_needs), fresh=True)
        found[name] = codec.encode(register, view, values[name], state, session.givens)
    return found


def _send_step(session: Session, command: Sendable, number: int, step: CommandStep) -> Operation[None]:
    if not step.words:
        yield Pause(step.wait / 1000)
        return
    base = yield from base_of(session, command.id, step.block)
    try:
        yield from session.exchange(Request(step.function, base + step.address, len(step.words), step.words))
    except RegscribeError as error:
        if not is_lost(error):
            raise
        which = f" to step {number} of {len(command.steps)}" if len(command.steps) > 1 else ""
        reason = f"the answer{which} was lost ({error}); whether the command was carried out is unknown"
        raise failed(WriteUnknown, command.id, reason, error) from error


def unlock(session: Session, register: Register[Any]) -> Operation[None]:
    """Run the command that must come before a write, if there is one."""
    if not register.unlock:
        return
    try:
        yield from run(session.commands[register.unlock], confirm=True)(session)
    except WriteUnknown as error:
        raise failed(NotWritten, register.path, f"nothing was sent, because {error}", _cause(error)) from error


def apply(session: Session, register: Register[Any]) -> Operation[None]:
    """Run the command that makes a write take effect, if there is one; NotApplied if that fails."""
    if not register.apply:
        return
    try:
        yield from run(session.commands[register.apply], confirm=True)(session)
    except RegscribeError as error:
        reason = f"written, but not in effect: {register.apply} failed ({error})"
        raise failed(NotApplied, register.path, reason, _cause(error)) from error


def _cause(error: Exception) -> Exception:
    return error.__cause__ if isinstance(error.__cause__, Exception) else error
