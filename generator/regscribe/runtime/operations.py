"""What reading and writing a register takes, step by step, without I/O: each operation is a generator of requests.

An operation is created with a register and run by a part of a driver, which sends the session in first.
"""

# an annotation of an inner function is evaluated at every call otherwise, which costs a read a hundredth of its time
from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from regscribe.runtime import codec
from regscribe.runtime.block import prepare
from regscribe.runtime.errors import ValueRefused
from regscribe.runtime.plan import Item, plan
from regscribe.runtime.request import (
    LOOPBACK,
    READ_FUNCTIONS,
    READ_STATUS,
    WRITE_COIL,
    WRITE_COILS,
    WRITE_REGISTER,
    WRITE_REGISTERS,
    Request,
)
from regscribe.runtime.session import Operation, Pause, Session
from regscribe.runtime.snapshot import Snapshot
from regscribe.runtime.spec import View, choose, registers_of

if TYPE_CHECKING:
    from regscribe.runtime.parts import Command
    from regscribe.runtime.register import Register

T = TypeVar("T")
Task = Callable[[Session], Operation[T]]
"""An operation before it knows its device."""

MAX_DEPTH = 8
"""Dependencies of dependencies; the compiler refuses cycles, this bounds what it let through."""


def _item(register: Register[Any], view: View) -> Item:
    return Item(view.space, view.address(register.at), view.words)


def _fetch(session: Session, items: Iterable[Item]) -> Operation[dict[Item, tuple[int, ...]]]:
    found = {}
    for block in plan(items, session.protocol.read_limits):
        words = yield from session.exchange(Request(block.function, block.address, block.quantity))
        for item in block.items:
            start = item.address - block.address
            found[item] = tuple(words[start : start + item.words])
    return found


def know(session: Session, paths: Iterable[str], *, fresh: bool = False, depth: int = 0) -> Operation[dict[str, Any]]:
    """The values of registers, from memory or (all of them, with `fresh`) from the device."""
    wanted = [path for path in dict.fromkeys(paths) if fresh or path not in session.memory]
    if not wanted:
        return session.memory
    if depth > MAX_DEPTH:
        message = f"the meaning of {wanted[0]} depends on too long a chain of registers"
        raise RuntimeError(message)
    registers = [session.registers[path] for path in wanted]
    views = [register.view() for register in registers]
    for register, view in zip(registers, views, strict=True):
        yield from know(session, register.needs(view), depth=depth + 1)
    found = yield from _fetch(session, map(_item, registers, views))
    values = {
        register.path: codec.decode(register, view, found[_item(register, view)], session.memory, session.givens)
        for register, view in zip(registers, views, strict=True)
    }
    for path, value in values.items():
        if not fresh or session.memory.get(path, value) != value:
            session.remember(path, value)
    return session.memory | values if fresh else session.memory


def read(register: Register[T], view_name: str | None) -> Task[T]:
    """Read one register and decode it."""

    def task(session: Session) -> Operation[T]:
        key = (register.path, view_name)
        if key not in session.prepared:
            view = register.view(view_name)
            yield from know(session, register.needs(view))
            made = codec.decoder(register, view, session.memory, session.givens)
            session.prepared[key] = _read_request(register, view), made
        request, decode = session.prepared[key]
        value: T = decode((yield from session.exchange(request)))
        return value

    return task


def _read_request(register: Register[Any], view: View) -> Request:
    return Request(READ_FUNCTIONS[view.space], view.address(register.at), view.words)


def read_raw(register: Register[Any], view_name: str | None) -> Task[tuple[int, ...]]:
    """Read the words of one register."""

    def task(session: Session) -> Operation[tuple[int, ...]]:
        return (yield from session.exchange(_read_request(register, register.view(view_name))))

    return task


def read_unit(register: Register[Any]) -> Task[str]:
    """The engineering unit under the present configuration."""

    def task(session: Session) -> Operation[str]:
        if isinstance(register.unit, str):
            return register.unit
        state = yield from know(session, registers_of(register.unit))
        return str(choose(register.unit, state, session.givens) or "")

    return task


def read_many(registers: Sequence[Register[Any]]) -> Task[Snapshot]:
    """Read several registers in few requests: one snapshot with a value or an error for each."""

    def task(session: Session) -> Operation[Snapshot]:
        key = tuple(register.path for register in registers)
        if key not in session.prepared:
            needs = [path for register in registers for path in register.needs(register.view())]
            yield from know(session, needs)
            session.prepared[key] = prepare(registers, session)
        values: dict[str, Any] = dict.fromkeys(key)
        for block in session.prepared[key]:
            words = yield from session.exchange(block.request)
            values.update(block.decode(words))
        return Snapshot(values)

    return task


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
            held = yield from session.exchange(_read_request(register, chosen))
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


def loopback(data: int) -> Task[int]:
    """Function 08, subfunction 00: the device echoes one word."""

    def task(session: Session) -> Operation[int]:
        (echo,) = yield from session.exchange(Request(LOOPBACK, 0, 1, (data,)))
        return echo

    return task


def exception_status() -> Task[int]:
    """Function 07: eight status bits."""

    def task(session: Session) -> Operation[int]:
        (status,) = yield from session.exchange(Request(READ_STATUS, 0))
        return status

    return task
