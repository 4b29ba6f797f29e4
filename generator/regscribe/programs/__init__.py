"""Setpoint programs: read from a device, edited as YAML, checked, written in a safe order, run and drawn.

Operations are tasks: `device.run(read(place(device)))`, and `await device.run(...)` with an asyncio driver.
"""

from regscribe.programs.checking import Checked, Planned, ProgramRefused, check
from regscribe.programs.files import File, dump, load, plain
from regscribe.programs.model import FOREVER, RAW, Amount, Final, Program, Segment, Setting, setting
from regscribe.programs.place import Place, place, places
from regscribe.programs.reading import read
from regscribe.programs.running import NotNow, State, act, status
from regscribe.programs.structure import Problem
from regscribe.programs.writing import ProgramGivenBack, ProgramRuns, ProgramUnfinished, Written, write

__all__ = [
    "FOREVER",
    "RAW",
    "Amount",
    "Checked",
    "File",
    "Final",
    "NotNow",
    "Place",
    "Planned",
    "Problem",
    "Program",
    "ProgramGivenBack",
    "ProgramRefused",
    "ProgramRuns",
    "ProgramUnfinished",
    "Segment",
    "Setting",
    "State",
    "Written",
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
