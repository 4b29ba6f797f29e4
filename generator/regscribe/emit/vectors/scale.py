"""Scale and limits of a register in one situation, as numbers."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import ceil, floor, gcd, lcm

from regscribe.model import Range, Register, View, WireType
from regscribe.reference import Known, RefusedError, choose, decimal_factor, ieee_number, limits, shortest, straight
from regscribe.reference.limits import Limits

LARGEST = {
    WireType.FLOAT16: shortest(ieee_number(0x7BFF, WireType.FLOAT16), WireType.FLOAT16),
    WireType.FLOAT32: shortest(ieee_number(0x7F7FFFFF, WireType.FLOAT32), WireType.FLOAT32),
    WireType.FLOAT64: shortest(ieee_number(0x7FEFFFFFFFFFFFFF, WireType.FLOAT64), WireType.FLOAT64),
}
NEIGHBOURS = (Fraction(-1), Fraction(1))


@dataclass(frozen=True, slots=True)
class Scale:
    """value = `slope` x stored + `offset`; `limits` in values of use, None where nothing limits.

    `wire_step` is how far two stored numbers lie apart that the view can carry (0: an IEEE view without steps);
    `lowest` and `highest` are the ends of what the view can carry and a write may use, in stored numbers.
    """

    slope: Fraction
    offset: Fraction
    wire_step: Fraction
    lowest: Fraction
    highest: Fraction
    limits: Limits

    def value(self, stored: Fraction) -> Fraction:
        """Return the value of use of a stored number."""
        return self.slope * stored + self.offset

    def stored(self, value: Fraction) -> Fraction:
        """Return the stored number of a value of use."""
        return (value - self.offset) / self.slope

    @property
    def size(self) -> Fraction:
        """Distance of two values that the view can carry; 0 where it has no steps."""
        return abs(self.slope) * self.wire_step

    @property
    def step(self) -> Fraction:
        """Distance of two values; a tenth of a stored unit where the view has no steps."""
        return self.size or abs(self.slope) * Fraction(1, 10)

    def stored_limits(self) -> Iterator[tuple[Fraction, str]]:
        """Yield the stored numbers of all limits, and of both neighbours of each."""
        for interval in self.limits:
            for end in interval:
                if end is not None:
                    stored = self.stored(end)
                    yield stored, "a limit of the range"
                    yield from ((stored + side * (self.wire_step or 1), "beside a limit") for side in NEIGHBOURS)

    def domain(self) -> tuple[tuple[Fraction, Fraction], ...]:
        """Return the stretches of values that can be written: limits and view together, ends on whole steps."""
        lowest, highest = sorted((self.value(self.lowest), self.value(self.highest)))
        limits = self.limits or ((None, None),)
        inner = (
            (lowest if low is None else max(lowest, low), highest if high is None else min(highest, high))
            for low, high in limits
        )
        stretches = (self.on_steps(low, high) for low, high in inner)
        return tuple((low, high) for low, high in stretches if low <= high)

    def whole_domain(self) -> tuple[Fraction, tuple[tuple[Fraction, Fraction], ...]]:
        """Return the step between whole numbers among the values, and the stretches between such; none without any."""
        if not self.size:
            return Fraction(1), tuple((Fraction(ceil(low)), Fraction(floor(high))) for low, high in self.domain())
        period = Fraction(self.size.numerator)
        first = (self.offset + self.size * steps for steps in range(self.size.denominator))
        whole = next((value for value in first if value.denominator == 1), None)
        if whole is None:
            return period, ()
        inner = (
            (whole + period * ceil((low - whole) / period), whole + period * floor((high - whole) / period))
            for low, high in self.domain()
        )
        return period, tuple((low, high) for low, high in inner if low <= high)

    def on_steps(self, low: Fraction, high: Fraction) -> tuple[Fraction, Fraction]:
        """Return the first and the last value between two that stand on a step."""
        if not self.wire_step:
            return low, high
        size = self.size
        return (
            self.offset + size * ceil((low - self.offset) / size),
            self.offset + size * floor((high - self.offset) / size),
        )


def valid_now(register: Register, known: Known) -> Range | None:
    """Return what is valid in this situation; None if no case holds."""
    return choose(register.valid, known)


def range_now(register: Register, known: Known) -> Range | None:
    """Return the range that holds for writing in this situation; None if nothing can be written or no case holds."""
    return choose(register.range, known) if register.access.writable else None


def scale_now(register: Register, view: View, known: Known) -> Scale | None:
    """Return the scale in this situation; None if no case holds or the decimals are no number of decimals."""
    conversion = choose(register.scale, known)
    if conversion is None:
        return None
    limits_now = range_now(register, known)
    checked = [one for one in (limits_now, valid_now(register, known)) if one is not None]
    line = straight(conversion, known)
    places = decimal_factor(conversion.places if register.access.writable else None, known)
    try:
        bounds = _common([limits(one, known) for one in checked])
    except RefusedError:
        return None
    if line is None or places is None or view.times is not None:  # the latter: it has no factor now
        return None
    if view.type.is_float:
        lowest, highest = -LARGEST[view.type], LARGEST[view.type]
    else:
        lowest, highest = Fraction(view.type.minimum + view.saturates), Fraction(view.type.maximum - view.saturates)
    return Scale(
        slope=line.slope,
        offset=line.offset,
        wire_step=_wire_step(view, None if conversion.step is None else conversion.step / places),
        lowest=lowest / view.factor,
        highest=highest / view.factor,
        limits=bounds,
    )


def _common(every: list[Limits]) -> Limits:
    """Return the intervals of what all limits allow; reversed ones where two of them have nothing in common."""
    return reduce(_both, every) if every else ()


def _both(ones: Limits, others: Limits) -> Limits:
    return tuple(
        (
            max((end for end in (low, least) if end is not None), default=None),
            min((end for end in (high, most) if end is not None), default=None),
        )
        for low, high in ones
        for least, most in others
    )


def _wire_step(view: View, step: Fraction | None) -> Fraction:
    """Return the smallest number that the step of the view and that of writing divide; 0 means no step."""
    wire = Fraction(0) if view.type.is_float else 1 / Fraction(view.factor)
    if step is None or wire == 0:
        return step or wire
    return Fraction(lcm(wire.numerator, step.numerator), gcd(wire.denominator, step.denominator))
