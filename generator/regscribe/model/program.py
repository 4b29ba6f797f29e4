"""Setpoint programs (ramp/soak recipes): which registers make one, and how it is run."""

from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction

from regscribe.model.diagnostic import NOWHERE, Span
from regscribe.model.register import Inferred
from regscribe_runtime.values.facts import WriteCondition

PROGRAM = "{i}"
SEGMENT = "{j}"
"""What stands in a path for the numbers of the program and of the segment."""


class ProgramCounts(StrEnum):
    """Which segments a number of segments counts."""

    ALL = "all"
    AFTER_FIRST = "after_first"
    NOT_STATED = "not_stated"


class WhileRunning(StrEnum):
    """What the manual says about writing a program that runs."""

    REFUSED = "refused"
    ALLOWED = "allowed"
    NOT_STATED = "not_stated"


class ProgramPart(StrEnum):
    """The parts of a program, in the order in which they are written unless a map says otherwise."""

    TIME_UNIT = "time_unit"
    POWER_FAILURE = "power_failure"
    HOLDBACK = "holdback"
    END = "end"
    CYCLES = "cycles"
    SEGMENTS = "segments"
    FINAL = "final"
    COUNT = "count"
    ENABLE = "enable"


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramSegments:
    """`count` segments, the manual's numbers from `first`: paths of what each has (empty: it has none).

    `outputs` are (name, path); a segment is not in use if all `idle` registers are 0.
    """

    first: int
    count: int
    setpoint: str
    ramp: str
    soak: str = ""
    outputs: tuple[tuple[str, str], ...] = ()
    idle: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramFinal:
    """What stays behind the last segment: it has no time."""

    setpoint: str
    outputs: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramTimeUnit:
    """The register that sets the unit of all times, and the unit under each code."""

    register: str
    codes: tuple[tuple[int, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramStatus:
    """The register that tells whether a program runs: its codes while it runs, is held, and does neither."""

    register: str
    running: tuple[int, ...]
    ended: tuple[int, ...]
    held: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgramAction:
    """What makes the device act: values written one after the other, or a command. Neither: there is no way."""

    writes: tuple[tuple[str, Fraction], ...] = ()
    command: str = ""

    @property
    def known(self) -> bool:
        """Whether the manual names a way."""
        return bool(self.writes or self.command)


NO_WAY = ProgramAction()


@dataclass(frozen=True, slots=True, kw_only=True)
class SetpointProgram:
    """A program, or `programs` of them numbered from `first` (0: there is one, without a number).

    All registers are paths, with `{i}` for the number of the program and `{j}` for that of the segment; empty: the
    device has no such register. `forever` is the code of `cycles` for a program without end, `setpoint_limits` the
    paths of two limits, `order` the parts as they are written.
    """

    id: str
    name: str
    segments: ProgramSegments
    first: int = 0
    programs: int = 0
    description: str = ""
    section: str = ""
    final: ProgramFinal | None = None
    count: str = ""
    counts: ProgramCounts = ProgramCounts.ALL
    cycles: str = ""
    forever: int | None = None
    time_unit: ProgramTimeUnit | None = None
    holdback: str = ""
    power_failure: str = ""
    end: str = ""
    setpoint_limits: tuple[str, str] | None = None
    enable: tuple[tuple[str, Fraction], ...] = ()
    requires: WriteCondition | None = None
    status: ProgramStatus | None = None
    segment_now: str = ""
    program_now: str = ""
    setpoint_now: str = ""
    start: ProgramAction = NO_WAY
    hold: ProgramAction = NO_WAY
    resume: ProgramAction = NO_WAY
    reset: ProgramAction = NO_WAY
    while_running: WhileRunning = WhileRunning.NOT_STATED
    order: tuple[ProgramPart, ...] = tuple(ProgramPart)
    inferred: tuple[Inferred, ...] = ()
    span: Span = NOWHERE

    @property
    def numbers(self) -> tuple[int, ...]:
        """The numbers of the programs; a single 0 where there is one without a number."""
        return tuple(range(self.first, self.first + self.programs)) or (0,)


def numbered(path: str, program: int, segment: int = 0) -> str:
    """The path of a register for one program and one segment."""
    return path.replace(PROGRAM, str(program)).replace(SEGMENT, str(segment))
