"""What a type checker must accept and infer; read by test_typing.py, never run."""

from typing import assert_type

from regscribe_devices.athena.series_c import (
    AsyncAthena16C,
    Athena1ZC,
    Athena16C,
    HoldbackSpecial,
    InputType,
    LoopBreakTimeSpecial,
    OutputType,
    StatusByte,
)
from regscribe_devices.fdc.series_100 import FdcBTC9100, Mode, ModeOperation
from regscribe_runtime import Snapshot


def synchronous(controller: Athena16C, other: Athena1ZC, third: FdcBTC9100) -> None:
    assert_type(controller.process_value.read(), float)
    assert_type(controller.process_value.read_raw(), tuple[int, ...])
    assert_type(controller.input_type.read(), InputType)
    assert_type(controller.controller_id.read(), int)
    assert_type(controller.loop_break_time.read(), int | LoopBreakTimeSpecial)
    assert_type(controller.holdback.read(), float | HoldbackSpecial)
    assert_type(controller.software_version.read(), str)
    assert_type(controller.status_byte.read(), StatusByte)
    assert_type(controller.segments[1].soak_level.read(), float)
    assert_type(controller.read(controller.groups.alarm), Snapshot)
    assert_type(controller.read()[Athena16C.process_value], float)
    assert_type(third.mode.read(), Mode)
    assert_type(third.mode.read().operation, ModeOperation)
    assert_type(third.mode.read().alarm, bool)
    controller.setpoint_ram.write(150.5, view="x10")
    controller.input_type.write(InputType.RTD)
    controller.output_1_type.write(OutputType.ALARM)
    controller.output_1_type.change(lambda value: value)
    controller.commands.clear_latched_alarms()
    other.watchdog_disable.write(3.1415, confirm=True)
    for segment in controller.segments:
        segment.ramp_time.write(30)


async def asynchronous(controller: AsyncAthena16C) -> None:
    assert_type(await controller.process_value.read(), float)
    assert_type(await controller.input_type.read(), InputType)
    assert_type(await controller.segments[1].soak_level.read(), float)
    await controller.setpoint_ram.write(150.5)
    await controller.commands.clear_latched_alarms()
