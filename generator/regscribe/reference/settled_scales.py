"""Conversions that a register may have, one for each number of decimals, and the range of its values."""

from fractions import Fraction
from functools import cache
from typing import NamedTuple

from regscribe.model import IDENTITY, Conversion, Decimals, Number, Register

MOST_DECIMALS = 4
"""Decimals tried where a register holds their number and the map does not limit it (16 bits have five digits)."""


@cache
def factors(decimals: Decimals | None) -> tuple[Fraction, ...]:
    """Every factor that a decimals register can mean: 1, 10, 100 ..."""
    if decimals is None:
        return (Fraction(1),)
    most = MOST_DECIMALS if decimals.at_most is None else decimals.at_most
    return tuple(Fraction(10) ** digits for digits in range(most + 1))


_ZERO = Fraction(0)


class Form(NamedTuple):
    """One conversion with the decimals settled: stored = value of use x `gain` - `offset`."""

    conversion: Conversion
    factor: Fraction
    gain: Fraction
    offset: Fraction

    @classmethod
    def of(cls, conversion: Conversion, factor: Fraction) -> "Form":
        """Return the form of a conversion, with the divisions done once for all values."""
        multiply, add = conversion.multiply, conversion.add
        if not (isinstance(multiply, Number) and isinstance(add, Number)):
            message = f"{conversion} is not settled"
            raise TypeError(message)
        gain = factor if multiply == 1 else factor / multiply
        return cls(conversion, factor, gain, add / Fraction(multiply) if add else _ZERO)

    def stored(self, value: Fraction) -> Fraction:
        """The stored number of a value of use."""
        scaled = value if self.gain == 1 else value * self.gain
        return scaled - self.offset if self.offset else scaled

    def used(self, stored: Fraction | int) -> Fraction:
        """The value of use of a stored number."""
        number = stored + self.offset if self.offset else stored
        return Fraction(number) if self.gain == 1 else number / self.gain

    def too_fine(self, stored: Fraction) -> bool:
        """Whether a stored number lies between two steps, whatever a register says of them."""
        step = self.conversion.step
        return step is not None and bool(stored % (step / factors(self.conversion.places)[-1]))


PLAIN = (Form.of(IDENTITY, Fraction(1)),)


def forms(register: Register) -> tuple[Form, ...]:
    """All conversions of a register that can be inverted; none where the device or its user sets a number of one."""
    if any(view.times is not None for view in register.views):
        return ()
    if len(register.scale) == 1 and (register.scale[0].then is IDENTITY or register.scale[0].then == IDENTITY):
        return PLAIN
    if any(not isinstance(one, Number) for case in register.scale for one in (case.then.multiply, case.then.add)):
        return ()
    return tuple(
        Form.of(case.then, factor)
        for case in register.scale
        if case.then.multiply
        for factor in factors(case.then.decimals)
    )


def widest(register: Register) -> tuple[Fraction, Fraction] | None:
    """The lowest and the highest value of use of all integer views and conversions; None if a float has no such end."""
    every = forms(register)
    if not every or not all(view.type.is_integer for view in register.views):
        return None
    ends = [
        form.used(wire if view.factor == 1 else Fraction(wire) / view.factor)
        for form in every
        for view in register.views
        if view.factor
        for wire in (view.type.minimum, view.type.maximum)
    ]
    return (min(ends), max(ends)) if ends else None
