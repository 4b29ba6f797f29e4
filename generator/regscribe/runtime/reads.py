"""What reading takes, step by step, without I/O: each operation is a generator of requests.

An operation is created with a register and run by a part of a driver, which sends the session in first.
"""

# an annotation of an inner function is evaluated at every call otherwise, which costs a read a hundredth of its time
from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from regscribe.runtime import codec
from regscribe.runtime.block import prepare
from regscribe.runtime.ground import Item
from regscribe.runtime.plan import blocks
from regscribe.runtime.request import READ_FUNCTIONS, Request
from regscribe.runtime.snapshot import Snapshot
from regscribe.runtime.spec import View, choose, registers_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from regscribe.runtime.register import Register
    from regscribe.runtime.session import Operation, Session, Task

T = TypeVar("T")

MAX_DEPTH = 8
"""Dependencies of dependencies; the compiler refuses cycles, this bounds what it let through."""


def _item(register: Register[Any], view: View) -> Item:
    return Item(view.space, view.address(register.at), view.words)


def _fetch(session: Session, items: Iterable[Item]) -> Operation[dict[Item, tuple[int, ...]]]:
    found = {}
    made, _ = blocks([(item,) for item in items], session.terms())
    for block in made:
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
            session.prepared[key] = read_request(register, view), made
        request, decode = session.prepared[key]
        value: T = decode((yield from session.exchange(request)))
        return value

    return task


def read_request(register: Register[Any], view: View) -> Request:
    """The request that reads a register in a view."""
    return Request(READ_FUNCTIONS[view.space], view.address(register.at), view.words)


def read_raw(register: Register[Any], view_name: str | None) -> Task[tuple[int, ...]]:
    """Read the words of one register."""

    def task(session: Session) -> Operation[tuple[int, ...]]:
        return (yield from session.exchange(read_request(register, register.view(view_name))))

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
