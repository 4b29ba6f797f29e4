"""Runs a program: its state, and start, hold, resume and reset by the registers or commands of the map."""

from dataclasses import dataclass
from typing import Literal

from regscribe.tools.live.reading import read_with
from regscribe.tools.programs.program import Setting
from regscribe.tools.programs.settings import SettingConverter, needs
from regscribe.tools.programs.slot import ProgramSlot
from regscribe_runtime import ProgramAction, RegscribeError, ValueRefused
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Operation, Session, Task

Act = Literal["start", "hold", "resume", "reset"]

MEANINGFUL = {"start": ("ended",), "hold": ("running",), "resume": ("held",), "reset": ("running", "held")}
"""The states in which an act means anything."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramState:
    """State of a device: `running`, `held`, `ended`, or `unknown`; `detail` is its own word (`RAMPING`).

    `program` and `segment` are the numbers of what runs, `setpoint` is that of the program; None: not readable.
    """

    state: str
    detail: str = ""
    program: int | None = None
    segment: int | None = None
    setpoint: Setting | None = None


class NotNow(RegscribeError):  # noqa: N818 (as the errors of drivers)
    """An act that is useless in the present state of the device, or not possible over the line; nothing was written."""


def status(place: ProgramSlot) -> Task[ProgramState]:
    """Read the state of the device."""

    def task(session: Session) -> Operation[ProgramState]:
        yield from place.exists(session)
        spec = place.spec
        told = (spec.status.register if spec.status else "", spec.program_now, spec.segment_now, spec.setpoint_now)
        registers = {path: place.register(path) for path in told if path}
        snapshot = yield from read_with(registers.values(), needs)(session)
        found = snapshot.valid
        converter = SettingConverter(found, session.givens)
        values = {path: found.get(one.path) for path, one in registers.items()}
        code = values.get(spec.status.register) if spec.status else None
        setpoint = values.get(spec.setpoint_now)
        return ProgramState(
            state=_state(place, code),
            detail=getattr(code, "name", "") or "",
            program=_whole(values.get(spec.program_now)),
            segment=_whole(values.get(spec.segment_now)),
            setpoint=None if setpoint is None else converter.setting(registers[spec.setpoint_now], setpoint),
        )

    return task


def _whole(value: object) -> int | None:
    return int(value) if isinstance(value, int) else None


def _state(place: ProgramSlot, code: int | None) -> str:
    states = place.spec.status
    if states is None or code is None:
        return "unknown"
    named = {"running": states.running, "held": states.held, "ended": states.ended}
    return next((name for name, codes in named.items() if code in codes), "unknown")


def act(place: ProgramSlot, what: Act, *, confirm: bool = False) -> Task[ProgramState]:
    """Start, hold, resume or reset a program; the state read afterwards.

    `confirm` is needed where a register or command of it is dangerous. NotNow if the map has no way, or the state of
    the device has no use for it; ValueRefused if a condition of a start does not hold.
    """

    def task(session: Session) -> Operation[ProgramState]:
        action: ProgramAction = getattr(place.spec, what)
        if not action.known:
            message = f"{place.name}: the manual of the {place.model} names no way to {what} a program over the line"
            raise NotNow(message)
        now = yield from status(place)(session)
        if now.state != "unknown" and now.state not in MEANINGFUL[what]:
            message = f"{place.name}: there is nothing to {what}: it is {now.state} ({now.detail})"
            raise NotNow(message)
        if what == "start":
            yield from _check_ready(session, place)
        if action.command:
            yield from tasks.run(session.commands[action.command], confirm=confirm)(session)
        for path, code in action.writes:
            register = place.register(path)
            yield from tasks.write(register, int(code), view=None, rounded=False, confirm=confirm)(session)
        return (yield from status(place)(session))

    return task


def _check_ready(session: Session, place: ProgramSlot) -> Operation[None]:
    """ValueRefused if a register that must be set before a start is not, with what it holds instead."""
    for path, code in place.spec.enable:
        register = place.register(path)
        held = yield from tasks.read(register, None)(session)
        if held != int(code):
            wanted = register.value_type.make(int(code))
            advice = f"set it to {_shown(wanted)}, or write the program"
            raise ValueRefused(register.path, f"it is {_shown(held)}, so the program does not run: {advice}")
    if place.spec.requires:
        when, reason = place.spec.requires
        snapshot = yield from tasks.read_many([session.registers[path] for path in when.registers])(session)
        state = snapshot.valid
        if not when.holds(state, session.givens):
            now = ", ".join(f"{path} is {_shown(state[path])}" for path in when.registers)
            raise ValueRefused(place.name, f"{reason}; now {now}")


def _shown(value: object) -> str:
    return str(getattr(value, "name", value))
