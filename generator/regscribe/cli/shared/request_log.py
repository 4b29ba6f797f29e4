"""Requests to a simulator, shown as they come: one a line, or the last ones in a table on a terminal."""

import asyncio
import sys
import time
from collections import Counter, deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from regscribe.cli.shared import output
from regscribe.cli.shared.diagnostic_text import count
from regscribe.simulate import Exchange, SimulatedDevice, tell
from regscribe.visible import safe

if TYPE_CHECKING:
    from rich.table import Table

ROWS = 18
"""Most requests that the table shows."""

FRAME = 6
"""Lines of the table around its requests, and the one on which the cursor waits."""

REFRESH = 0.25
"""Seconds after which the table is drawn anew."""

LONGEST = 200
"""Characters of a line at most."""


@dataclass(slots=True)
class RequestLog:
    """The last requests and their number; with `printed`, each is written on a line as it comes."""

    devices: Sequence[SimulatedDevice]
    last: deque[tuple[float, Exchange]] = field(default_factory=lambda: deque(maxlen=ROWS))
    counts: Counter[str] = field(default_factory=Counter)
    printed: bool = False

    def note(self, exchange: Exchange) -> None:
        """Keep one request."""
        self.counts["requests"] += 1
        self.counts["unanswered" if exchange.answer is None else "answered"] += 1
        self.last.append((time.time(), exchange))
        if self.printed:
            self._print(exchange)

    def _print(self, exchange: Exchange) -> None:
        told = tell(self.devices, exchange)
        mark = "" if told.good else f": {told.outcome}"
        try:
            line = f"{_clock(time.time())} unit {told.unit} {told.verb} {told.what}{mark}"
            output.tell(safe(line)[:LONGEST] + "\n")
            sys.stdout.flush()
        except BrokenPipeError:  # the reader went away; the clients stay
            self.printed = False


async def table(requests: RequestLog) -> None:
    """Show the last requests in a table that is drawn anew now and then, until cancelled."""
    from rich.live import Live  # noqa: PLC0415 - only a terminal needs it

    screen = output.console(sys.stdout)
    with Live(drawn(requests, screen.height), console=screen, auto_refresh=False, transient=True) as live:
        while True:
            await asyncio.sleep(REFRESH)
            live.update(drawn(requests, screen.height), refresh=True)


def drawn(requests: RequestLog, height: int) -> "Table":
    """The newest requests, as many as a screen of that height holds: what is too high would be cut at its end."""
    from rich.table import Table  # noqa: PLC0415 - only a terminal needs it
    from rich.text import Text  # noqa: PLC0415 - as above

    counts = requests.counts
    title = f"{count(counts['requests'], 'request')}, {counts['unanswered']} unanswered"
    made = Table("Time", "Unit", "Request", "Registers", "Answer", title=title, expand=True)
    for column in made.columns:
        column.no_wrap = True
    for when, exchange in tuple(requests.last)[-max(height - FRAME, 1) :]:
        told = tell(requests.devices, exchange)
        style = "" if told.good else "red"
        cells = (_clock(when), str(told.unit), told.verb, told.what[:LONGEST], told.outcome)
        made.add_row(*(Text(cell, style=style) for cell in cells))
    return made


def _clock(seconds: float) -> str:
    return f"{time.strftime('%H:%M:%S', time.localtime(seconds))}.{int(seconds % 1 * 1000):03d}"
