"""Writing a program: not while one runs, in the map's order, only what differs, read back, given back if it fails."""

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

from regscribe.tools.programs.check import PlannedProgram, ProgramRefused, check
from regscribe.tools.programs.program import Program
from regscribe.tools.programs.run import ProgramState, act, status
from regscribe.tools.programs.slot import ProgramSlot
from regscribe_runtime import RegscribeError
from regscribe_runtime.errors import NotConfigured, WriteFailed
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Operation, Pause, Session, Task
from regscribe_runtime.report import Fate, WriteReport
from regscribe_runtime.values import programs as declared

WhileRunning = Literal["refuse", "reset", "write"]
"""What to do about a program that runs: refuse, end it first, or write all the same."""

ALONE = frozenset({"time_unit", "count", "enable"})
"""Parts that are written before or after all others are complete; the others share requests."""


TRIES, BETWEEN = 6, 0.5
"""How often a device is asked whether a program that was reset has ended, and the seconds between."""


class WrittenProgram(NamedTuple):
    """How many registers were written, of how many that the program has; the others held their values already."""

    written: int
    total: int


class ProgramRuns(RegscribeError):  # noqa: N818 (as the errors of drivers)
    """A program runs or is held, so nothing was written."""

    def __init__(self, place: ProgramSlot, now: ProgramState, advice: str) -> None:
        why = (
            "; the manual forbids to write a program that runs"
            if place.spec.while_running is declared.WhileRunning.REFUSED
            else ""
        )
        super().__init__(f"{place.name}: it is {now.state} ({now.detail}), so nothing was written{why}: {advice}")


class ProgramUnfinished(WriteFailed):
    """The write broke off in the middle, and what was there before could not be given back."""


class ProgramGivenBack(WriteFailed):
    """The write broke off in the middle; the device holds the program that it held before."""


def write(
    place: ProgramSlot,
    program: Program,
    *,
    while_running: WhileRunning = "refuse",
    beyond_limits: bool = False,
    confirm: bool = False,
) -> Task[WrittenProgram]:
    """Check a program, write what differs from what the device holds, and verify it.

    `confirm` is needed where a register is dangerous to write. Errors: ProgramRefused and ProgramRuns (nothing was
    written), ProgramGivenBack, ProgramUnfinished.
    """

    def task(session: Session) -> Operation[WrittenProgram]:
        checked = yield from check(place, program, beyond_limits=beyond_limits)(session)
        if checked.problems:
            raise ProgramRefused(place, checked.problems)
        yield from _at_rest(place, while_running)(session)
        reports: list[WriteReport] = []
        for stage in stages(place.spec.order, checked.planned):
            values = {one.register.path: one.value for one in stage}
            try:
                reports.append((yield from tasks.configure(values, confirm=confirm)(session)))
            except NotConfigured as error:
                yield from _given_back(place, reports, error)(session)
        return WrittenProgram(sum(len(one.written) for one in reports), len(checked.planned))

    return task


def stages(order: Sequence[str], planned: Sequence[PlannedProgram]) -> Iterator[list[PlannedProgram]]:
    """What is written together, one after the other; parts share a stage where the map asks for no order of its own."""
    told = tuple(order) != tuple(declared.ProgramPart)
    stage: list[PlannedProgram] = []
    last = ""
    for one in planned:
        if stage and one.part != last and (told or {one.part, last} & ALONE):
            yield stage
            stage = []
        stage.append(one)
        last = one.part
    if stage:
        yield stage


def _given_back(place: ProgramSlot, reports: Sequence[WriteReport], error: NotConfigured) -> Task[None]:
    """Give the registers of earlier stages back what they held; those of the stage that failed have it back if ever."""

    def task(session: Session) -> Operation[None]:
        before = {one.register: one.was for report in reports for one in report.changes if one.fate is Fate.WRITTEN}
        if error.report.unknown:
            raise ProgramUnfinished(place.name, _unfinished(error)) from error
        try:
            if before:
                yield from tasks.configure(before, confirm=True, undo=False)(session)
        except RegscribeError:
            raise ProgramUnfinished(place.name, _unfinished(error)) from error
        message = f"{error.reason}; all was given back what it held"
        raise ProgramGivenBack(place.name, message) from error

    return task


def _unfinished(error: NotConfigured) -> str:
    advice = "it must not be started like this: write it again, which goes on with what is left"
    return f"the device holds parts of the new program and of the old one ({error.reason}); {advice}"


def _at_rest(place: ProgramSlot, how: WhileRunning) -> Task[None]:
    """Make sure that no program runs, as `how` says."""

    def task(session: Session) -> Operation[None]:
        if place.spec.status is None or place.spec.while_running is declared.WhileRunning.ALLOWED:
            return
        if how == "write" and place.spec.while_running is not declared.WhileRunning.REFUSED:
            return
        now = yield from status(place)(session)
        if now.state == "ended":
            return
        if how == "reset":
            now = yield from act(place, "reset")(session)
            for _ in range(TRIES):
                if now.state == "ended":
                    return
                yield Pause(BETWEEN)
                now = yield from status(place)(session)
        advice = 'end it first, or pass while_running="reset"' if how == "refuse" else "see why it does not end"
        raise ProgramRuns(place, now, advice)

    return task
