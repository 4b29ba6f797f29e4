"""What a type checker must refuse: each marked line with an error, and no other; read by test_typing.py, never run."""

from regscribe_devices.athena.series_c import (
    AsyncAthena16C,
    Athena1ZC,
    Athena16C,
    Athena18C,
    InputType,
    OutputType,
    OutputType18C25C,
)
from regscribe_devices.fdc.series_100 import FdcC91


def synchronous(controller: Athena16C, small: Athena1ZC, large: Athena18C) -> None:
    controller.process_value.write(1.0)  # refused: read-only
    controller.input_type.write(3)  # refused: an int is no InputType
    controller.setpoint_ram.write("hot")  # refused: a text is no number
    controller.setpoint_ram = 150.5  # refused: plain assignment
    controller.process_value = 1.0  # refused: plain assignment
    small.access_level.read()  # refused: the 1ZC has none
    small.segments[1].ramp_event.read()  # refused: nor have its segments
    controller.watchdog_disable.read()  # refused: a register of the 1ZC
    large.output_1_type.write(OutputType.ALARM)  # refused: 18C has no alarm output
    controller.output_1_type.write(OutputType18C25C.PID)  # refused: another model's enum
    InputType.NO_SUCH_THING  # refused: no member
    controller.groups.no_such_group  # refused: no group
    FdcC91.tcp("192.0.2.1", unit=1)  # refused: the given is missing
    Athena16C.rtu("port", unit=1, bauds=9600)  # refused: no such setting


async def asynchronous(controller: AsyncAthena16C) -> None:
    value: float = controller.process_value.read()  # refused: not awaited
    await controller.process_value.write(value)  # refused: read-only
