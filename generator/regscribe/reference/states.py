"""Representative states of a device: the domain of a register, values that stand for all, and their combinations."""

from collections.abc import Hashable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import groupby, product
from typing import NamedTuple, TypeVar

from regscribe.model import Enum, Given, Kind, Limit, Number, Register
from regscribe.reference.settled_scales import forms, widest

K = TypeVar("K", bound=Hashable)
V = TypeVar("V")


class Stretch(NamedTuple):
    """Values from `low` to `high`, both included."""

    low: Fraction
    high: Fraction

    def holds(self, value: Fraction) -> bool:
        """Tell whether `value` lies inside."""
        return self.low <= value <= self.high

    def common(self, other: "Stretch") -> "Stretch | None":
        """Return the values that lie in both; None if there are none."""
        low, high = max(self.low, other.low), min(self.high, other.high)
        return Stretch(low, high) if low <= high else None


MOST_LISTED = 32
"""A domain of up to as many whole numbers is taken as the list of its values."""

ANYTHING = (Stretch(Fraction(-(10**30)), Fraction(10**30)),)
"""Domain of floats and texts: no end that matters."""


def domain(register: Register, field: str = "") -> tuple[Stretch, ...]:
    """The values of use that the map allows for: members and invalid codes of an enum, the range and special values."""
    if field:
        return next((_of_bits(bits.enum, bits.width) for bits in register.fields if bits.id == field), ANYTHING)
    if register.kind is Kind.BOOLEAN:
        return (Stretch(Fraction(0), Fraction(1)),)
    if register.enum is not None or register.kind in {Kind.FLAGS, Kind.FIELDS}:
        return _of_bits(register.enum, register.bits)
    if register.base.type.is_octets:
        return ANYTHING
    return _without_faults(register, _of_number(register))


def domain_of_given(given: Given) -> tuple[Stretch, ...]:
    """Return the numbers that may be given."""
    low, high = ANYTHING[0]
    return (Stretch(low if given.low is None else given.low, high if given.high is None else given.high),)


def _of_bits(enum: Enum | None, width: int) -> tuple[Stretch, ...]:
    if enum is None:
        return (Stretch(Fraction(0), Fraction((1 << width) - 1)),)
    codes = sorted({member.code for member in enum.members} | {code for code, _ in enum.invalid})
    return tuple(Stretch(Fraction(code), Fraction(code)) for code in codes)


def _of_number(register: Register) -> tuple[Stretch, ...]:
    low, high = widest(register) or ANYTHING[0]
    stretches = [Stretch(low, high)]
    for cases in (register.range, register.valid):
        intervals = [interval for case in cases for interval in case.then.intervals]
        if intervals and not any(case.then.decimals for case in cases):
            limits = [Stretch(_end(interval.low, low), _end(interval.high, high)) for interval in intervals]
            stretches = [both for one in stretches for other in limits if (both := one.common(other))]
    specials = register.specials if register.range or register.valid else ()
    return (*stretches, *(Stretch(special.value, special.value) for special in specials))


def _end(limit: Limit, otherwise: Fraction) -> Fraction:
    return Fraction(limit if isinstance(limit, Number) else otherwise)


def _without_faults(register: Register, stretches: tuple[Stretch, ...]) -> tuple[Stretch, ...]:
    """Cut out the stored numbers that report faults, where each has one value: a device in use never holds them."""
    every = forms(register) if register.faults else ()
    if len(every) != 1 or any(view.factor != 1 or view.times or view.type.is_float for view in register.views):
        return stretches
    step = 1 / abs(every[0].gain)
    for low, high in filter(None, (sentinel.ends for sentinel in register.sentinels)):
        first, last = sorted((every[0].used(Fraction(low)), every[0].used(Fraction(high))))
        stretches = tuple(part for stretch in stretches for part in _cut(stretch, first, last, step))
    return stretches


def _cut(stretch: Stretch, low: Fraction, high: Fraction, step: Fraction) -> Iterator[Stretch]:
    """Yield what is left of a stretch without the values from `low` to `high` in it."""
    if stretch.common(Stretch(low, high)) is None:
        yield stretch
        return
    sides = (Stretch(stretch.low, low - step), Stretch(high + step, stretch.high))
    yield from (side for side in sides if side.low <= side.high)


def listed(stretches: Sequence[Stretch]) -> tuple[Fraction, ...]:
    """Return every value of a domain in order, if it is a few whole numbers; nothing if they are too many to list."""
    if any(end.denominator != 1 for stretch in stretches for end in (stretch.low, stretch.high)):
        return ()
    if sum(stretch.high - stretch.low + 1 for stretch in stretches) > MOST_LISTED:
        return ()
    return tuple(sorted({Fraction(code) for one in stretches for code in range(int(one.low), int(one.high) + 1)}))


def representatives(stretches: Sequence[Stretch], codes: Sequence[tuple[Number, Number]]) -> tuple[Fraction, ...]:
    """Return values of a domain that stand for all: the ends of each run of values that lie in the same of `codes`."""
    marks = [Stretch(Fraction(low), Fraction(high)) for low, high in dict.fromkeys(codes)]
    runs = groupby(_values(stretches, marks), lambda value: [one.holds(value) for one in marks])
    values = (list(run) for _, run in runs)
    return tuple(dict.fromkeys(end for run in values for end in (run[0], run[-1])))


def _values(stretches: Sequence[Stretch], marks: Sequence[Stretch]) -> list[Fraction]:
    """Return the values of a domain that may begin or end a run, in order."""
    ends = {end for one in stretches for end in (one.low, one.high)}
    ends |= {near for one in marks for near in (one.low - 1, one.low, one.high, one.high + 1)}
    return sorted({*listed(stretches), *(end for end in ends if any(one.holds(end) for one in stretches))})


def combinations(choices: Mapping[K, Sequence[V]]) -> Iterator[dict[K, V]]:
    """Yield every combination of one value of each choice, those of the last one first."""
    for values in product(*choices.values()):
        yield dict(zip(choices, values, strict=True))
