"""Writing a program: nothing while one runs, in the map's order, only what differs, and read back in the end."""

from typing import Any, Literal, NamedTuple

from regscribe.programs.checking import Planned, ProgramRefused, check
from regscribe.programs.model import Program
from regscribe.programs.place import Place
from regscribe.programs.running import act, status
from regscribe.runtime import RegscribeError, operations
from regscribe.runtime.session import Operation, Session, Task

WhileRunning = Literal["refuse", "reset", "write"]
"""What to do about a program that runs: refuse, end it first, or write all the same."""


class Written(NamedTuple):
    """How many registers were written, of how many that the program has; the others held their values already."""

    written: int
    total: int


class ProgramRuns(RegscribeError):  # noqa: N818 (as the errors of drivers)
    """A program runs or is held, so nothing was written."""


class ProgramUnfinished(RegscribeError):  # noqa: N818 (as the errors of drivers)
    """The write broke off: `written` of `total` registers hold the new program, the others the old one."""

    def __init__(self, place: Place, error: RegscribeError, *, written: int, total: int) -> None:
        self.written, self.total = written, total
        advice = "it must not be started like this: write it again, which goes on with what is left"
        super().__init__(f"{place.name}: {written} of {total} registers were written, then {error}; {advice}")


class ProgramDiffers(RegscribeError):  # noqa: N818 (as the errors of drivers)
    """What was read back is not what was written."""


def write(
    place: Place,
    program: Program,
    *,
    while_running: WhileRunning = "refuse",
    beyond_limits: bool = False,
    confirm: bool = False,
) -> Task[Written]:
    """Check a program, write what differs from what the device holds, and verify it.

    `confirm` is needed where a register is dangerous to write. Errors: ProgramRefused and ProgramRuns (nothing was
    written), ProgramUnfinished, ProgramDiffers, and those of the link.
    """

    def task(session: Session) -> Operation[Written]:
        checked = yield from check(place, program, beyond_limits=beyond_limits)(session)
        if checked.problems:
            raise ProgramRefused(place, checked.problems)
        yield from _at_rest(place, while_running)(session)
        todo = yield from _different(checked.planned)(session)
        for count, one in enumerate(todo):
            try:
                yield from operations.write(one.register, one.value, view=None, rounded=False, confirm=confirm)(session)
            except RegscribeError as error:
                raise ProgramUnfinished(place, error, written=count, total=len(todo)) from error
        left = yield from _different(checked.planned)(session)
        if left:
            paths = ", ".join(one.register.path for one in left)
            message = f"{place.name}: read back, these do not hold what was written: {paths}"
            raise ProgramDiffers(message)
        return Written(len(todo), len(checked.planned))

    return task


def _different(planned: tuple[Planned, ...]) -> Task[list[Planned]]:
    """What the device does not hold yet."""

    def task(session: Session) -> Operation[list[Planned]]:
        snapshot = yield from operations.read_many([one.register for one in planned])(session)
        return [one for one in planned if _held(snapshot, one.register.path) != one.value]

    return task


def _held(snapshot: Any, path: str) -> Any:  # noqa: ANN401 - a value of any register
    try:
        return snapshot[path]
    except RegscribeError:
        return None


def _at_rest(place: Place, how: WhileRunning) -> Task[None]:
    """Make sure that no program runs, as `how` says."""

    def task(session: Session) -> Operation[None]:
        if place.spec.status is None or place.spec.while_running == "allowed":
            return
        if how == "write" and place.spec.while_running != "refused":
            return
        now = yield from status(place)(session)
        if now.state == "ended":
            return
        if how == "reset":
            yield from act(place, "reset")(session)
            return
        message = f"{place.name}: a program runs ({now.detail}): end it first, or write with `reset` to end it"
        if place.spec.while_running == "refused":
            message = f"{message}; the manual forbids to write one that runs"
        raise ProgramRuns(message)

    return task
