"""Limits of a register with the values of other registers and the givens, and whether a value keeps to them."""

from fractions import Fraction

from regscribe.model.register import Register
from regscribe.reference.outcome import RefusalReason, RefusedError
from regscribe.reference.surroundings import Known, choose, decimal_factor
from regscribe.reference.terms import amount
from regscribe_runtime.values.numbers import Number
from regscribe_runtime.values.scales import Limit, Open, Range

Limits = tuple[tuple[Fraction | None, Fraction | None], ...]
"""Lowest and highest value of each interval; None where nothing limits."""


def _limit(limit: Limit, factor: Fraction, known: Known) -> Fraction | None:
    """Return the number of a limit; None for an open one, which nothing is checked against."""
    if isinstance(limit, Open):
        return None
    if isinstance(limit, Number):
        return limit / factor
    found = amount(limit, known)
    if found is None:
        raise RefusedError(RefusalReason.CONDITION, "a limit of the range has no value as things stand")
    return found


def limits(limits_now: Range, known: Known) -> Limits:
    """Return the limits; raises RefusedError if the decimals register holds no number of decimals."""
    factor = decimal_factor(limits_now.decimals, known)
    if factor is None:
        raise RefusedError(RefusalReason.CONDITION, f"{limits_now.decimals} holds no number of decimals")
    return divided_limits(limits_now, factor, known)


def divided_limits(limits_now: Range, factor: Fraction, known: Known) -> Limits:
    """Return the limits, those that are numbers divided by `factor`."""
    return tuple(
        (_limit(interval.low, factor, known), _limit(interval.high, factor, known)) for interval in limits_now.intervals
    )


def in_range(register: Register, value: Fraction, known: Known) -> bool:
    """Tell whether `value` lies in one of the intervals that hold now; a register without range takes all.

    Raises RefusedError if the range has cases and none holds.
    """
    if not register.range:
        return True
    limits_now = choose(register.range, known)
    if limits_now is None:
        raise RefusedError(RefusalReason.CONDITION, "no range holds as things stand")
    return within(limits(limits_now, known), value)


def is_valid(register: Register, value: Fraction, known: Known) -> bool:
    """Tell whether `value` lies in what is valid now; where no case holds, everything is.

    Raises RefusedError as `limits` does.
    """
    valid_now = choose(register.valid, known)
    return valid_now is None or within(limits(valid_now, known), value)


def within(limits_now: Limits, value: Fraction) -> bool:
    """Tell whether `value` lies in one of the intervals."""
    return any((low is None or low <= value) and (high is None or value <= high) for low, high in limits_now)
