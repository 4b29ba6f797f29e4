"""Writing a register that sets the line itself: the driver follows the device, and says where it was left otherwise.

The device may answer in the old setting, in the new one or not at all, and may change at once or later. So after the
write it is looked for in the new setting, then in the old one, by reading the register back.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from regscribe_runtime.errors import LeftAt, NotWritten, RegscribeError, ValueRefused, lost
from regscribe_runtime.operations.read import read_request
from regscribe_runtime.operations.read_back import Target, differs, is_lost, meaning, same, words_of
from regscribe_runtime.operations.session import Operation, Pause, Session
from regscribe_runtime.operations.write_request import applied, called, send
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Words
from regscribe_runtime.values.conditions import State
from regscribe_runtime.values.facts import Governs, Setting
from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.numbers import brief
from regscribe_runtime.values.serial_line import ADDRESSINGS, PARITIES, LineChange
from regscribe_runtime.wire.requests import verify

MARKS = frozenset({Kind.STRING, Kind.VERSION})
"""Kinds of registers whose words tell a device: they do not change, and no neighbour holds the same."""

LATER = "restart"

FIRST_UNIT = 1
"""Unit 0 is the broadcast, which nobody answers."""


class _Move(NamedTuple):
    """A change of the line: how to talk before and after, and the words by which the device is known again."""

    register: Register[Any]
    target: Target
    sent: Words
    state: State
    old: LineChange
    marks: dict[str, Words]


def allowed(session: Session, target: Target, words: Words, state: State) -> None:
    """Refuse a unit id at which no such device can be reached: ValueRefused, before anything is sent."""
    register, view = target
    if not register.governs or register.governs.setting is not Setting.ADDRESS:
        return
    value = meaning(register, view, words, state, session, named=False)
    low, high = session.protocol.unit_ids
    low = max(low, FIRST_UNIT)
    if not low <= value <= high or value != int(value):
        raise ValueRefused(register.path, f"{brief(value)} is no unit id of this device: they are {low} to {high}")


def follow(session: Session, target: Target, words: Words, state: State) -> Operation[None]:
    """Write a register that governs the line, apply it, and talk on in the new setting.

    ValueRefused if the new unit id is taken; NotWritten, WriteUnknown or LeftAt say where the device was left.
    """
    register, _ = target
    old = _present(session)
    governs: Governs = register.governs  # type: ignore[assignment] # that is why we are here
    value = meaning(register, target[1], words, state, session)
    new = list(_meant(governs, value)) or list(_guesses(session, governs))
    session.home = old
    yield from _free(session, target, governs, words, old)
    marks = (yield from _marks(session)) if governs.setting is Setting.ADDRESSING else {}
    cause = yield from _told(session, target, words, governs)
    move = _Move(register, target, words, state, old, marks)  # pyright: ignore[reportArgumentType] # a register is a descriptor, but no attribute of this tuple
    yield from _found(session, move, [] if governs.since == LATER else new, cause, called(value))
    session.home = None


def _present(session: Session) -> LineChange:
    line = session.line
    if line is None:
        return LineChange(session.unit, addressing=session.addressing)
    return LineChange(session.unit, line.baud, line.data_bits, line.parity, line.stop_bits, session.addressing)


def _meant(governs: Governs, code: Any) -> Iterator[LineChange]:
    """What a code of the register, a value of use, sets; nothing where the manual does not print it."""
    if governs.setting is Setting.ADDRESS:
        yield LineChange(unit=int(code))
    elif (text := governs.value(code)) is not None:
        yield _tuned(governs.setting, text)


def _tuned(setting: Setting, text: str) -> LineChange:
    if setting is Setting.FORMAT:
        return LineChange(data_bits=int(text[0]), parity=text[1], stop_bits=int(text[2]))
    value: Any = text if setting in {Setting.PARITY, Setting.ADDRESSING} else int(text)
    return LineChange(**{setting: value})


def _guesses(session: Session, governs: Governs) -> Iterator[LineChange]:
    """All that a setting may become where the manual does not print its codes."""
    protocol = session.protocol
    others = {
        Setting.BAUD: tuple(map(str, protocol.serial.bauds)),
        Setting.PARITY: PARITIES,
        Setting.FORMAT: protocol.serial.formats,
        Setting.ADDRESSING: tuple(ADDRESSINGS),
    }
    if session.line is not None or governs.setting is Setting.ADDRESSING:
        yield from (_tuned(governs.setting, text) for text in others.get(governs.setting, ()))


def _free(session: Session, target: Target, governs: Governs, words: Words, old: LineChange) -> Operation[None]:
    """Refuse a unit id at which another device answers: two at one id garble each other."""
    register, _ = target
    if governs.setting is not Setting.ADDRESS:
        return
    unit = int(meaning(*target, words, {}, session))
    if unit == session.unit:
        return
    request = read_request(register, register.seen_in(target[1]))
    yield LineChange(unit=unit)
    try:
        reply = yield request  # once: nobody is expected there
        found = verify(request, reply, unit=unit, protocol=session.protocol) if reply else ()
    except RegscribeError:
        found = ()  # nobody there, or nobody that knows this register
    yield old
    if found and same(*target, found, words, {}, session):
        raise ValueRefused(register.path, f"unit {unit} answers already: two units of one id would garble each other")


def _marks(session: Session) -> Operation[dict[str, Words]]:
    registers = [one for one in session.registers.values() if one.kind in MARKS and one.access.readable]
    return (yield from words_of(session, [(one, one.read_view()) for one in registers]))


def _told(session: Session, target: Target, words: Words, governs: Governs) -> Operation[RegscribeError | None]:
    """Send the write, and the command that applies it; what happened to the answer, None if it came."""
    register, view = target
    cause: RegscribeError | None = None
    try:
        yield from send(session, register, view, words)
    except RegscribeError as error:
        if not is_lost(error):
            raise
        cause = error
    if register.apply and cause is None:
        try:
            yield from applied(session, register)
        except RegscribeError as error:
            if governs.since != "apply":
                raise
            cause = error
    return cause


def _found(
    session: Session, move: _Move, new: list[LineChange], cause: RegscribeError | None, value: str
) -> Operation[None]:
    register = move.register
    if register.settle:
        yield Pause(register.settle / 1000)
    for change in new:
        yield change
        if _took(session, move, (yield from _read(session, move))):
            return
        yield move.old
    read = yield from _read(session, move)
    if read is None:
        raise _left(move, new, cause, value)
    if _took(session, move, read):
        return  # it holds the value and talks as before: it will change later
    if cause is None:
        raise differs(session, move.target, move.sent, read, move.state)
    reason = f"the device still talks as before ({shown(move.old)}) and does not hold {value}"
    raise lost(NotWritten, register.path, reason, cause) from cause


def _took(session: Session, move: _Move, read: Words | None) -> bool:
    return read is not None and same(*move.target, read, move.sent, move.state, session)


def _read(session: Session, move: _Move) -> Operation[Words | None]:
    """The words of the register as one now talks to the device; None if it does not answer, or is another one."""
    known = [(session.registers[path], session.registers[path].read_view()) for path in move.marks]
    try:
        found = yield from words_of(session, [move.target, *known])
    except RegscribeError:
        return None
    if any(found[path] != words for path, words in move.marks.items()):
        return None  # addresses counted otherwise: what was read are other registers
    return found[move.register.path]


def _left(move: _Move, new: list[LineChange], cause: RegscribeError | None, value: str) -> LeftAt:
    told = f"its answer to the write was lost ({cause})" if cause else "it answered the write"
    if new:
        places = "in either setting" if len(new) == 1 else f"in any of {len(new)} settings"
        reason = f"{told}, and now it is not found {places}; this driver talks as before"
    else:
        reason = f"{told}, and now it does not answer as before. The manual does not say what {value} sets"
    asked = "; ".join(shown(one) for one in new) or value
    error = LeftAt(move.register.path, before=shown(move.old), asked=asked, reason=reason)
    error.__cause__ = cause
    return error


def shown(change: LineChange) -> str:
    """How a device talks, in words."""
    character = f"{change.data_bits or ''}{change.parity or ''}{change.stop_bits or ''}"
    parts = (
        "" if change.unit is None else f"unit {change.unit}",
        "" if change.baud is None else f"{change.baud} baud",
        f"format {character}" if character else "",
        "" if change.addressing is None else f"{change.addressing} addresses",
    )
    return ", ".join(part for part in parts if part)
