"""A program held against a device: every mistake at once, each with its place, its numbers and what to do."""

from typing import Any, NamedTuple

from regscribe.tools.programs.assignments import Problem, Where, label, wanted
from regscribe.tools.programs.program import Program
from regscribe.tools.programs.settings import SettingConverter, needs
from regscribe.tools.programs.slot import ProgramSlot
from regscribe_runtime import Register, RegscribeError, ValueRefused
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Operation, Session, Task


class PlannedProgram(NamedTuple):
    """A register of a program and the value that it is to have; `part` says when it is written."""

    part: str
    register: Register[Any]
    value: Any
    where: Where


class Checked(NamedTuple):
    """What is to be written, in the order of writing, and what is wrong: with a problem nothing is written."""

    planned: tuple[PlannedProgram, ...]
    problems: tuple[Problem, ...]


class ProgramRefused(RegscribeError, ValueError):  # noqa: N818 (as the errors of drivers)
    """A program that the device does not take; nothing was written."""

    def __init__(self, place: ProgramSlot, problems: tuple[Problem, ...]) -> None:
        self.problems = problems
        count = f"{len(problems)} mistakes" if len(problems) > 1 else "a mistake"
        super().__init__("\n".join([f"{place.name} of the {place.model}: {count}", *(f"  {one}" for one in problems)]))


def check(place: ProgramSlot, program: Program, *, beyond_limits: bool = False) -> Task[Checked]:
    """Hold a program against a device as it is configured now; with `beyond_limits` inferred limits do not count."""

    def task(session: Session) -> Operation[Checked]:
        asked, problems = wanted(place, program)
        paths = {path for one in asked for path in needs(one.register)} | set(place.spec.setpoint_limits or ())
        snapshot = yield from tasks.read_many([session.registers[path] for path in sorted(paths)])(session)
        converter = SettingConverter(place, snapshot.valid, session.givens, program.time_unit or "")
        planned = []
        for one in asked:
            if one.time and not _countable(place, program):
                continue  # what the times count in is wrong already, so nothing can be said of them
            try:
                value = converter.value(one.register, one.setting, time=one.time)
                if one.limited and not beyond_limits:
                    _within(place, converter, one.register, value)
                converter.words(one.register, value)
            except ValueRefused as error:
                problems.append(Problem(one.where, label(place, one.where), error.reason))
            except RegscribeError as error:
                problems.append(Problem(one.where, label(place, one.where), str(error)))
            else:
                made = PlannedProgram(one.part, one.register, value, one.where)  # pyright: ignore[reportArgumentType] # a register is a descriptor, but no attribute of this tuple
                planned.append(made)
        order: dict[str, int] = {part: number for number, part in enumerate(place.spec.order)}
        return Checked(tuple(sorted(planned, key=lambda one: order[one.part])), tuple(_sorted(problems)))

    return task


def _countable(place: ProgramSlot, program: Program) -> bool:
    units = dict(place.spec.time_unit.codes).values() if place.spec.time_unit else ()
    return place.spec.time_unit is None or program.time_unit in units


PLACES: dict[str | int, int] = {"segments": 1, "final": 2}
ORDER = ("to", "ramp", "soak", "outputs")
"""Where mistakes are told, and the keys of a segment as people write them."""


def _sorted(problems: list[Problem]) -> list[Problem]:
    """First what concerns the whole program, then the segments one after the other, the final one last."""
    return sorted(problems, key=lambda one: (PLACES.get(one.where[0], 0), [_rank(part) for part in one.where]))


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
