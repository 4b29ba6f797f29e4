"""Setpoint programs: read from a device, edited as YAML, checked, written in a safe order, run and drawn.

Operations are tasks: `device.run(read(place(device)))`, and `await device.run(...)` with an asyncio driver.
"""

from regscribe.tools.programs.assignments import Problem as Problem
from regscribe.tools.programs.check import Checked as Checked
from regscribe.tools.programs.check import PlannedProgram as PlannedProgram
from regscribe.tools.programs.check import ProgramRefused as ProgramRefused
from regscribe.tools.programs.check import check as check
from regscribe.tools.programs.program import FOREVER as FOREVER
from regscribe.tools.programs.program import RAW as RAW
from regscribe.tools.programs.program import Amount as Amount
from regscribe.tools.programs.program import Final as Final
from regscribe.tools.programs.program import Program as Program
from regscribe.tools.programs.program import Segment as Segment
from regscribe.tools.programs.program import Setting as Setting
from regscribe.tools.programs.program import setting as setting
from regscribe.tools.programs.program_file import ProgramFile as ProgramFile
from regscribe.tools.programs.program_file import dump as dump
from regscribe.tools.programs.program_file import load as load
from regscribe.tools.programs.program_file import plain as plain
from regscribe.tools.programs.read import read as read
from regscribe.tools.programs.run import NotNow as NotNow
from regscribe.tools.programs.run import ProgramState as ProgramState
from regscribe.tools.programs.run import act as act
from regscribe.tools.programs.run import status as status
from regscribe.tools.programs.slot import ProgramSlot as ProgramSlot
from regscribe.tools.programs.slot import place as place
from regscribe.tools.programs.slot import places as places
from regscribe.tools.programs.write import ProgramGivenBack as ProgramGivenBack
from regscribe.tools.programs.write import ProgramRuns as ProgramRuns
from regscribe.tools.programs.write import ProgramUnfinished as ProgramUnfinished
from regscribe.tools.programs.write import WrittenProgram as WrittenProgram
from regscribe.tools.programs.write import write as write
