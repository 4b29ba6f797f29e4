"""A setpoint program in the terminal: its settings, its segments as a table, and its curve."""

import shutil
import sys
from collections.abc import Iterator
from fractions import Fraction

from regscribe.cli.shared.chart import empty_figure
from regscribe.cli.shared.output import show_table, tell
from regscribe.tools.programs.profile import Profile, profile, round_step, time_scale
from regscribe.tools.programs.program import RAW, SECONDS, Program
from regscribe.tools.programs.program_file import plain

BLANK = " \u2800"
"""A space, and the empty braille pattern."""

PIPED = 80
"""Columns where there is no terminal."""

ROWS, COLUMNS, MARGIN, MOST = 16, 10, 16, 6
"""Most rows of the curve, columns between two marks, columns of the scale beside it, most marks of a unit of time."""


def show_program(program: Program, *, first: int = 1) -> None:
    """Print a program: settings, segments, curve."""
    facts = {key: value for key, value in plain(program).items() if not isinstance(value, list | dict)}
    show_table(("SETTING", "VALUE"), [(key, str(value)) for key, value in facts.items()])
    names = list(dict.fromkeys(name for one in program.segments for name in one.outputs))
    soaks = any(one.soak is not None for one in program.segments)
    columns = ("SEGMENT", "TO", "RAMP", *(("SOAK",) if soaks else ()), *(name.upper() for name in names))
    tell("\n")
    show_table(columns, [columns] * (not sys.stdout.isatty()) + list(_rows(program, names, first=first, soaks=soaks)))
    curve(profile(program, first=first))


def _rows(program: Program, names: list[str], *, first: int, soaks: bool) -> Iterator[tuple[str, ...]]:
    for number, one in enumerate(program.segments, start=first):
        soak = ("" if one.soak is None else str(one.soak),) if soaks else ()
        yield (str(number), str(one.to), str(one.ramp), *soak, *(one.outputs.get(name, "") for name in names))
    if program.final:
        soak = ("",) if soaks else ()
        yield ("final", str(program.final.to), "", *soak, *(program.final.outputs.get(name, "") for name in names))


def curve(found: Profile) -> None:
    """Draw the setpoint over time; round numbers stand at every row and every tenth column."""
    if not found.total:
        return
    raw = found.time == RAW
    unit = time_scale(found.total, most=MOST, raw=raw).unit
    seconds = Fraction(SECONDS.get(unit, 1))
    columns = shutil.get_terminal_size().columns if sys.stdout.isatty() else PIPED
    wide = max((columns - MARGIN) // COLUMNS, 2)
    across = round_step(found.total / seconds, most=wide)
    low, high = min(found.levels), max(found.levels)
    up = round_step(max(high - low, Fraction(1)), most=ROWS - 2)
    bottom = low // up * up
    marks, rows = -(-found.total // (across * seconds)), -((bottom - high) // up) + 1
    figure = empty_figure(max(marks, 1) * COLUMNS, max(rows, 2), digits=6)
    figure.set_x_limits(0, float(across * figure.width / COLUMNS))
    figure.set_y_limits(float(bottom), float(bottom + up * figure.height))
    figure.x_label = f"raw ({found.counts_in})" if raw and found.counts_in else unit or RAW
    figure.y_label = found.level
    points = [(leg.end / seconds, leg.to) for leg in found.legs]
    figure.plot([float(time) for time, _ in points], [float(level) for _, level in points])
    tell("\n" + "".join(f"{line.rstrip(BLANK)}\n" for line in figure.show().splitlines()))
