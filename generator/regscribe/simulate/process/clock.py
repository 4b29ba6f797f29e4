"""Time for devices that are served: simulated seconds pass with real ones, or faster."""

import asyncio
import math
from collections.abc import Sequence

from regscribe.simulate.device.device import SimulatedDevice
from regscribe.simulate.errors import SimulatorError

TICK = 0.25
"""Real seconds between two looks at the clock."""

MOST_BEHIND = 3600.0
"""Simulated seconds that are caught up with in one look; what is beyond is left out (the computer slept)."""


def speed_of(speed: float) -> float:
    """Return a speed; SimulatorError for what is none."""
    if not 0 <= speed < math.inf:
        message = f"speed {speed!r} is no factor of 0 or more (0: time stands still, 60: a minute a second)"
        raise SimulatorError(message)
    return speed


async def tick(devices: Sequence[SimulatedDevice], speed: float) -> None:
    """Let time pass for devices that move, until cancelled; the loop is free between two devices."""
    loop = asyncio.get_running_loop()
    before = loop.time()
    while True:
        await asyncio.sleep(TICK)
        now = loop.time()
        for device in devices:
            device.advance(min((now - before) * speed, MOST_BEHIND))
            await asyncio.sleep(0)
        before = now
