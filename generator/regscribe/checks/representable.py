"""Whether views can carry a number under the scales that a register may have: exactly, less finely, or not at all."""

from collections.abc import Iterable, Iterator
from enum import IntEnum
from fractions import Fraction

from regscribe.model import Number, Range, Register, Special, View, show
from regscribe.reference import ieee_bits, ieee_number, shortest
from regscribe.reference.settled_scales import Form, factors, forms, widest
from regscribe_runtime.values.numbers import rough

HELP_TYPE = "correct the number, the type or the scale"


class Fit(IntEnum):
    """Whether words can spell a number, best first: exactly, with less resolution, not at all."""

    EXACT = 0
    TOO_FINE = 1
    TOO_LARGE = 2


def fit(form: Form, view: View, value: Fraction) -> Fit:
    """Whether one view can carry one value of use under one conversion."""
    stored = form.stored(value)
    wire = stored if view.factor == 1 else stored * view.factor
    lowest, highest = view.type.minimum + view.saturates, view.type.maximum - view.saturates
    fits = (
        lowest * wire.denominator <= wire.numerator <= highest * wire.denominator
        if view.type.is_integer
        else _spelled(view, wire) is not None
    )
    if not fits:
        return Fit.TOO_LARGE
    if form.too_fine(stored) or (view.type.is_integer and wire.denominator != 1):
        return Fit.TOO_FINE
    return Fit.EXACT


def _spelled(view: View, wire: Fraction) -> tuple[Fraction, Fraction] | None:
    """The numbers that the words of a float nearest to `wire` stand for: exactly, and in the fewest digits."""
    bits = ieee_bits(wire, view.type) if view.type.is_float else None  # no number in a text
    return None if bits is None else ((exactly := ieee_number(bits, view.type)), shortest(exactly, view.type))


def tells_apart(register: Register, value: Fraction) -> bool:
    """Whether words of some view spell `value` and nothing beside it; whole numbers do wherever they fit."""
    every = forms(register)
    return not every or any(
        view.type.is_integer
        or form.stored(value) * view.factor in (_spelled(view, form.stored(value) * view.factor) or ())
        for form in every
        for view in register.views
    )


def best_fit(register: Register, values: tuple[Fraction, ...], every: tuple[Form, ...] | None = None) -> Fit:
    """The best fit of any of `values` in any view under any conversion; EXACT where nothing can be inverted.

    `every` are the register's forms, for a caller with more than one question.
    """
    found = Fit.TOO_LARGE
    every = forms(register) if every is None else every
    for form in every:
        for view in register.views:
            for value in values:
                now = fit(form, view, value)
                if now is Fit.EXACT:
                    return now
                found = min(found, now)
    return found if every else Fit.EXACT


def end_values(limits: Range, number: Number) -> tuple[Fraction, ...]:
    """Every value that a printed limit can mean: the range's decimals divide it."""
    return tuple(number / factor for factor in factors(limits.decimals)) if limits.decimals else (Fraction(number),)


def unfit_limits(register: Register, limits: Range, fit: Fit, every: tuple[Form, ...]) -> list[Fraction]:
    """The numeric limits of a range, as printed, whose best fit is `fit`; `every` are the register's forms."""
    return [one for one in numbers(limits) if best_fit(register, end_values(limits, one), every) is fit]


def values_of(register: Register, special: Special) -> tuple[Fraction, ...]:
    """Every value of use that the code of a special value can be: the range's decimals divide it too."""
    return tuple(special.code / factor for case in register.special_scale for factor in factors(case.then.decimals))


def is_meant(register: Register, value: Fraction) -> bool:
    """Whether a special value stands for a number, which no words need to spell then."""
    return any(special.means == value for special in register.specials)


def numbers(limits: Range) -> Iterator[Fraction]:
    """The limits that are numbers, as printed."""
    for interval in limits.intervals:
        yield from (Fraction(limit) for limit in (interval.low, interval.high) if isinstance(limit, Number))


def ends_of(register: Register) -> str:
    """The types of a register for messages: `int16 (-32768 to 32767)`."""
    types = dict.fromkeys(view.type for view in register.views)
    return ", ".join(f"{one} ({' to '.join(map(show, one.ends))})" if one.is_integer else str(one) for one in types)


def reach_of(register: Register) -> str:
    """As `ends_of`, with the values of use that these stand for: `uint8 (0 to 255), which stand for 0 to 25.5`."""
    reach, types = widest(register), ends_of(register)
    ends = " to ".join(map(rough, reach)) if reach else ""
    return types if not ends or f"({ends})" in types else f"{types}, which stand for {ends}"


def same_bits(register: Register, values: Iterable[Fraction | int]) -> str:
    """What to write for numbers that are printed as the bits of a signed type (0x8000 is -32768); empty for others."""
    found = dict[str, str]()
    for view in register.views:
        width = view.type.maximum + 1
        if view.type.is_integer and not view.type.fraction and view.type.minimum == -width:
            signed = ((value, value - 2 * width) for value in values if width <= value < 2 * width)
            found |= {show(each): f"{show(negative)} for {show(each)}" for each, negative in signed}
    types = ", ".join(dict.fromkeys(view.type for view in register.views))
    return f"write {', '.join(found.values())}: the same bits as {types}" if found else ""


def listed(values: list[Fraction]) -> str:
    """Numbers for a message."""
    return ", ".join(show(value) for value in values)
