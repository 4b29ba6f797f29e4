"""What scale and range a register has in given surroundings: which cases hold, and to which numbers they come."""

from regscribe.emit.vectors.scale import range_now
from regscribe.model import Cases, Conversion, Register
from regscribe.reference import Surroundings, choose, decimal_factor, holds
from regscribe_runtime.values.conditions import T


def _index(cases: Cases[T], known: Surroundings) -> int:
    return next((index for index, case in enumerate(cases) if holds(case.when, known)), -1)


def _special_factor(register: Register, known: Surroundings) -> object:
    conversion = choose(register.special_scale, known)
    return conversion and decimal_factor(conversion.decimals, known)


def cases_of(register: Register, known: Surroundings) -> object:
    """Return the cases of scale and range that hold with their decimals, as something to compare."""
    conversion = choose(register.scale, known)
    limits_now = range_now(register, known)
    return (
        _index(register.scale, known),
        conversion and decimal_factor(conversion.decimals, known),
        _special_factor(register, known),
        _index(register.range, known) if register.access.writable else 0,
        limits_now and decimal_factor(limits_now.decimals, known),
        _increment(register, conversion, known),
    )


def _increment(register: Register, conversion: Conversion | None, known: Surroundings) -> object:
    """Return what tells how fine a value may be written."""
    if conversion is None or conversion.step is None or not register.access.writable:
        return conversion and conversion.step
    factor = decimal_factor(conversion.places, known)
    return factor and conversion.step / factor


def numbers_of(register: Register, known: Surroundings) -> object:
    """Return the scale and the limits as numbers: two cases that say the same are the same."""
    conversion = choose(register.scale, known)
    factor = conversion and decimal_factor(conversion.decimals, known)
    increment = _increment(register, conversion, known)
    scale = (conversion.multiply / factor, conversion.add / factor, increment) if conversion and factor else None
    limits_now = range_now(register, known)
    limits = limits_now and limits_now.intervals, limits_now and decimal_factor(limits_now.decimals, known)
    return scale, limits, _special_factor(register, known)
