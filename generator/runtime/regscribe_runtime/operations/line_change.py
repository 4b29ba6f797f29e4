"""Writes of registers that set the line itself: the driver follows the device, or says where it was left.

The device may answer in the old setting, in the new one or not at all, and may change at once or later. So the
register is read back in the new setting, then in the old one.
"""

from __future__ import annotations

from typing import Any

from regscribe_runtime.errors import LeftAt, NotWritten, RegscribeError, ValueRefused, is_lost, lost
from regscribe_runtime.operations.read import read_request
from regscribe_runtime.operations.read_back import RegisterWrite, words_of
from regscribe_runtime.operations.session import Operation, Pause, Session
from regscribe_runtime.operations.write_request import apply, send
from regscribe_runtime.registers.presence import value_text
from regscribe_runtime.report import Words
from regscribe_runtime.values.facts import Governs, Setting
from regscribe_runtime.values.kinds import OCTETS, Kind
from regscribe_runtime.values.numbers import brief
from regscribe_runtime.values.serial_line import ADDRESSINGS, PARITIES, LineChange
from regscribe_runtime.wire.requests import verify

MARKS = OCTETS | {Kind.VERSION}
"""Kinds of registers whose words identify a device: they do not change, and no neighbour holds the same."""

FIRST_UNIT = 1
"""Unit 0 is the broadcast, which nobody answers."""


def check_unit(session: Session, one: RegisterWrite) -> None:
    """ValueRefused for a write of a unit id at which no such device can be reached."""
    if not one.register.governs or one.register.governs.setting is not Setting.ADDRESS:
        return
    value = one.value(session, named=False)
    low, high = session.protocol.unit_ids
    low = max(low, FIRST_UNIT)
    if not low <= value <= high or value != int(value):
        raise ValueRefused(one.path, f"{brief(value)} is no unit id of this device: they are {low} to {high}")


def follow(session: Session, one: RegisterWrite, governs: Governs) -> Operation[None]:
    """Write a register that governs the line, apply it, and go on in the new setting.

    ValueRefused if the new unit id is taken; NotWritten, WriteUnknown or LeftAt say where the device was left.
    """
    line, old = session.line, LineChange(session.unit, addressing=session.addressing)
    if line is not None:
        old = LineChange(session.unit, line.baud, line.data_bits, line.parity, line.stop_bits, session.addressing)
    value = one.value(session)
    new = _settings(session, governs, value)
    session.home = old
    if governs.setting is Setting.ADDRESS:
        yield from _check_free(session, one, int(value), old)
    marks: dict[str, Words] = {}
    if governs.setting is Setting.ADDRESSING:
        here = (other for other in session.registers.values() if other.origin is not None)
        known = [other for other in here if other.kind in MARKS and other.access.readable]
        marks = yield from words_of(session, [(other, other.read_view()) for other in known])
    cause = yield from _send(session, one, governs)
    yield from _find(session, one, old, [] if governs.since == "restart" else new, marks, cause)
    session.home = None


def _settings(session: Session, governs: Governs, value: Any) -> list[LineChange]:
    """What a value of the register sets; all that the setting may become where the manual does not print its codes."""
    setting, protocol = governs.setting, session.protocol
    if setting is Setting.ADDRESS:
        return [LineChange(unit=int(value))]
    if (text := governs.value(value)) is not None:
        return [_line_change(setting, text)]
    possible = {
        Setting.BAUD: tuple(map(str, protocol.serial.bauds)),
        Setting.PARITY: PARITIES,
        Setting.FORMAT: protocol.serial.formats,
        Setting.ADDRESSING: tuple(ADDRESSINGS),
    }
    if session.line is None and setting is not Setting.ADDRESSING:
        return []
    return [_line_change(setting, text) for text in possible.get(setting, ())]


def _line_change(setting: Setting, text: str) -> LineChange:
    if setting is Setting.FORMAT:
        return LineChange(data_bits=int(text[0]), parity=text[1], stop_bits=int(text[2]))
    value: Any = text if setting in {Setting.PARITY, Setting.ADDRESSING} else int(text)
    return LineChange(**{setting: value})


def _check_free(session: Session, one: RegisterWrite, unit: int, old: LineChange) -> Operation[None]:
    """Refuse a unit id at which another device answers: two at one id garble each other."""
    if unit == session.unit:
        return
    request = read_request(one.register, one.register.seen_in(one.view))
    yield LineChange(unit=unit)
    try:
        reply = yield request  # once: nobody is expected there
        found = verify(request, reply, unit=unit, protocol=session.protocol) if reply else ()
    except RegscribeError:
        found = ()  # nobody there, or nobody that knows this register
    yield old
    if found and one.matches(found, session):
        raise ValueRefused(one.path, f"unit {unit} answers already: two units of one id would garble each other")


def _send(session: Session, one: RegisterWrite, governs: Governs) -> Operation[RegscribeError | None]:
    """Send the write, and the command that applies it; the error in place of an answer, None if it came."""
    try:
        yield from send(session, one)
    except RegscribeError as error:
        if not is_lost(error):
            raise
        return error
    try:
        yield from apply(session, one.register)
    except RegscribeError as error:
        if governs.since != "apply":
            raise
        return error
    return None


def _find(
    session: Session,
    one: RegisterWrite,
    old: LineChange,
    new: list[LineChange],
    marks: dict[str, Words],
    cause: RegscribeError | None,
) -> Operation[None]:
    """Find the device in one of the new settings or in the old one; raises if it did not take the write."""
    if one.register.settle:
        yield Pause(one.register.settle / 1000)
    for change in new:
        yield change
        read = yield from _read(session, one, marks)
        if read is not None and one.matches(read, session):
            return
        yield old
    read = yield from _read(session, one, marks)
    value = value_text(one.value(session))
    if read is None:
        raise _left(one.path, value, old, new, cause) from cause
    if one.matches(read, session):
        return  # it holds the value and talks as before: it will change later
    if cause is None:
        raise one.differs(read, session)
    reason = f"the device still talks as before ({line_text(old)}) and does not hold {value}"
    raise lost(NotWritten, one.path, reason, cause) from cause


def _read(session: Session, one: RegisterWrite, marks: dict[str, Words]) -> Operation[Words | None]:
    """The words of the register in the present setting; None if no device answers, or another one."""
    known = [(session.registers[path], session.registers[path].read_view()) for path in marks]
    try:
        found = yield from words_of(session, [one.target, *known])
    except RegscribeError:
        return None
    if any(found[path] != words for path, words in marks.items()):
        return None  # addresses counted otherwise: what was read are other registers
    return found[one.path]


def _left(path: str, value: str, old: LineChange, new: list[LineChange], cause: RegscribeError | None) -> LeftAt:
    answer = f"its answer to the write was lost ({cause})" if cause else "it answered the write"
    if new:
        places = "in either setting" if len(new) == 1 else f"in any of {len(new)} settings"
        reason = f"{answer}, and now it is not found {places}; this driver talks as before"
    else:
        reason = f"{answer}, and now it does not answer as before. The manual does not say what {value} sets"
    asked = "; ".join(map(line_text, new)) or value
    return LeftAt(path, before=line_text(old), asked=asked, reason=reason)


def line_text(change: LineChange) -> str:
    """A line change in words."""
    character = f"{change.data_bits or ''}{change.parity or ''}{change.stop_bits or ''}"
    parts = (
        "" if change.unit is None else f"unit {change.unit}",
        "" if change.baud is None else f"{change.baud} baud",
        f"format {character}" if character else "",
        "" if change.addressing is None else f"{change.addressing} addresses",
    )
    return ", ".join(part for part in parts if part)
