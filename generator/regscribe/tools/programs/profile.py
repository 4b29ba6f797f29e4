"""A program over time: its legs, each a ramp or a soak, and round numbers for the axes."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, NamedTuple

from regscribe.tools.programs.program import RAW, SECONDS, Amount, Program, Setting

NOUGHT = Fraction(0)

STEPS = tuple(Fraction(step) * Fraction(10) ** power for power in range(-6, 10) for step in (1, 2, 5))

TIME_STEPS = {
    "s": (1, 2, 5, 10, 15, 30, 60),
    "min": (1, 2, 5, 10, 15, 20, 30, 60),
    "h": (1, 2, 3, 4, 6, 12, 24),
    "d": (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000),
}
"""The steps of a scale in each unit of time."""

FEW = 4
"""A scale has at least about this many steps, or the next smaller unit is taken."""


class Leg(NamedTuple):
    """A part of a segment: from `start` to `end` the setpoint goes from `source` (None: unknown) to `to`."""

    segment: int
    kind: Literal["ramp", "soak"]
    start: Fraction
    end: Fraction
    source: Fraction | None
    to: Fraction


@dataclass(frozen=True, slots=True, kw_only=True)
class Profile:
    """The legs of one cycle. Times are seconds, or the device's own counts where `time` is `raw`.

    `level` is the unit of the setpoints; `final` is the one that stays. Raw times count in `counts_in`.
    """

    legs: tuple[Leg, ...]
    time: str
    level: str
    final: Fraction | None = None
    counts_in: str = ""

    @property
    def total(self) -> Fraction:
        """The time of one cycle."""
        return self.legs[-1].end if self.legs else NOUGHT

    @property
    def levels(self) -> tuple[Fraction, ...]:
        """All setpoints."""
        final = () if self.final is None else (self.final,)
        return (*(leg.to for leg in self.legs), *final)


def profile(program: Program, *, first: int = 1) -> Profile:
    """The profile of a program whose first segment has the number `first`; settings by name take no time."""
    times = [time for one in program.segments for time in (one.ramp, one.soak)]
    raw = RAW in _units(times)
    final = program.final.to if program.final else None
    levels = _units([*(one.to for one in program.segments), final])
    return Profile(
        legs=tuple(_legs(program, first)),
        time=RAW if raw else "s",
        level=next(filter(None, levels), ""),
        final=None if final is None else _number(final),
        counts_in=(program.time_unit or "") if raw else "",
    )


def _units(settings: Sequence[Setting | None]) -> list[str]:
    return [one.unit for one in settings if isinstance(one, Amount)]


def _legs(program: Program, first: int) -> Iterator[Leg]:
    now, level = NOUGHT, None
    for number, segment in enumerate(program.segments, start=first):
        to = _number(segment.to)
        end = now + _time(segment.ramp)
        yield Leg(number, "ramp", now, end, level, to)
        now, level = end, to
        if segment.soak is not None:
            end = now + _time(segment.soak)
            yield Leg(number, "soak", now, end, level, to)
            now = end


def _number(setting: Setting) -> Fraction:
    return Fraction(setting.number) if isinstance(setting, Amount) else NOUGHT


def _time(setting: Setting) -> Fraction:
    unit = setting.unit if isinstance(setting, Amount) else ""
    return _number(setting) * Fraction(SECONDS.get(unit, 1))


class AxisScale(NamedTuple):
    """The places of the marks with their texts, and the unit of the texts."""

    marks: tuple[tuple[Fraction, str], ...]
    unit: str


def level_scale(low: Fraction, high: Fraction, *, most: int) -> AxisScale:
    """At most `most` marks at round numbers that cover everything from `low` to `high`."""
    if low == high:
        margin = max(abs(low) / 10, Fraction(1))
        low, high = low - margin, high + margin
    step = next((one for one in STEPS if (high - low) / one <= most - 2), STEPS[-1])
    first = low // step
    count = -((first * step - high) // step)
    places = [(first + number) * step for number in range(count + 1)]
    return AxisScale(tuple((place, _text(place)) for place in places), "")


def time_scale(total: Fraction, *, most: int, raw: bool) -> AxisScale:
    """Marks from 0 to `total`, which is in seconds, or a count without a scale."""
    if raw:
        return AxisScale(_within(total, round_step(total, most=most), Fraction(1)), "")
    unit = next((name for name in ("d", "h", "min") if total >= FEW * Fraction(SECONDS[name])), "s")
    seconds = Fraction(SECONDS[unit])
    step = round_step(total / seconds, most=most, steps=[Fraction(one) for one in TIME_STEPS[unit]])
    return AxisScale(_within(total, step * seconds, seconds), unit)


def round_step(total: Fraction, *, most: int, steps: Sequence[Fraction] = STEPS) -> Fraction:
    """The smallest of the round steps of which at most `most` reach `total`."""
    return next((one for one in steps if total / one <= most), steps[-1] * max(1, round(total / steps[-1] / most)))


def _within(total: Fraction, step: Fraction, one: Fraction) -> tuple[tuple[Fraction, str], ...]:
    count = int(total // step)
    return tuple((number * step, _text(number * step / one)) for number in range(count + 1))


def _text(number: Fraction) -> str:
    return f"{float(number):.10g}"
