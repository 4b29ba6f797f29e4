"""Round numbers along an axis."""

from collections.abc import Sequence
from fractions import Fraction
from typing import NamedTuple

STEPS = tuple(Fraction(step) * Fraction(10) ** power for power in range(-6, 10) for step in (1, 2, 5))

TIMES = {
    "s": (Fraction(1), (1, 2, 5, 10, 15, 30, 60)),
    "min": (Fraction(60), (1, 2, 5, 10, 15, 20, 30, 60)),
    "h": (Fraction(3600), (1, 2, 3, 4, 6, 12, 24)),
    "d": (Fraction(86400), (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)),
}
"""Units of time: seconds in each, and the steps of a scale in it."""

FEW = 4
"""A scale has at least about this many steps, or the next smaller unit is taken."""


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
        return AxisScale(_within(total, _step(total, STEPS, most), Fraction(1)), "")
    unit = next((name for name in ("d", "h", "min") if total >= FEW * TIMES[name][0]), "s")
    seconds, steps = TIMES[unit]
    step = _step(total / seconds, [Fraction(one) for one in steps], most)
    return AxisScale(_within(total, step * seconds, seconds), unit)


def steps_of(total: Fraction, *, most: int) -> Fraction:
    """The smallest round step of which at most `most` reach `total`."""
    return _step(total, STEPS, most)


def _step(total: Fraction, steps: Sequence[Fraction], most: int) -> Fraction:
    return next((one for one in steps if total / one <= most), steps[-1] * max(1, round(total / steps[-1] / most)))


def _within(total: Fraction, step: Fraction, one: Fraction) -> tuple[tuple[Fraction, str], ...]:
    count = int(total // step)
    return tuple((number * step, _text(number * step / one)) for number in range(count + 1))


def _text(number: Fraction) -> str:
    return f"{float(number):.10g}"
