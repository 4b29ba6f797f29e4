"""A setpoint program in the terminal: its settings, its segments as a table, and its curve."""

import shutil
import sys
from collections.abc import Iterator

from regscribe.cli.chart import chart
from regscribe.cli.output import show_table
from regscribe.programs.axis import time_scale
from regscribe.programs.files import plain
from regscribe.programs.model import RAW, Program
from regscribe.programs.profile import Profile, profile

POINTS = 400
"""The curve is drawn through so many points, since a line between two is drawn at its ends only."""

SECONDS = {"s": 1, "min": 60, "h": 3600, "d": 86400, "": 1}


def show_program(program: Program, *, first: int = 1) -> None:
    """Print a program: settings, segments, curve."""
    facts = {key: value for key, value in plain(program).items() if not isinstance(value, list | dict)}
    show_table(("SETTING", "VALUE"), [(key, str(value)) for key, value in facts.items()])
    names = list(dict.fromkeys(name for one in program.segments for name in one.outputs))
    soaks = any(one.soak is not None for one in program.segments)
    columns = ("SEGMENT", "TO", "RAMP", *(("SOAK",) if soaks else ()), *(name.upper() for name in names))
    sys.stdout.write("\n")
    show_table(columns, [columns] * (not sys.stdout.isatty()) + list(_rows(program, names, first=first, soaks=soaks)))
    curve(profile(program, first=first))


def _rows(program: Program, names: list[str], *, first: int, soaks: bool) -> Iterator[tuple[str, ...]]:
    for number, one in enumerate(program.segments, start=first):
        soak = (str(one.soak),) if soaks else ()
        yield (str(number), str(one.to), str(one.ramp), *soak, *(one.outputs.get(name, "") for name in names))
    if program.final:
        soak = ("",) if soaks else ()
        yield ("final", str(program.final.to), "", *soak, *(program.final.outputs.get(name, "") for name in names))


def curve(found: Profile) -> None:
    """Draw the setpoint over time."""
    if not found.total:
        return
    raw = found.time == RAW
    unit = time_scale(found.total, most=6, raw=raw).unit
    times = [float(found.total) * number / POINTS for number in range(POINTS + 1)]
    levels = [_level(found, time) for time in times]
    known = [(time / SECONDS[unit], level) for time, level in zip(times, levels, strict=True) if level is not None]
    wide = shutil.get_terminal_size().columns
    label = f"raw ({found.counts_in})" if raw and found.counts_in else unit or RAW
    text = chart("", [one for one, _ in known], [one for _, one in known], unit=found.level, width=wide, across=label)
    sys.stdout.write(text)


def _level(found: Profile, time: float) -> float | None:
    """The setpoint at a time; None while it comes from wherever the controller was."""
    for leg in found.legs:
        if leg.start <= time <= leg.end:
            if leg.source is None:
                return float(leg.to) if time == leg.end else None
            share = (time - float(leg.start)) / float(leg.end - leg.start) if leg.end > leg.start else 1
            return float(leg.source) + (float(leg.to) - float(leg.source)) * share
    return None
