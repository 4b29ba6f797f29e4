"""Setpoint programs as a generated driver declares them: which registers make one, and how it is run. Plain data.

A path has `{i}` for the number of the program and `{j}` for that of the segment; empty: there is no such register.
`regscribe.tools.programs` reads, checks and writes programs by these declarations.
"""

from typing import NamedTuple

from regscribe_runtime.values.facts import WriteCondition
from regscribe_runtime.values.specs import Text

PARTS = ("time_unit", "power_failure", "holdback", "end", "cycles", "segments", "final", "count", "enable")
"""The parts of a program in the order in which they are written, unless the device asks for another one."""

Named = tuple[tuple[str, str], ...]
"""Outputs: a name and the path of a register."""

Values = tuple[tuple[str, Text], ...]
"""Paths of registers and the numbers that they are given."""


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
    """What stays behind the last segment: a setpoint and outputs, no time."""

    setpoint: str
    outputs: Named = ()


class ProgramStates(NamedTuple):
    """The register that tells whether a program runs: its codes while it runs, while it does not, while it is held."""

    register: str
    running: tuple[int, ...]
    ended: tuple[int, ...]
    held: tuple[int, ...] = ()


class ProgramAction(NamedTuple):
    """What makes the device act: numbers written one after the other, or a command; neither: there is no way."""

    writes: Values = ()
    command: str = ""


NO_WAY = ProgramAction()


class SetpointProgram(NamedTuple):
    """A program, or `programs` of them numbered from `first` (0: one without a number).

    `counts` tells which segments `number_of_segments` counts (all, after_first, not_stated), `forever` the code of
    `cycles` for a program without end, `time_unit` the unit of all times under each code of a register,
    `setpoint_limits` two registers that the setpoints lie between, `enable` what makes the device run this program,
    `requires` the condition of a start and why. `while_running`: refused, allowed, or empty if the manual says nothing.
    """

    id: str
    name: str
    segments: ProgramSegments
    first: int = 0
    programs: int = 0
    section: str = ""
    final: ProgramFinal | None = None
    number_of_segments: str = ""
    counts: str = "all"
    cycles: str = ""
    forever: int | None = None
    time_unit: tuple[str, tuple[tuple[int, str], ...]] | None = None
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
    while_running: str = ""
    order: tuple[str, ...] = PARTS
