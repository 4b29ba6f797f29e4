"""Checks a program against a device: every mistake at once, each with its place, its numbers and what to do."""

from typing import Any, NamedTuple

from regscribe.tools.programs.assignments import Assignments, Problem, Where
from regscribe.tools.programs.program import Program
from regscribe.tools.programs.settings import SettingConverter, needs
from regscribe.tools.programs.slot import ProgramSlot
from regscribe_runtime import Register, RegscribeError, ValueRefused
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Operation, Session, Task


class PlannedProgram(NamedTuple):
    """A register of a program and the value to write; `part` says when it is written."""

    part: str
    register: Register[Any]
    value: Any
    where: Where


class Checked(NamedTuple):
    """The registers to write, in order, and the problems: with one of them nothing is written."""

    planned: tuple[PlannedProgram, ...]
    problems: tuple[Problem, ...]


class ProgramRefused(RegscribeError, ValueError):  # noqa: N818 (as the errors of drivers)
    """A program that the device does not take; nothing was written."""

    def __init__(self, place: ProgramSlot, problems: tuple[Problem, ...]) -> None:
        self.problems = problems
        count = f"{len(problems)} mistakes" if len(problems) > 1 else "a mistake"
        super().__init__("\n".join([f"{place.name} of the {place.model}: {count}", *(f"  {one}" for one in problems)]))


def check(place: ProgramSlot, program: Program, *, beyond_limits: bool = False) -> Task[Checked]:
    """Check a program against a device as it is configured now; with `beyond_limits` inferred limits do not count."""

    def task(session: Session) -> Operation[Checked]:
        yield from place.exists(session)
        made = Assignments(place, program)
        planned = []
        paths = {path for one in made.assignments for path in needs(one.register)}
        paths.update(place.spec.setpoint_limits or ())
        snapshot = yield from tasks.read_many([session.registers[path] for path in sorted(paths)])(session)
        converter = SettingConverter(snapshot.valid, session.givens, program.time_unit or "")
        time_unit = place.spec.time_unit
        countable = time_unit is None or program.time_unit in dict(time_unit.codes).values()
        for one in made.assignments:
            if one.time and not countable:
                continue  # what the times count in is wrong already, so nothing can be said of them
            try:
                value = converter.value(one.register, one.setting, time=one.time)
                if one.where[-1] == "to" and not beyond_limits:
                    _within(place, converter, one.register, value)
                one.register.encode(value, state=converter.state, givens=converter.givens)
            except ValueRefused as error:
                made.report(one.where, error.reason)
            except RegscribeError as error:
                made.report(one.where, str(error))
            else:
                planned.append(PlannedProgram(one.part, one.register, value, one.where))  # pyright: ignore[reportArgumentType] # a register is a descriptor, but no attribute of this tuple
        order: dict[str, int] = {part: number for number, part in enumerate(place.spec.order)}
        planned.sort(key=lambda one: order[one.part])
        made.problems.sort(key=lambda one: (PLACES.get(one.where[0], 0), [_rank(part) for part in one.where]))
        return Checked(tuple(planned), tuple(made.problems))

    return task


PLACES: dict[str | int, int] = {"segments": 1, "final": 2}
"""Order of problems: those of the whole program, of the segments one after the other, of the final one."""

ORDER = ("to", "ramp", "soak", "outputs")
"""The keys of a segment as people write them."""


def _rank(part: str | int) -> tuple[int, str]:
    if isinstance(part, int):
        return part, ""
    return (ORDER.index(part), "") if part in ORDER else (len(ORDER), part)


def _within(place: ProgramSlot, converter: SettingConverter, register: Register[Any], value: Any) -> None:  # noqa: ANN401 - a value of any register
    """ValueRefused for a setpoint beyond the controller's present setpoint limits."""
    low, high = (converter.state.get(path) for path in place.spec.setpoint_limits or ("", ""))
    if low is not None and high is not None and not low <= value <= high:
        names = " and ".join(place.spec.setpoint_limits or ())
        message = f"{value} lies outside {low} to {high}, the present {names}: change one of them"
        raise ValueRefused(register.path, message)
