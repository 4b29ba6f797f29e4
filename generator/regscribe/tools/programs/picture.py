"""The profile of a program as SVG, for light and dark paper: the same bytes for the same program."""

from collections.abc import Iterator, Mapping
from fractions import Fraction
from itertools import groupby
from typing import NamedTuple

from regscribe.pictures.drawing import MARGIN, PLAIN, SMALL, WIDTH, Box, Canvas, Drawing, DrawnLine, Text
from regscribe.pictures.style import tint
from regscribe.pictures.svg import svg
from regscribe.pictures.text_width import width
from regscribe.tools.programs.profile import Leg, Profile, level_scale, profile, time_scale
from regscribe.tools.programs.program import FOREVER, RAW, SECONDS, Program

LEFT, RIGHT = MARGIN + 84, WIDTH - MARGIN - 34
HEIGHT = 260
LANE = 24
BAND = 22
TAIL = 46
"""Pixels: where the curve begins and ends, its height, the lanes of outputs, the band of numbers, the final stay."""

THIN = 2
"""Width of what takes no time, or next to none."""

MOST_LEVELS, MOST_TIMES = 8, 12


class PlotArea(NamedTuple):
    """The area of the curve in the picture: pixels of times and levels."""

    left: float
    right: float
    top: float
    bottom: float
    total: Fraction
    low: Fraction
    high: Fraction

    def x(self, time: Fraction) -> float:
        """The pixel of a time."""
        return self.left + float((self.right - self.left) * time / self.total) if self.total else self.left

    def y(self, level: Fraction) -> float:
        """The pixel of a level."""
        return float(self.bottom - (self.bottom - self.top) * (level - self.low) / (self.high - self.low))


def picture(program: Program, *, first: int = 1) -> str:
    """The SVG file of a program whose first segment has the number `first`."""
    return svg(drawing(program, first=first), "a setpoint program, drawn by regscribe")


def drawing(program: Program, *, first: int = 1) -> Drawing:
    """The picture before it becomes SVG."""
    found = profile(program, first=first)
    canvas = Canvas()
    title = program.name or "Setpoint program"
    canvas.head(title, tuple(_remarks(program, found)))
    if found.legs:
        frame = _axes(canvas, found)
        _numbers(canvas, frame, found)
        _curve(canvas, frame, found)
        canvas.y = frame.bottom + 46
        _lanes(canvas, frame, program, found)
    return canvas.finish(title, describe(program, found))


def describe(program: Program, found: Profile) -> str:
    """The profile in words, as alternative text."""
    last = "; then " + _level(found, found.final) + " stays" if found.final is not None else ""
    legs = [
        f"segment {one.segment}: {one.kind} {_level(found, one.to)} {_duration(found, one.end - one.start)}"
        for one in found.legs
    ]
    return f"{program.name or 'Setpoint program'}: {', '.join(legs) or 'no segments'}{last}."


def _remarks(program: Program, found: Profile) -> Iterator[str]:
    yield f"{'; '.join(_facts(program, found))}."
    if found.legs:
        stays = ", and what stays behind the last segment" if found.final is not None else ""
        yield f"Dashed: from wherever the setpoint is when the program starts{stays}."
    open_scales = [name for name, unit in (("times", found.time), ("setpoints", found.level)) if unit == RAW]
    if open_scales:
        counted = f" (times count in {found.counts_in})" if found.counts_in else ""
        yield f"The manual does not state the decimals of {' and '.join(open_scales)}: raw numbers are drawn{counted}."
    if program.number_of_segments is not None:
        number = program.number_of_segments
        yield f"Number of segments on the device: {number}; whether it counts the first one is not stated."


def _facts(program: Program, found: Profile) -> Iterator[str]:
    yield f"one cycle takes {_duration(found, found.total)}" if found.legs else "no segments"
    if program.cycles is not None:
        yield "cycles without end" if program.cycles == FOREVER else f"cycles: {program.cycles}"
    if program.holdback is not None:
        yield f"holdback {program.holdback}"
    if program.end:
        yield f"at the end {program.end}"
    if program.power_failure:
        yield f"after a power failure {program.power_failure}"


def _level(found: Profile, level: Fraction) -> str:
    return f"{float(level):.10g} {found.level}".rstrip()


def _duration(found: Profile, time: Fraction) -> str:
    """A time in words: `1 h 30 min`; a count where the scale is open."""
    if found.time == RAW:
        return f"{float(time):.10g} raw"
    rest, parts = time, []
    for unit in ("d", "h", "min"):
        count, rest = divmod(rest, Fraction(SECONDS[unit]))
        parts += [f"{count} {unit}"] if count else []
    parts += [f"{float(rest):.10g} s"] if rest or not parts else []
    return " ".join(parts)


def _axes(canvas: Canvas, found: Profile) -> PlotArea:
    """Draw the grid with its numbers; the band of segments comes above it."""
    levels = level_scale(min(found.levels), max(found.levels), most=MOST_LEVELS)
    times = time_scale(found.total, most=MOST_TIMES, raw=found.time == RAW)
    top = canvas.y + BAND + 14
    right = RIGHT - (TAIL if found.final is not None else 0)
    frame = PlotArea(LEFT, right, top, top + HEIGHT, found.total, levels.marks[0][0], levels.marks[-1][0])
    for level, text in levels.marks:
        canvas.add(DrawnLine(((LEFT, frame.y(level)), (RIGHT, frame.y(level))), "grid"))
        canvas.add(Text(LEFT - 8, frame.y(level) + 4, text, PLAIN, "end", "dim"))
    for time, text in times.marks:
        canvas.add(DrawnLine(((frame.x(time), top), (frame.x(time), frame.bottom)), "grid"))
        canvas.add(Text(frame.x(time), frame.bottom + 16, text, PLAIN, "middle", "dim"))
    canvas.add(Text(LEFT - 8, top - 12, found.level, PLAIN, "end", "ink"))
    counted = f" (in {found.counts_in}, decimals not stated)" if found.counts_in else ""
    words = f"time in {times.unit}" if times.unit else f"time as the controller counts it{counted}"
    canvas.text(Text(RIGHT, frame.bottom + 34, words, SMALL + 1, "end", "dim"), RIGHT - LEFT)
    return frame


def _numbers(canvas: Canvas, frame: PlotArea, found: Profile) -> None:
    """Draw the numbers of the segments above the curve, as boxes as long as the segments."""
    for own in _by_segment(found):
        number = own[0].segment
        left, right = frame.x(own[0].start), frame.x(own[-1].end)
        legs = (f"{leg.kind} {_level(found, leg.to)} in {_duration(found, leg.end - leg.start)}" for leg in own)
        tip = f"segment {number}: {', '.join(legs)}"
        canvas.add(Box(left, frame.top - 10 - BAND, max(right - left, THIN), BAND, "empty", tip, radius=2))
        if right - left > width(str(number), PLAIN, bold=True):
            middle, base = (left + right) / 2, frame.top - 10 - BAND / 2 + 4
            canvas.text(Text(middle, base, str(number), PLAIN, "middle", "ink mark", bold=True), right - left)


def _curve(canvas: Canvas, frame: PlotArea, found: Profile) -> None:
    """Draw the setpoint over time; dashed where it begins, since that depends on the controller, and where it stays."""
    first = found.legs[0]
    canvas.add(
        DrawnLine(((frame.x(first.start), frame.bottom), (frame.x(first.end), frame.y(first.to))), "curve dashed")
    )
    points = [(frame.x(first.end), frame.y(first.to))]
    points += [(frame.x(leg.end), frame.y(leg.to)) for leg in found.legs[1:]]
    if len(points) > 1:
        canvas.add(DrawnLine(tuple(points), "curve"))
    if found.final is not None:
        end = points[-1]
        canvas.add(DrawnLine((end, (end[0], frame.y(found.final)), (RIGHT, frame.y(found.final))), "curve dashed"))


def _lanes(canvas: Canvas, frame: PlotArea, program: Program, found: Profile) -> None:
    """Draw a lane for each output, with its state in each segment and behind the last one."""
    names = list(dict.fromkeys(name for one in program.segments for name in one.outputs))
    colours = _colours(program)
    spans = [(legs[0].start, legs[-1].end) for legs in _by_segment(found)]
    for name in names:
        canvas.text(Text(LEFT - 8, canvas.y + LANE / 2 + 4, name, SMALL + 1, "end"), LEFT - 8 - MARGIN)
        states = [one.outputs.get(name, "") for one in program.segments]
        for state, run in groupby(zip(spans, states, strict=True), key=lambda pair: pair[1]):
            ends = [span for span, _ in run]
            _state(canvas, frame.x(ends[0][0]), frame.x(ends[-1][1]), state, colours)
        if program.final:
            _state(canvas, frame.right, RIGHT, program.final.outputs.get(name, ""), colours)
        canvas.y += LANE + 4
    if names:
        _legend(canvas, colours)


def _colours(program: Program) -> dict[str, str]:
    """The colours of the states that outputs have, in the order in which they occur."""
    outputs = [one.outputs for one in program.segments] + ([program.final.outputs] if program.final else [])
    states = dict.fromkeys(state for one in outputs for state in one.values())
    return {state: tint(number) for number, state in enumerate(states, start=1)}  # 0 is the colour of the curve


def _by_segment(found: Profile) -> Iterator[list[Leg]]:
    return (list(legs) for _, legs in groupby(found.legs, key=lambda leg: leg.segment))


def _state(canvas: Canvas, left: float, right: float, state: str, colours: Mapping[str, str]) -> None:
    if state:
        canvas.add(Box(left, canvas.y, max(right - left, THIN), LANE, colours[state], state, radius=2))
        middle, base = (left + right) / 2, canvas.y + LANE / 2 + 4
        canvas.text(Text(middle, base, state, SMALL + 1, "middle", "ink mark"), right - left - 6)


def _legend(canvas: Canvas, colours: Mapping[str, str]) -> None:
    """Name the colours of the states: a narrow box has no room for its name."""
    x = float(LEFT)
    canvas.y += 8
    for state, style in colours.items():
        room = min(float(Text(0, 0, state, SMALL + 1).box.width), 240.0)
        if x + room + 24 > RIGHT:
            x, canvas.y = float(LEFT), canvas.y + 18
        canvas.add(Box(x, canvas.y, 12, 12, style, radius=2))
        canvas.text(Text(x + 18, canvas.y + 10, state, SMALL + 1, style="dim"), room + 2)
        x += room + 36
    canvas.y += 16
