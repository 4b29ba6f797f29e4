"""What writing and commanding take, step by step, without I/O: generators of requests, as in `reads`."""

# an annotation of an inner function is evaluated at every call otherwise, which costs a read a hundredth of its time
from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from regscribe.runtime import codec
from regscribe.runtime.errors import ValueRefused
from regscribe.runtime.reads import know, read, read_request
from regscribe.runtime.request import WRITE_COIL, WRITE_COILS, WRITE_REGISTER, WRITE_REGISTERS, Request
from regscribe.runtime.session import Operation, Pause, Session, Task

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from regscribe.runtime.parts import Command
    from regscribe.runtime.register import Register
    from regscribe.runtime.spec import View

T = TypeVar("T")


def write(register: Register[Any], value: object, *, view: str | None, rounded: bool, confirm: bool) -> Task[None]:
    """Check, encode and write one register; unlock before and apply after, where the map says so."""

    def task(session: Session) -> Operation[None]:
        if register.danger and not confirm:
            raise ValueRefused(register.path, f"writing it is dangerous ({register.danger}): pass confirm=True")
        chosen = register.view(view)
        yield from know(session, register.needs(chosen))
        yield from _permitted(session, register)
        state = yield from know(session, register.limit_needs, fresh=True)
        words = codec.encode(register, chosen, value, state, session.givens, rounded=rounded)
        if register.persistence in {"eeprom", "both"}:  # spares a write cycle of the EEPROM
            held = yield from session.exchange(read_request(register, chosen))
            if held == words:
                return
        yield from _command(session, register.unlock)
        yield from _send(session, register, chosen, words)
        yield from _command(session, register.apply)

    return task


def _permitted(session: Session, register: Register[Any]) -> Operation[None]:
    if register.writable is None:
        return
    when, reason = register.writable
    paths = [test.register for test in when if test.register]
    state = yield from know(session, paths, fresh=True)
    if not all(test.holds(state, session.givens) for test in when):
        now = ", ".join(f"{path} is {state[path]!r}" for path in dict.fromkeys(paths))
        raise ValueRefused(register.path, f"{reason}; now {now}")


def _send(session: Session, register: Register[Any], view: View, words: tuple[int, ...]) -> Operation[None]:
    address = view.address(register.at)
    yield from session.exchange(Request(_write_function(session, view, words), address, len(words), words))
    session.forget([register.path])


def _write_function(session: Session, view: View, words: tuple[int, ...]) -> int:
    allowed = [code for code in session.protocol.functions if not view.functions or code in view.functions]
    single, several = (WRITE_COIL, WRITE_COILS) if view.space == "coil" else (WRITE_REGISTER, WRITE_REGISTERS)
    return single if len(words) == 1 and single in allowed else several


def write_raw(register: Register[Any], words: tuple[int, ...], view_name: str | None) -> Task[None]:
    """Write words as they are."""

    def task(session: Session) -> Operation[None]:
        view = register.view(view_name)
        if len(words) != view.words:
            raise ValueRefused(register.path, f"{len(words)} words for a view of {view.words}")
        yield from _send(session, register, view, tuple(words))

    return task


def change(register: Register[T], how: Callable[[T], T], *, confirm: bool) -> Task[T]:
    """Read, modify, write."""

    def task(session: Session) -> Operation[T]:
        value = how((yield from read(register, None)(session)))
        yield from write(register, value, view=None, rounded=False, confirm=confirm)(session)
        return value

    return task


def _command(session: Session, name: str) -> Generator[Any, Any, None]:
    if name:
        yield from run(session.commands[name], confirm=True)(session)


def run(command: Command, *, confirm: bool) -> Task[None]:
    """Send the steps of a command; afterwards nothing remembered counts."""

    def task(session: Session) -> Operation[None]:
        if command.danger and not confirm:
            raise ValueRefused(command.id, f"this command is dangerous ({command.danger}): pass confirm=True")
        for function, address, words in command.steps:
            if function:
                yield from session.exchange(Request(function, address, len(words), words))
            else:
                yield Pause(address / 1000)
        session.forget()

    return task
