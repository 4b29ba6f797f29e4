"""One write on its way: its request, what must hold before it, and the commands around it."""

from __future__ import annotations

from typing import Any, Protocol

from regscribe_runtime.errors import (
    ConditionNotMet,
    NotApplied,
    NotWritten,
    RegscribeError,
    ValueRefused,
    WriteUnknown,
)
from regscribe_runtime.errors import lost as failed
from regscribe_runtime.operations.read_back import is_lost
from regscribe_runtime.operations.session import Operation, Pause, Session, Task
from regscribe_runtime.registers.enums import Choice, SpecialNumber
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Words
from regscribe_runtime.values.conditions import Givens, Is, State
from regscribe_runtime.values.facts import CommandStep
from regscribe_runtime.values.views import View
from regscribe_runtime.wire.requests import Request


class Sendable(Protocol):
    """What is sent of a command."""

    id: str
    danger: str
    steps: tuple[CommandStep, ...]


EEPROM = frozenset({"eeprom", "both"})
"""Where a write wears the memory out."""


def write_request(session: Session, view: View, address: int, words: Words) -> Request:
    """The request that writes words at an address in a view."""
    allowed = [code for code in session.protocol.functions if view.allows(code)]
    single, several = view.space.write_functions
    function = single if len(words) == 1 and single in allowed else several
    return Request(function, address, len(words), words)


def send(session: Session, register: Register[Any], view: View, words: Words) -> Operation[None]:
    """Send one write; whatever its end, what was remembered of the register is forgotten."""
    try:
        yield from session.exchange(write_request(session, view, view.address(register.at), words))
    finally:
        session.forget([register.path])
        if register.persistence in EEPROM:
            session.wear.add(register.path, written=1)


def confirmed(register: Register[Any], *, confirm: bool) -> None:
    """Refuse a dangerous write that is not confirmed."""
    if register.danger and not confirm:
        raise ValueRefused(register.path, f"writing it is dangerous ({register.danger}): pass confirm=True")


def permitted(register: Register[Any], state: State, givens: Givens) -> None:
    """Refuse a write whose condition does not hold in `state`."""
    if register.writable is None:
        return
    when, reason = register.writable
    if not when.holds(state, givens):
        present = dict(_present(test, state) for test in when.tests if test.register)
        raise ConditionNotMet(register.path, reason, present)


def _present(test: Is, state: State) -> tuple[str, str]:
    """A register (or bit field) that a test asks for, and its value as it is called."""
    value = state[test.register]
    for name in getattr(value, "parts", ()) if test.bits else ():
        part = vars(type(value))[name]
        if (part.low, part.high) == test.bits:
            return f"{test.register}.{name}", called(getattr(value, name))
    return test.register, called(value)


def called(value: Any) -> str:
    """A value in words: the name of an enum member, else as Python shows it."""
    return str(value.name) if isinstance(value, Choice | SpecialNumber) else repr(value)


def condition_needs(register: Register[Any]) -> tuple[str, ...]:
    """The registers that decide whether it can be written."""
    return register.writable.when.registers if register.writable else ()


def run(command: Sendable, *, confirm: bool) -> Task[None]:
    """Send the steps of a command; afterwards nothing remembered counts."""

    def task(session: Session) -> Operation[None]:
        if command.danger and not confirm:
            raise ValueRefused(command.id, f"this command is dangerous ({command.danger}): pass confirm=True")
        try:
            for number, step in enumerate(command.steps, start=1):
                yield from _step(session, command, number, step)
        finally:
            session.forget()

    return task


def _step(session: Session, command: Sendable, number: int, step: CommandStep) -> Operation[None]:
    if not step.words:
        yield Pause(step.wait / 1000)
        return
    try:
        yield from session.exchange(Request(step.function, step.address, len(step.words), step.words))
    except RegscribeError as error:
        if not is_lost(error):
            raise
        which = f" to step {number} of {len(command.steps)}" if len(command.steps) > 1 else ""
        reason = f"the answer{which} was lost ({error}); whether the command was carried out is unknown"
        raise failed(WriteUnknown, command.id, reason, error) from error


def unlocked(session: Session, register: Register[Any]) -> Operation[None]:
    """Run the command that must come before a write, if there is one."""
    if not register.unlock:
        return
    try:
        yield from run(session.commands[register.unlock], confirm=True)(session)
    except WriteUnknown as error:
        raise failed(NotWritten, register.path, f"nothing was sent, because {error}", _cause(error)) from error


def applied(session: Session, register: Register[Any]) -> Operation[None]:
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
