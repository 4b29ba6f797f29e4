"""Scale and range of a register in given surroundings: which cases hold, as numbers, and values for limits."""

from fractions import Fraction
from typing import NamedTuple

from regscribe.emit.vectors.scale import range_now, valid_now
from regscribe.model import Case, Cases, Conversion, Interval, Number, Ref, Register
from regscribe.reference import Surroundings, choose, decimal_factor, holds, present_sentinels, straight
from regscribe_runtime.values.conditions import T

LOW_STORED, HIGH_STORED = Fraction(100), Fraction(1500)
"""Values for limits in other registers, as stored numbers: every type of 16 bits and more can hold them."""


class CasesNow(NamedTuple):
    """Indices of the cases that hold, what exists, and the numbers in the cases: equal ones behave the same."""

    scale: int
    range: int
    valid: int
    faults: int
    partial: tuple[bool, ...]
    numbers: tuple[object, ...]


def cases_of(register: Register, known: Surroundings) -> CasesNow:
    """Return which cases hold, with their numbers."""
    ranges = register.range if register.access.writable else ()
    return CasesNow(
        _index(register.scale, known),
        _index(ranges, known),
        _index(register.valid, known),
        _index(fault_cases(register), known),
        tuple(holds(case.when, known) for case in register.partial),
        _numbers(register, known),
    )


def fault_cases(register: Register) -> Cases[str]:
    """Return the cases in which sentinels are faults."""
    return tuple(Case(sentinel.when, sentinel.id) for sentinel in register.sentinels)


def _index(cases: Cases[T], known: Surroundings) -> int:
    return next((index for index, case in enumerate(cases) if holds(case.when, known)), -1)


def _numbers(register: Register, known: Surroundings) -> tuple[object, ...]:
    conversion, special = choose(register.scale, known), choose(register.special_scale, known)
    limited = [one for one in (range_now(register, known), valid_now(register, known)) if one]
    return (
        straight(conversion, known),
        _increment(register, conversion, known),
        tuple((one.intervals, decimal_factor(one.decimals, known)) for one in limited),
        tuple(sentinel[:-1] for sentinel in present_sentinels(register, known)),
        special and decimal_factor(special.decimals, known),
    )


def _increment(register: Register, conversion: Conversion | None, known: Surroundings) -> object:
    """Return the step between the stored numbers that may be written."""
    if conversion is None or conversion.step is None or not register.access.writable:
        return conversion and conversion.step
    factor = decimal_factor(conversion.places, known)
    return factor and conversion.step / factor


def limit_values(register: Register, known: Surroundings) -> dict[str, Fraction]:
    """Return a value for each register that holds a limit of what may be read or written now."""
    lowest, highest = _usual(register, known)
    values: dict[str, Fraction] = {}
    for limits_now in filter(None, (range_now(register, known), valid_now(register, known))):
        factor = decimal_factor(limits_now.decimals, known) or Fraction(1)
        for interval in limits_now.intervals:
            ends = _ends(interval, lowest, highest, factor)
            for limit, value in zip((interval.low, interval.high), ends, strict=True):
                if isinstance(limit, Ref):
                    values.setdefault(limit.register, value)
    return values


def _usual(register: Register, known: Surroundings) -> tuple[Fraction, Fraction]:
    """Return LOW_STORED and HIGH_STORED as values of use, the lower one first."""
    line = straight(choose(register.scale, known), known)
    if line is None:  # nothing can be written then, whatever the limits
        return LOW_STORED, HIGH_STORED
    low, high = sorted(map(line.value, (LOW_STORED, HIGH_STORED)))
    return low, high


def _ends(interval: Interval, low: Fraction, high: Fraction, factor: Fraction) -> tuple[Fraction, Fraction]:
    """Return both ends, moved where the other end is a number beyond them."""
    width = high - low
    if isinstance(interval.low, Number) and interval.low / factor >= high:
        high = interval.low / factor + width
    if isinstance(interval.high, Number) and interval.high / factor <= low:
        low = interval.high / factor - width
    return low, high
