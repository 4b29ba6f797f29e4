"""Setpoint programs: read from a device, edited as YAML, checked, written in a safe order, run and drawn.

Operations are tasks: `device.run(read(place(device)))`, and `await device.run(...)` with an asyncio driver.
"""

from regscribe.tools.programs.assignments import Problem
from regscribe.tools.programs.check import Checked, PlannedProgram, ProgramRefused, check
from regscribe.tools.programs.program import FOREVER, RAW, Amount, Final, Program, Segment, Setting, setting
from regscribe.tools.programs.program_file import ProgramFile, dump, load, plain
from regscribe.tools.programs.read import read
from regscribe.tools.programs.run import NotNow, ProgramState, act, status
from regscribe.tools.programs.slot import ProgramSlot, place, places
from regscribe.tools.programs.write import ProgramGivenBack, ProgramRuns, ProgramUnfinished, WrittenProgram, write

__all__ = [
    "FOREVER",
    "RAW",
    "Amount",
    "Checked",
    "Final",
    "NotNow",
    "PlannedProgram",
    "Problem",
    "Program",
    "ProgramFile",
    "ProgramGivenBack",
    "ProgramRefused",
    "ProgramRuns",
    "ProgramSlot",
    "ProgramState",
    "ProgramUnfinished",
    "Segment",
    "Setting",
    "WrittenProgram",
    "act",
    "check",
    "dump",
    "load",
    "place",
    "places",
    "plain",
    "read",
    "setting",
    "status",
    "write",
]
