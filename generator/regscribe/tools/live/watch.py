"""Reads the same registers again and again: rounds with what changed, never faster than the line can carry."""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from datetime import UTC, datetime
from typing import NamedTuple

from regscribe.tools.live.names import Readable
from regscribe.tools.live.reading import RegisterReading, readings
from regscribe_runtime import BareDevice, Computed, LinkLost, NoAnswer, RegscribeError, WrongAnswer

IDLE_SHARE = 0.1
"""Share of a round's time on the line for which the line is left to others before the next round."""


class Round(NamedTuple):
    """One reading of all registers: when it began, how long it took, the values; `changed` since the last good round.

    `error` is why nothing was read this time; `late` says that the round took longer than was asked for.
    """

    number: int
    time: datetime
    seconds: float
    readings: tuple[RegisterReading, ...]
    changed: frozenset[str]
    error: RegscribeError | None
    late: bool

    @property
    def moment(self) -> str:
        """When it began, in UTC as RFC 3339 has it."""
        return rfc3339(self.time)


def rfc3339(time: datetime) -> str:
    """A time in UTC as RFC 3339 has it, with milliseconds."""
    return time.isoformat(timespec="milliseconds").replace("+00:00", "Z")


class GaveUp(Exception):  # noqa: N818 - it is the end of watching
    """Too many rounds in a row failed; `error` is the last one's."""

    def __init__(self, failed: int, error: RegscribeError) -> None:
        super().__init__(f"{failed} rounds in a row failed: {error}")
        self.error = error


def watch(
    device: BareDevice,
    wanted: Sequence[Readable],
    *,
    every: float,
    count: int = 0,
    give_up: int = 0,
    sleep: Callable[[float], None] = time.sleep,
) -> Iterator[Round]:
    """Read `wanted` every so many seconds, or less often if their map says so, `count` times (0: for ever).

    A round begins at the earliest when the last one is done and the line was idle for a tenth of its time. A device
    that does not answer is asked again in the next round; after `give_up` such rounds in a row (0: never) GaveUp is
    raised.
    """
    held: dict[str, RegisterReading] = {}
    read_at: dict[str, float] = {}
    last: dict[str, tuple[object, ...]] = {}
    failed = number = 0
    while not count or number < count:
        number += 1
        moment, started = datetime.now(UTC), time.monotonic()
        found: tuple[RegisterReading, ...] = ()
        error = None
        due = [one for one in wanted if started - read_at.get(one.path, -math.inf) >= _pause(device, one) - every / 2]
        try:
            held |= {one.name: one for one in (device.run(readings(due)) if due else ())}
            read_at |= dict.fromkeys((one.path for one in due), started)
            found = tuple(held[one.path] for one in wanted)
        except (NoAnswer, LinkLost, WrongAnswer) as problem:
            error = problem
        seconds = time.monotonic() - started
        now = {each.name: (each.value, each.unit, str(each.error)) for each in found}
        changed = frozenset(name for name, reading in now.items() if last.get(name, reading) != reading)
        last.update(now)
        yield Round(number, moment, seconds, found, changed, error, late=seconds > every)
        failed += 1
        if error is None:
            failed = 0
        elif failed == give_up:
            raise GaveUp(failed, error)
        if number != count:
            sleep(max(started + every - time.monotonic(), seconds * IDLE_SHARE))


def _pause(device: BareDevice, one: Readable) -> float:
    """Seconds after which a reading may tell something new; a computed value changes with each of its registers."""
    registers = [device.registers[path] for path in one.needs] if isinstance(one, Computed) else [one]
    return min((each.reading.pause for each in registers), default=0)
