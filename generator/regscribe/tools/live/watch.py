"""Reading the same registers again and again: round by round, what changed, never faster than the line can carry."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from typing import Any, NamedTuple

from regscribe.tools.live.reading import RegisterReading, readings
from regscribe_runtime import BareDevice, LinkLost, NoAnswer, Register, RegscribeError, WrongAnswer

IDLE_SHARE = 0.1
"""Of the time that a round takes on the line, how much it is left to others before the next."""

NEVER = 0


class Round(NamedTuple):
    """One reading of all: when it began, how long it took, what it read; `changed` since the last good round.

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
    """So many rounds in a row failed that watching ends; `error` is the last one's."""

    def __init__(self, failed: int, error: RegscribeError) -> None:
        super().__init__(f"{failed} rounds in a row failed: {error}")
        self.error = error


def watch(
    device: BareDevice,
    registers: Sequence[Register[Any]],
    *,
    every: float,
    count: int = NEVER,
    give_up: int = NEVER,
    sleep: Callable[[float], None] = time.sleep,
) -> Iterator[Round]:
    """Read `registers` every so many seconds, `count` times (0: for ever).

    A round begins at the earliest when the last one is done and the line was idle for a tenth of its time. A device
    that does not answer is asked again in the next round; after `give_up` such rounds in a row (0: never) GaveUp is
    raised.
    """
    task = readings(registers)
    last: dict[str, RegisterReading] = {}
    failed = number = 0
    while not count or number < count:
        number += 1
        moment, started = datetime.now(UTC), time.monotonic()
        found, error = _read(device, task)
        seconds = time.monotonic() - started
        changed = _changed(last, found)
        last.update((one.name, one) for one in found)
        yield Round(number, moment, seconds, found, changed, error, late=seconds > every)
        failed = failed + 1 if error else 0
        if error and failed == give_up:
            raise GaveUp(failed, error)
        if number != count:
            sleep(max(started + every - time.monotonic(), seconds * IDLE_SHARE))


def _read(device: BareDevice, task: Any) -> tuple[tuple[RegisterReading, ...], RegscribeError | None]:  # noqa: ANN401 - a task
    try:
        return device.run(task), None
    except (NoAnswer, LinkLost, WrongAnswer) as error:
        return (), error


def _changed(last: Mapping[str, RegisterReading], found: Sequence[RegisterReading]) -> frozenset[str]:
    """The registers that are not as they were; none in the first round."""
    return frozenset(one.name for one in found if last and _said(last.get(one.name)) != _said(one))


def _said(one: RegisterReading | None) -> object:
    return one and (one.value, one.unit, str(one.error))
