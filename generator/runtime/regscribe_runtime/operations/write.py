"""Write operations of one register: generators of requests, without I/O.

A write is sent once. If its answer is lost, the register is read back.
"""

# an annotation of an inner function is evaluated at every call otherwise, which costs a read a hundredth of its time
from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any, TypeVar

from regscribe_runtime.errors import RegscribeError, ValueRefused, is_lost
from regscribe_runtime.operations.line_change import check_unit, follow
from regscribe_runtime.operations.read import know, present, read
from regscribe_runtime.operations.read_back import (
    RegisterWrite,
    fate_of_lost,
    holds,
    in_view,
    read_back_needs,
    verify_write,
    words_of,
)
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.operations.write_request import (
    EEPROM,
    apply,
    check_condition,
    check_confirmation,
    condition_needs,
    send,
    unlock,
)
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.enums import Flags, Word
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Words
from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.views import View
from regscribe_runtime.values.wire_types import Space
from regscribe_runtime.wire.requests import MASK_REGISTER

T = TypeVar("T")
MASKED = frozenset({Kind.FLAGS, Kind.FIELDS})
"""Kinds whose bits have meanings of their own."""


def write(
    register: Register[Any],
    value: object,
    *,
    view: str | None = None,
    rounded: bool = False,
    confirm: bool = False,
    verify: bool | None = None,
    kept: int = 0,
    before: object = None,
) -> Task[None]:
    """Check, encode and write one register; unlock before and apply after, where the map says so; read it back.

    `verify` None: reads back settings only. `kept`: unnamed bits, as in `codec.encode`. `before`: what it holds; of a
    word of bits only those that differ are written then, if the device has function 22.
    """

    def task(session: Session) -> Operation[None]:
        check_confirmation(register, confirm=confirm)
        chosen = register.write_view(view)
        yield from present(session, register, fresh=True)
        yield from know(session, (*register.needs(chosen), *read_back_needs(register, chosen)))
        state = yield from know(session, (*condition_needs(register), *register.limit_needs), fresh=True)
        check_condition(register, state, session.givens)
        words = codec.encode(register, chosen, value, state, session.givens, rounded=rounded, kept=kept)
        bits = _changed_bits(session, register, chosen, before, words)
        planned = RegisterWrite(register, chosen, words, dict(state), bits=bits)  # whatever is forgotten meanwhile
        check_unit(session, planned)
        if register.persistence in EEPROM and register.can_be_checked:
            found = yield from words_of(session, [planned.target])
            if holds(planned, in_view(planned.target, found[register.path], state, session.givens), session):
                session.wear.add(register.path, spared=1)
                return
        yield from unlock(session, register)
        if register.governs:
            yield from follow(session, planned, register.governs)
            return
        yield from _send(session, planned)
        yield from apply(session, register)
        if register.is_configuration if verify is None else verify:
            yield from verify_write(session, planned)

    return task


def _changed_bits(session: Session, register: Register[Any], view: View, before: object, words: Words) -> int:
    """The bits that differ, if function 22 can write them alone; 0 if not.

    Of other values than words of bits the whole word is meant: one with bits of two masters would be no value.
    """
    able = MASK_REGISTER in session.protocol.functions and view.allows(MASK_REGISTER)
    if (
        not able
        or register.kind not in MASKED
        or not view.readable
        or view.space is not Space.HOLDING
        or view.words > 1
    ):
        return 0
    with suppress(ValueRefused):
        held = before if isinstance(before, int) else 0
        kept = codec.idle_bits(register, held, session.memory, session.givens)
        return codec.encode(register, view, before, session.memory, session.givens, kept=kept)[0] ^ words[0]
    return 0


def _send(session: Session, planned: RegisterWrite) -> Operation[None]:
    try:
        yield from send(session, planned)
    except RegscribeError as error:
        if not is_lost(error):
            raise
        failure = yield from fate_of_lost(session, planned, error)
        if failure is not None:
            raise failure from error


def write_raw(register: Register[Any], words: tuple[int, ...], view_name: str | None) -> Task[None]:
    """Write words in wire order."""

    def task(session: Session) -> Operation[None]:
        view = register.write_view(view_name)
        if len(words) != view.words:
            raise ValueRefused(register.path, f"{len(words)} words for a view of {view.words}")
        yield from present(session, register, fresh=True)
        yield from know(session, read_back_needs(register, view))
        yield from _send(session, RegisterWrite(register, view, tuple(words), dict(session.memory)))

    return task


def change(
    register: Register[T],
    how: Callable[[T], T],
    *,
    confirm: bool,
    verify: bool | None = None,
    view: str | None = None,
) -> Task[T]:
    """Read, modify, write; bits without a meaning, or without one now, stay as they are."""

    def task(session: Session) -> Operation[T]:
        before = yield from read(register, None)(session)
        value = how(before)
        held = int(before) if isinstance(before, Flags | Word) else 0
        if kept := codec.idle_bits(register, held, session.memory, session.givens):
            value = register.value_type.make(int(value) | kept)  # type: ignore[call-overload] # bits are whole numbers
        whole = write(register, value, view=view, confirm=confirm, verify=verify, kept=kept, before=before)
        yield from whole(session)
        return value

    return task
