"""Scales, limits, and stored numbers that report faults."""

from enum import Enum
from functools import cache
from typing import NamedTuple

from regscribe_runtime.values.conditions import ALWAYS, Cases, Condition, Givens, State, always
from regscribe_runtime.values.numbers import Number, show
from regscribe_runtime.values.terms import Term


class Decimals(NamedTuple):
    """A register that holds the number of decimals: the divisor is 10 to its power, of `at_most` at most."""

    register: str
    at_most: int | None = None


class Conversion(NamedTuple):
    """value = (`multiply` x stored + `add`) / 10^d, d from `decimals` (0 without); exact.

    `multiply` and `add` are numbers or terms that the device or its user sets. `step` is the smallest increment of the
    *stored* value, if the device has one (1: it stores whole digits). With `places`, a register says how many decimals
    that value can have: the increment is `step` / 10^d of it.
    """

    multiply: Term = 1
    add: Term = 0
    decimals: Decimals | None = None
    step: Number | None = None
    places: Decimals | None = None


IDENTITY = Conversion()
SAME: Cases[Conversion] = always(IDENTITY)


class Open(str):
    """A limit that the manual names, in these words, without a number: nothing is checked against it."""

    __slots__ = ()


Limit = Term | Open


class Interval(NamedTuple):
    """From `low` to `high`, both included."""

    low: Limit
    high: Limit


class Range(NamedTuple):
    """A union of intervals; limits that are plain numbers are divided by 10^d of `decimals`, if there is one."""

    intervals: tuple[Interval, ...]
    decimals: Decimals | None = None


@cache
def within(low: Limit, high: Limit) -> Cases[Range]:
    """The range of one interval, without a condition."""
    return always(Range((Interval(low, high),)))


class NotANumber(Enum):
    """Any IEEE 754 pattern that is no number, sent in place of a value; unequal to every text."""

    NAN = "nan"


NAN = NotANumber.NAN


class Sentinel(NamedTuple):
    """A stored number that is a fault and no value: -32768 = sensor low; `NAN`: no number at all.

    It counts before any scale, and whatever the kind of the register: for bits, as the number that the type spells.
    With `high`, every number from `stored` to there is the fault. `when` is the case in which it is one: of all cases
    of a register the first whose condition holds counts.
    """

    stored: Number | NotANumber
    id: str
    label: str
    high: Number | None = None
    when: Condition = ALWAYS

    @property
    def spelled(self) -> str:
        """The stored number as decimal text, as `low..high`, or `nan`."""
        if isinstance(self.stored, NotANumber):
            return self.stored.value
        return show(self.stored) if self.high is None else f"{show(self.stored)}..{show(self.high)}"

    @property
    def ends(self) -> tuple[Number, Number] | None:
        """The lowest and the highest stored number; None for what is no number."""
        if isinstance(self.stored, NotANumber):
            return None
        return self.stored, self.stored if self.high is None else self.high

    def reports(self, stored: object) -> bool:
        """Whether a stored number is the fault, in its case."""
        if self.ends is None or not isinstance(stored, Number):
            return self.stored is stored
        return self.ends[0] <= stored <= self.ends[1]


def in_case(sentinels: tuple[Sentinel, ...], state: State, givens: Givens) -> tuple[Sentinel, ...]:
    """The sentinels of the first case whose condition holds."""
    when = next((each.when for each in sentinels if each.when.holds(state, givens)), None)
    return tuple(each for each in sentinels if each.when == when)
