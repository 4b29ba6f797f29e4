"""Values for limits that stand in other registers, such that the range between them is not empty."""

from fractions import Fraction

from regscribe.emit.vectors.scale import range_now
from regscribe.model import Interval, Kind, Number, Ref, Register
from regscribe.reference import Surroundings, choose, decimal_factor

LOW_STORED, HIGH_STORED = Fraction(100), Fraction(1500)
"""Where limits that stand in other registers are put: stored numbers that every type of 16 bits and more can hold."""


def limit_values(register: Register, known: Surroundings) -> dict[str, Fraction]:
    """Return a value for each register that holds a limit of what may be written now."""
    limits_now = range_now(register, known)
    if limits_now is None or register.kind is Kind.STRING:
        return {}
    lowest, highest = _usual(register, known)
    factor = decimal_factor(limits_now.decimals, known) or Fraction(1)
    values: dict[str, Fraction] = {}
    for interval in limits_now.intervals:
        for limit, value in zip((interval.low, interval.high), _ends(interval, lowest, highest, factor), strict=True):
            if isinstance(limit, Ref):
                values.setdefault(limit.register, value)
    return values


def _usual(register: Register, known: Surroundings) -> tuple[Fraction, Fraction]:
    """Return the values of use of the two stored numbers, the lower one first."""
    conversion = choose(register.scale, known)
    factor = conversion and decimal_factor(conversion.decimals, known)
    if conversion is None or not factor:  # nothing can be written then, whatever the limits
        return LOW_STORED, HIGH_STORED
    low, high = sorted((conversion.multiply * stored + conversion.add) / factor for stored in (LOW_STORED, HIGH_STORED))
    return low, high


def _ends(interval: Interval, low: Fraction, high: Fraction, factor: Fraction) -> tuple[Fraction, Fraction]:
    """Return both ends, moved as far as the other one, a number, asks for it."""
    width = high - low
    if isinstance(interval.low, Number) and interval.low / factor >= high:
        high = interval.low / factor + width
    if isinstance(interval.high, Number) and interval.high / factor <= low:
        low = interval.high / factor - width
    return low, high
