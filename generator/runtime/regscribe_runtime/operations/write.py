"""What writing one register takes, step by step, without I/O: generators of requests, as in `reads`.

A write is sent once. If its answer is lost, the register is read back, and only then it counts as written or not.
"""

# an annotation of an inner function is evaluated at every call otherwise, which costs a read a hundredth of its time
from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from regscribe_runtime.errors import RegscribeError, ValueRefused
from regscribe_runtime.operations.line_change import allowed, follow
from regscribe_runtime.operations.read import know, read
from regscribe_runtime.operations.read_back import (
    Target,
    fate_of_lost,
    in_view,
    is_lost,
    read_back_needs,
    verified,
    words_of,
)
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.operations.write_request import (
    EEPROM,
    applied,
    condition_needs,
    confirmed,
    permitted,
    send,
    unlocked,
)
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.enums import Flags, unnamed_bits
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Words
from regscribe_runtime.values.conditions import State
from regscribe_runtime.values.kinds import Access
from regscribe_runtime.values.views import View

T = TypeVar("T")


def write(
    register: Register[Any],
    value: object,
    *,
    view: str | None = None,
    rounded: bool = False,
    confirm: bool = False,
    verify: bool | None = None,
    kept: int = 0,
) -> Task[None]:
    """Check, encode and write one register; unlock before and apply after, where the map says so; read it back.

    `verify` None: reads back what the device keeps as its configuration. `kept`: bits without a name, as in
    `codec.encode`.
    """

    def task(session: Session) -> Operation[None]:
        confirmed(register, confirm=confirm)
        chosen = register.write_view(view)
        yield from know(session, (*register.needs(chosen), *read_back_needs(register, chosen)))
        state = yield from know(session, (*condition_needs(register), *register.limit_needs), fresh=True)
        permitted(register, state, session.givens)
        words = codec.encode(register, chosen, value, state, session.givens, rounded=rounded, kept=kept)
        allowed(session, (register, chosen), words, state)
        if (yield from _held(session, (register, chosen), words, state)):
            session.wear.add(register.path, spared=1)
            return
        state = dict(state)  # what the words mean, whatever is forgotten meanwhile
        yield from unlocked(session, register)
        if register.governs:
            yield from follow(session, (register, chosen), words, state)
            return
        yield from _sent(session, register, chosen, words, state)
        yield from applied(session, register)
        if register.is_configuration if verify is None else verify:
            yield from verified(session, (register, chosen), words, state)

    return task


def _held(session: Session, target: Target, words: Words, state: State) -> Operation[bool]:
    """Whether a register in the EEPROM holds these words already, so that a write would only wear it out."""
    register, _ = target
    if register.persistence not in EEPROM or register.access is not Access.READ_WRITE:
        return False
    found = yield from words_of(session, [target])
    return in_view(target, found[register.path], state) == words


def _sent(session: Session, register: Register[Any], view: View, words: Words, state: State) -> Operation[None]:
    try:
        yield from send(session, register, view, words)
    except RegscribeError as error:
        if not is_lost(error):
            raise
        failure = yield from fate_of_lost(session, (register, view), words, state, error)
        if failure is not None:
            raise failure from error


def write_raw(register: Register[Any], words: tuple[int, ...], view_name: str | None) -> Task[None]:
    """Write words as they are."""

    def task(session: Session) -> Operation[None]:
        view = register.write_view(view_name)
        if len(words) != view.words:
            raise ValueRefused(register.path, f"{len(words)} words for a view of {view.words}")
        yield from know(session, read_back_needs(register, view))
        yield from _sent(session, register, view, tuple(words), dict(session.memory))

    return task


def change(register: Register[T], how: Callable[[T], T], *, confirm: bool, verify: bool | None = None) -> Task[T]:
    """Read, modify, write: three steps, no device does them as one. Bits without a name stay as they are."""

    def task(session: Session) -> Operation[T]:
        before = yield from read(register, None)(session)
        value = how(before)
        kept = 0
        if isinstance(before, Flags) and (kept := unnamed_bits(before)):
            value = register.value_type.make(int(value) | kept)  # type: ignore[call-overload] # flags are whole numbers
        yield from write(register, value, confirm=confirm, verify=verify, kept=kept)(session)
        return value

    return task
