"""Writes a program: not while one runs, in the map's order, only what differs, verified, undone if it fails."""

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
"""How to treat a program that runs: refuse to write, end it first, or write all the same."""

ALONE = frozenset({"time_unit", "count", "enable"})
"""Parts that are written before or after all others are complete; the others share requests."""

TRIES, BETWEEN = 6, 0.5
"""How often the state of a program that was reset is read until it has ended, and the seconds between."""


class WrittenProgram(NamedTuple):
    """Numbers of registers that were written and that the program has; the others held their values already."""

    written: int
    total: int


class ProgramRuns(RegscribeError):  # noqa: N818 (as the errors of drivers)
    """A program runs or is held, so nothing was written."""

    def __init__(self, place: ProgramSlot, now: ProgramState, advice: str) -> None:
        refused = place.spec.while_running is declared.WhileRunning.REFUSED
        why = "; the manual forbids to write a program that runs" if refused else ""
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
        yield from _check_at_rest(session, place, while_running)
        reports: list[WriteReport] = []
        for stage in stages(place.spec.order, checked.planned):
            values = {one.register.path: one.value for one in stage}
            try:
                reports.append((yield from tasks.configure(values, confirm=confirm)(session)))
            except NotConfigured as error:
                yield from _give_back(session, place, reports, error)
        return WrittenProgram(sum(len(one.written) for one in reports), len(checked.planned))

    return task


def stages(order: Sequence[str], planned: Sequence[PlannedProgram]) -> Iterator[list[PlannedProgram]]:
    """Registers that are written together; parts share a stage where the map asks for no order of its own."""
    ordered = tuple(order) != tuple(declared.ProgramPart)
    stage: list[PlannedProgram] = []
    last = ""
    for one in planned:
        if stage and one.part != last and (ordered or {one.part, last} & ALONE):
            yield stage
            stage = []
        stage.append(one)
        last = one.part
    if stage:
        yield stage


def _give_back(
    session: Session, place: ProgramSlot, reports: Sequence[WriteReport], error: NotConfigured
) -> Operation[None]:
    """Restore the registers of earlier stages (those of the stage that failed are restored already), and raise."""
    before = {one.register: one.was for report in reports for one in report.changes if one.fate is Fate.WRITTEN}
    advice = "it must not be started like this: write it again, which goes on with what is left"
    message = f"the device holds parts of the new program and of the old one ({error.reason}); {advice}"
    if error.report.unknown:
        raise ProgramUnfinished(place.name, message) from error
    try:
        if before:
            yield from tasks.configure(before, confirm=True, undo=False)(session)
    except RegscribeError:
        raise ProgramUnfinished(place.name, message) from error
    raise ProgramGivenBack(place.name, f"{error.reason}; all was given back what it held") from error


def _check_at_rest(session: Session, place: ProgramSlot, how: WhileRunning) -> Operation[None]:
    """Make sure that no program runs, as `how` says; ProgramRuns if one does."""
    allowed = place.spec.while_running
    if place.spec.status is None or allowed is declared.WhileRunning.ALLOWED:
        return
    if how == "write" and allowed is not declared.WhileRunning.REFUSED:
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
