"""Which values a register (or a bit field) can have, as stretches from low to high."""

from collections.abc import Iterator
from fractions import Fraction

from regscribe.checks.representable import forms, widest
from regscribe.model import BitField, CodeRange, Enum, Interval, Kind, Number, Register, WireType

ANYTHING = (CodeRange(Fraction(-(10**30)), Fraction(10**30)),)
"""For floats and for texts: no end that matters."""


def domain(register: Register, field: str = "") -> tuple[CodeRange, ...]:
    """The values of use that the map allows for: members and invalid codes of an enum, the range and special values."""
    if field:
        bits = next((one for one in register.fields if one.id == field), None)
        return _of_field(bits) if bits else ANYTHING
    if register.enum is not None:
        return _codes(register.enum)
    if register.kind in {Kind.FLAGS, Kind.FIELDS}:
        return (CodeRange(Fraction(0), Fraction((1 << register.bits) - 1)),)
    if register.kind is Kind.STRING or register.base.type is WireType.STRING:
        return ANYTHING
    return _without_faults(register, _of_number(register))


def _of_field(bits: BitField) -> tuple[CodeRange, ...]:
    if bits.enum is not None:
        return _codes(bits.enum)
    return (CodeRange(Fraction(0), Fraction((1 << bits.width) - 1)),)


def _codes(enum: Enum) -> tuple[CodeRange, ...]:
    codes = sorted({member.code for member in enum.members} | {code for code, _ in enum.invalid})
    return tuple(CodeRange(Fraction(code), Fraction(code)) for code in codes)


def _of_number(register: Register) -> tuple[CodeRange, ...]:
    reach = widest(register)
    low, high = reach or (ANYTHING[0].low, ANYTHING[0].high)
    intervals = [interval for case in register.range for interval in case.then.intervals]
    if not intervals or any(case.then.decimals for case in register.range):
        return (CodeRange(low, high),)
    stretches = [_stretch(interval, low, high) for interval in intervals]
    meant = [special.code if special.means is None else special.means for special in register.specials]
    return tuple(stretches + [CodeRange(value, value) for value in meant])


def _stretch(interval: Interval, low: Fraction, high: Fraction) -> CodeRange:
    first = interval.low.value if isinstance(interval.low, Number) else low
    last = interval.high.value if isinstance(interval.high, Number) else high
    return CodeRange(first, last)


def _without_faults(register: Register, stretches: tuple[CodeRange, ...]) -> tuple[CodeRange, ...]:
    """Cut out the stored numbers that report faults, where they have one value each: no state has them as values."""
    every = forms(register) if register.faults else ()
    if len(every) != 1 or any(view.factor != 1 or view.type.is_float for view in register.views):
        return stretches
    step = 1 / abs(every[0].gain)
    for stored in register.faults:
        value = every[0].used(stored)
        stretches = tuple(part for stretch in stretches for part in _cut(stretch, value, step))
    return stretches


def _cut(stretch: CodeRange, value: Fraction, step: Fraction) -> Iterator[CodeRange]:
    """Yield what is left of a stretch without one value in it."""
    if not stretch.holds(value):
        yield stretch
        return
    sides = (CodeRange(stretch.low, value - step), CodeRange(value + step, stretch.high))
    yield from (side for side in sides if side.low <= side.high)
