"""What a program looks like over time: its legs, each a ramp or a stay, in one unit of time."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal, NamedTuple

from regscribe.tools.programs.program import RAW, SECONDS, Amount, Program, Setting

NOUGHT = Fraction(0)


class Leg(NamedTuple):
    """A part of a segment: from `start` to `end` the setpoint goes `source` -> `to` (None: where it happens to be)."""

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
        """How long one cycle takes."""
        return self.legs[-1].end if self.legs else NOUGHT

    @property
    def levels(self) -> tuple[Fraction, ...]:
        """All setpoints."""
        final = () if self.final is None else (self.final,)
        return (*(leg.to for leg in self.legs), *final)


def profile(program: Program, *, first: int = 1) -> Profile:
    """The profile of a program whose first segment has the number `first`; settings by name take no time."""
    raw = any(
        isinstance(time, Amount) and time.unit == RAW for one in program.segments for time in (one.ramp, one.soak)
    )
    legs: list[Leg] = []
    now, level = NOUGHT, None
    for number, segment in enumerate(program.segments, start=first):
        to = _number(segment.to)
        end = now + _time(segment.ramp)
        legs.append(Leg(number, "ramp", now, end, level, to))
        now, level = end, to
        if segment.soak is not None:
            end = now + _time(segment.soak)
            legs.append(Leg(number, "soak", now, end, level, to))
            now = end
    final = program.final
    settings = [*(one.to for one in program.segments), *([final.to] if final else [])]
    units = [one.unit for one in settings if isinstance(one, Amount)]
    return Profile(
        legs=tuple(legs),
        time=RAW if raw else "s",
        level=next((unit for unit in units if unit), ""),
        final=_number(final.to) if final else None,
        counts_in=(program.time_unit or "") if raw else "",
    )


def _number(setting: Setting) -> Fraction:
    return Fraction(setting.number) if isinstance(setting, Amount) else NOUGHT


def _time(setting: Setting) -> Fraction:
    if not isinstance(setting, Amount):
        return NOUGHT
    return Fraction(setting.number) * Fraction(SECONDS.get(setting.unit, 1))
