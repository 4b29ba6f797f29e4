"""Which values a register accepts: enum members, special values, ranges by condition, limits that are registers."""

from abc import abstractmethod
from fractions import Fraction
from typing import Protocol

from regscribe.model import (
    Cases,
    Condition,
    Decimals,
    Enum,
    Interval,
    Kind,
    Limit,
    Number,
    Range,
    Ref,
    Register,
    Special,
)
from regscribe.simulate.device.value_arguments import field_value
from regscribe.simulate.givens import T


class Present(Protocol):
    """The questions that limits ask about the present state of the device."""

    @abstractmethod
    def lookup(self, subject: str) -> Fraction:
        """Return the present number of a register or of `register.field`."""

    @abstractmethod
    def choose(self, cases: Cases[T]) -> T | None:
        """Return what the first case that holds now says; None if none holds."""

    @abstractmethod
    def holds(self, condition: Condition) -> bool:
        """Whether `condition` holds now."""

    @abstractmethod
    def special(self, register: Register, special: Special) -> Fraction:
        """Return the value of use of a special value's code."""

    @abstractmethod
    def power(self, decimals: Decimals | None) -> int:
        """10 to the number of decimals that a register holds now."""


def accepts(register: Register, value: Fraction, state: Present) -> bool:
    """Tell whether the device takes `value` (a value of use) for `register`, given the state of the others.

    Limits that the map leaves open are not checked, nor is anything where no case of the range holds.
    """
    if register.kind is Kind.BOOLEAN and value not in (0, 1):
        return False
    if register.enum is not None and not _is_member(register.enum, value):
        return False
    if any(field.enum and not _is_member(field.enum, field_value(value, field)) for field in register.fields):
        return False
    if any(state.special(register, special) == value for special in register.specials):
        return True
    limits = state.choose(register.range)
    return limits is None or any(_within(each, value, limits, state) for each in limits.intervals)


def limit_value(limit: Limit, limits: Range, state: Present) -> Fraction | None:
    """Return the number that a limit is now; None if the map leaves it open."""
    if isinstance(limit, Number):
        return Fraction(limit) / state.power(limits.decimals)
    return state.lookup(limit.register) if isinstance(limit, Ref) else None


def _within(interval: Interval, value: Fraction, limits: Range, state: Present) -> bool:
    low = limit_value(interval.low, limits, state)
    high = limit_value(interval.high, limits, state)
    return (low is None or low <= value) and (high is None or value <= high)


def _is_member(enum: Enum, value: Fraction) -> bool:
    return any(member.code == value for member in enum.members)
