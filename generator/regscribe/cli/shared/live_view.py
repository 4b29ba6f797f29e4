"""Watched values: on a terminal a table that stays in place, changes marked, curves below; on a pipe lines."""

import sys
from collections import deque
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from regscribe.cli.shared.chart import chart
from regscribe.cli.shared.output import console
from regscribe.tools.live.watch import Round
from regscribe.visible import safe

if TYPE_CHECKING:
    from datetime import datetime

    from rich.console import RenderableType

    from regscribe.tools.live.reading import RegisterReading

MOST_POINTS = 5000
"""Points of a curve that are kept."""

MARK = "*"


class Screen:
    """Keeps the last values, when each changed, and the points of the curves."""

    def __init__(self, device: str, names: Sequence[str], curves: Sequence[str]) -> None:
        self.device, self.names = device, names
        self.latest: dict[str, RegisterReading] = {}
        self.changed: dict[str, datetime] = {}
        self.points: dict[str, deque[tuple[float, float]]] = {name: deque(maxlen=MOST_POINTS) for name in curves}
        self.start: datetime | None = None

    def take(self, one: Round) -> None:
        """Keep the values of a round."""
        self.start = self.start or one.time
        self.latest.update((each.name, each) for each in one.readings)
        self.changed.update(dict.fromkeys(one.changed, one.time))
        for each in one.readings:
            if each.name in self.points and isinstance(each.value, (int, float)) and not isinstance(each.value, bool):
                self.points[each.name].append(((one.time - self.start).total_seconds(), float(each.value)))

    def drawn(self, width: int) -> str:
        """All curves as text."""
        curves = ""
        for name, points in self.points.items():
            unit = self.latest[name].unit if name in self.latest else ""
            curve = chart(name, [x for x, _ in points], [y for _, y in points], unit=unit, width=width)
            curves += curve or f"{name}: no numbers to draw\n"
        return curves

    def follow(self, rounds: Iterator[Round]) -> None:
        """Show rounds in place on the terminal until they end."""
        from rich.live import Live  # noqa: PLC0415 - 60 ms that only a terminal needs

        screen = console(sys.stdout)
        with Live(console=screen, auto_refresh=False) as live:
            for one in rounds:
                self.take(one)
                live.update(self._picture(one, screen.width), refresh=True)

    def _picture(self, latest: Round, width: int) -> "RenderableType":
        from rich.console import Group  # noqa: PLC0415 - as above
        from rich.table import Table  # noqa: PLC0415 - as above
        from rich.text import Text  # noqa: PLC0415 - as above

        table = Table(box=None, pad_edge=False)
        for name in ("REGISTER", "VALUE", "", "CHANGED"):
            table.add_column(name, header_style="bold")
        for name in self.names:
            fresh = name in latest.changed
            style = "bold yellow" if fresh else ""
            value = safe(self.latest[name].spelled) if name in self.latest else "?"
            since = latest.time - self.changed[name] if name in self.changed else None
            age = f"{since.total_seconds():.0f} s ago" if since is not None else ""
            table.add_row(Text(name, "cyan"), Text(value, style), MARK if fresh else "", age)
        late = ", slower than asked for: the line needs that long" if latest.late else ""
        error = f"; {latest.error}" if latest.error else ""
        took = f"round {latest.number} at {latest.moment} took {latest.seconds * 1000:.0f} ms"
        return Group(table, Text(safe(f"{self.device}: {took}{late}{error}"), "dim"), Text(self.drawn(width)))


def lines(one: Round) -> Iterator[str]:
    """A round as lines: its error, and all values of the first, of others those that changed (marked)."""
    if one.error is not None:
        yield f"{one.moment}  {safe(str(one.error))}\n"
    for each in one.readings:
        if one.number == 1 or each.name in one.changed:
            yield f"{one.moment} {MARK if each.name in one.changed else ' '} {each.name} {safe(each.spelled)}\n"
