"""collectd polls simulated devices for a minute with configurations that the export made."""

import re
import struct
import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from fractions import Fraction
from pathlib import Path

import pytest
from independent.collect import Value, configuration, polling, values
from independent.drivers import readings
from independent.families import FAMILIES, Family, column
from independent.lines import pty_pair
from independent.stage import Stage, service, staged

from regscribe.model import Order, Register
from regscribe.simulate import SimulatedDevice

pytestmark = pytest.mark.wire

Count = Callable[..., None]
MINUTE = 60
EVERY = 5
ROUNDS = MINUTE // EVERY - 2
"""collectd may come late once, and be ended before its last round."""

MOVING = "setpoint_ram"
STEPS = [100 + step / 4 for step in range(MINUTE)]
ON_A_LINE = "athena/platinum-m300"
DIGITS = 1e-6
"""The CSV files have six decimals."""


def test_collectd_writes_for_a_minute_what_device_and_driver_have(agree: Count, tmp_path: Path) -> None:
    with ExitStack() as stack:
        served = [serve(stack, family, tmp_path) for family in FAMILIES]
        texts = [
            configuration(family, place, f"device-{number}", every=EVERY)
            for number, (family, (_, place)) in enumerate(zip(FAMILIES, served, strict=True))
        ]
        data = stack.enter_context(polling(texts, tmp_path))
        move(served[0][0])
    assert_silent(tmp_path / "log")
    for number, (family, text) in enumerate(zip(FAMILIES, texts, strict=True)):
        device = served[number][0].device
        polled = set(re.findall(r'Instance "(.+)"', text))
        registers = {instance(register): register for register in device.model.registers}
        assert len(polled) > len(registers) / 2, "most registers are numbers"
        for name in sorted(polled):
            found = values(data, f"device-{number}", device.unit, name)
            assert len(found) >= ROUNDS, (family.name, name, found)
            assert_right(found, family, device, registers[name], moving=number == 0 and name == MOVING)
            agree("collectd", family.name, f"{shown_in(device, registers[name])} r", len(found))


def serve(stack: ExitStack, family: Family, folder: Path) -> tuple[Stage, str]:
    """Serve a family on TCP, one of them on a serial line; the stage, and where collectd finds it."""
    if family.map == ON_A_LINE:
        ours, theirs = stack.enter_context(pty_pair(folder))
        return stack.enter_context(staged(family.device(), service("serial", path=ours))), theirs
    stage = stack.enter_context(staged(family.device(), service("tcp")))
    return stage, f"{stage.servers[0].host}:{stage.servers[0].port}"


def move(stage: Stage) -> None:
    """Change one value every second, for a minute."""
    for step in STEPS:
        stage.device.poke(MOVING, step)
        time.sleep(1)


def assert_silent(log: Path) -> None:
    said = log.read_text(encoding="utf-8") if log.exists() else ""
    assert not said, said


def instance(register: Register) -> str:
    return register.path.replace("[", "_").replace("]", "").replace(".", "_")


def assert_right(
    found: Sequence[Value], family: Family, device: SimulatedDevice, register: Register, *, moving: bool
) -> None:
    """Compare all values of the minute with what the device held, and with what the driver reads."""
    if moving:
        steps = [STEPS.index(value.number) for value in found]
        assert steps == sorted(steps), "each value was there, none came back"
        assert steps[-1] - steps[0] > MINUTE / 2
        return
    stored = device.state.stored(register.path)
    assert not isinstance(stored, str)
    held = float(device.state.to_value(register, stored))
    if register.preferred.type.is_float:
        held = float(device.state.to_value(register, Fraction(single(float(stored)))))
    assert [value.number for value in found] == pytest.approx([held] * len(found), rel=DIGITS, abs=DIGITS)
    said = readings(family)[register.path, register.preferred.name]
    if isinstance(said, int | float) and not register.specials:
        assert found[-1].number == pytest.approx(float(said), rel=DIGITS, abs=DIGITS)


def single(number: float) -> float:
    """Return the number as an IEEE number of 32 bits."""
    near: float = struct.unpack(">f", struct.pack(">f", number))[0]
    return near


def shown_in(device: SimulatedDevice, register: Register) -> str:
    view = register.preferred
    swapped = device.state.order(view).words is Order.LITTLE
    return column(register, view.space, view.type, view.name, swapped=swapped)
