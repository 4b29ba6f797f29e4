"""Setpoint programs (ramp and soak): their registers, and the way to run them.

A path has `{i}` for the number of the program and `{j}` for that of the segment; empty: there is no such register.
"""

from enum import StrEnum
from typing import NamedTuple

from regscribe_runtime.values.conditions import ALWAYS, Condition
from regscribe_runtime.values.facts import WriteCondition
from regscribe_runtime.values.numbers import Number

PROGRAM = "{i}"
SEGMENT = "{j}"
"""Placeholders in paths for the numbers of the program and of the segment."""

Named = tuple[tuple[str, str], ...]
"""Outputs: pairs of a name and the path of a register."""

Values = tuple[tuple[str, Number], ...]
"""Paths of registers and the numbers to write to them."""


class ProgramCounts(StrEnum):
    """The segments that the register with their number counts."""

    ALL = "all"
    AFTER_FIRST = "after_first"
    NOT_STATED = "not_stated"


class WhileRunning(StrEnum):
    """Whether a running program can be written, by the manual."""

    REFUSED = "refused"
    ALLOWED = "allowed"
    NOT_STATED = "not_stated"


class ProgramPart(StrEnum):
    """The parts of a program, in the default order of writing."""

    TIME_UNIT = "time_unit"
    POWER_FAILURE = "power_failure"
    HOLDBACK = "holdback"
    END = "end"
    CYCLES = "cycles"
    SEGMENTS = "segments"
    FINAL = "final"
    COUNT = "count"
    ENABLE = "enable"


class ProgramSegments(NamedTuple):
    """`many` segments from number `first`: the paths of setpoint, ramp time and soak time, and of outputs by name.

    A segment is not in use if all `idle` registers are 0.
    """

    first: int
    many: int
    setpoint: str
    ramp: str
    soak: str = ""
    outputs: Named = ()
    idle: tuple[str, ...] = ()


class ProgramFinal(NamedTuple):
    """The state behind the last segment: a setpoint and outputs, no time."""

    setpoint: str
    outputs: Named = ()


class ProgramTimeUnit(NamedTuple):
    """The register that sets the unit of all times, and the unit under each code."""

    register: str
    codes: tuple[tuple[int, str], ...]


class ProgramStates(NamedTuple):
    """The status register of a program: its codes while it runs, while it does not, while it is held."""

    register: str
    running: tuple[int, ...]
    ended: tuple[int, ...]
    held: tuple[int, ...] = ()


class ProgramAction(NamedTuple):
    """The way to start, hold or stop a program: numbers written in order, or a command; neither: there is none."""

    writes: Values = ()
    command: str = ""

    @property
    def known(self) -> bool:
        """Whether the manual describes the action."""
        return bool(self.writes or self.command)


NO_WAY = ProgramAction()


class SetpointProgram(NamedTuple):
    """A program, or `programs` of them numbered from `first` (0: one without a number).

    `counts` tells which segments `number_of_segments` counts, `forever` is the code of `cycles` for a program without
    end, `setpoint_limits` are two registers that the setpoints lie between, `enable` makes the device run this program,
    `requires` is the condition of a start, `order` has the parts as they are written, and it exists only while `when`
    holds.
    """

    id: str
    name: str
    segments: ProgramSegments
    first: int = 0
    programs: int = 0
    section: str = ""
    final: ProgramFinal | None = None
    number_of_segments: str = ""
    counts: ProgramCounts = ProgramCounts.ALL
    cycles: str = ""
    forever: int | None = None
    time_unit: ProgramTimeUnit | None = None
    holdback: str = ""
    power_failure: str = ""
    end: str = ""
    setpoint_limits: tuple[str, str] | None = None
    enable: Values = ()
    requires: WriteCondition | None = None
    status: ProgramStates | None = None
    segment_now: str = ""
    program_now: str = ""
    setpoint_now: str = ""
    start: ProgramAction = NO_WAY
    hold: ProgramAction = NO_WAY
    resume: ProgramAction = NO_WAY
    reset: ProgramAction = NO_WAY
    while_running: WhileRunning = WhileRunning.NOT_STATED
    order: tuple[ProgramPart, ...] = tuple(ProgramPart)
    when: Condition = ALWAYS

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """That of its existence and, where there is one, that of a start."""
        return (self.when, self.requires.when) if self.requires else (self.when,)

    @property
    def numbers(self) -> tuple[int, ...]:
        """The numbers of the programs; a single 0 where there is one without a number."""
        return tuple(range(self.first, self.first + self.programs)) or (0,)


def numbered(path: str, program: int, segment: int = 0) -> str:
    """The path of a register for one program and one segment."""
    return path.replace(PROGRAM, str(program)).replace(SEGMENT, str(segment))
