"""Interpretation of stored numbers in the present state: scales, decimals, word orders, conditions, limits."""

from abc import ABC, abstractmethod
from contextlib import suppress
from fractions import Fraction

from regscribe.model import (
    IDENTITY,
    BitField,
    Conversion,
    Decimals,
    Enum,
    Kind,
    Model,
    Register,
    Rounding,
    Special,
    View,
    orders_of,
)
from regscribe.reference import (
    MOST_DECIMALS,
    Arrangement,
    Straight,
    choose,
    divided_limits,
    existing_members,
    is_valid,
    part_value,
    present_view,
    round_by,
    straight,
    within,
    word_order,
)
from regscribe.reference.limits import Limits
from regscribe.simulate.device.device_plan import Blueprint, Stored
from regscribe.simulate.device.value_arguments import field_value
from regscribe.simulate.errors import SimulatorError


class PresentMeaning(ABC):
    """Interprets stored numbers under the present values of a device; a subclass says which value is in effect."""

    __slots__ = ("_model", "blueprint", "codes", "facts", "numbers")

    def __init__(self, blueprint: Blueprint) -> None:
        self.blueprint = blueprint
        self.codes = blueprint.givens.codes
        self.facts = blueprint.givens.facts
        self.numbers = blueprint.givens.numbers
        self._model: Model = blueprint.model

    @abstractmethod
    def in_effect(self, path: str) -> Stored:
        """Return the stored value of a register that counts now."""

    def register(self, path: str) -> Register:
        """Return a register of the model by its path; KeyError if there is none."""
        return self._model.register(path)

    def find(self, path: str) -> tuple[Register, BitField | None]:
        """Return the register of a path, and the bit field if it names one; SimulatorError if there is neither."""
        try:
            return self._model.register(path), None
        except KeyError:
            owner, _, name = path.rpartition(".")
        with suppress(KeyError, StopIteration):
            register = self._model.register(owner)
            return register, next(field for field in register.fields if field.id == name)
        message = f"model {self._model.name} has no register or field {path!r}"
        raise SimulatorError(message)

    def look_up(self, subject: str) -> Fraction:
        """Return the present number of a register, or of `register.field`, as conditions and limits count it.

        That is the value in effect, which need not be the one that the register shows.
        """
        register, field = self.find(subject)
        stored = self.in_effect(register.path)
        if not isinstance(stored, Fraction):
            return Fraction(0)
        return self.number(register, stored) if field is None else field_value(stored, field)

    def read(self, subject: str) -> str:
        """Return the present text of a register, or of a choice that is given."""
        if subject in self.blueprint.givens.texts:
            return self.blueprint.givens.texts[subject]
        return str(self.in_effect(self.register(subject).path))

    def number(self, register: Register, stored: Fraction) -> Fraction:
        """Return the value of use of a stored number: 0 or 1 of a boolean, of a special value what it stands for."""
        value = self.to_value(register, stored)
        if register.kind is Kind.BOOLEAN:
            return Fraction(value != 0)
        meant = (each.means for each in register.specials if self.special(register, each) == value)
        return next((number for number in meant if number is not None), value)

    def special(self, register: Register, special: Special) -> Fraction:
        """Return the value of use of a special value's code: where decimals divide the range, they divide it too."""
        scale = choose(register.special_scale, self) or IDENTITY
        return special.code / self.power(scale.decimals)

    def source(self, register: Register) -> str:
        """Return the path of the register that this one follows now; empty if it follows none."""
        return choose(register.follows, self) or ""

    def to_value(self, register: Register, stored: Fraction) -> Fraction:
        """Turn a stored number into the value of use."""
        return self.line(register).value(stored)

    def usable(self, register: Register, stored: Stored) -> Stored:
        """Turn a stored number into the value of use; a text or NaN stays as it is (so that `put` takes it)."""
        return self.to_value(register, stored) if isinstance(stored, Fraction) else stored

    def from_value(self, register: Register, value: Fraction) -> Fraction:
        """Turn a value of use into a stored number (exact: as finely as asked, whatever the device can hold)."""
        return self.line(register).stored(value)

    def default(self, register: Register) -> Fraction | str | None:
        """Return the default that counts now; None where the map gives none."""
        return register.default if register.default is not None else choose(register.default_cases, self)

    def delivered(self, register: Register) -> Fraction | str | None:
        """Return what a new device holds, the default where the map gives nothing else; None without either."""
        stated = register.delivered if register.delivered is not None else choose(register.delivered_cases, self)
        return self.default(register) if stated is None else stated

    def line(self, register: Register) -> Straight:
        """Return the scale as things stand; the identity where one of its numbers has no value."""
        scale = self.conversion(register)
        slope, offset = straight(scale._replace(decimals=None), self) or (Fraction(1), Fraction(0))
        power = self.power(scale.decimals)
        return Straight(slope / power, offset / power)

    def conversion(self, register: Register) -> Conversion:
        """Return the scale that holds now; identity if none holds."""
        return choose(register.scale, self) or IDENTITY

    def power(self, decimals: Decimals | None) -> Fraction:
        """Return 10 to the number of decimals that a register holds now, clipped to 0 to 9 and to `at_most`."""
        if decimals is None:
            return Fraction(1)
        digits = min(max(0, int(self.look_up(decimals.register))), MOST_DECIMALS)
        return Fraction(10 ** (digits if decimals.at_most is None else min(digits, decimals.at_most)))

    def order(self, view: View) -> Arrangement:
        """Return the orders of `view` now; where a register sets one to a code without meaning, the map's first."""
        return word_order(view, self) or Arrangement(orders_of(view.order)[0], orders_of(view.byte_order)[0])

    def seen(self, view: View) -> View:
        """Return a view with the factor that it has now; where that is no number above 0, without it."""
        return present_view(view, self) or view._replace(times=None)

    def quantise(self, register: Register, stored: Fraction) -> Fraction:
        """Round `stored` to the resolution of the device: the scale's step, else that of its finest view."""
        conversion = self.conversion(register)
        step = None if conversion.places else conversion.step
        if step is None:
            if any(view.type.is_float for view in register.views):
                return stored
            step = 1 / Fraction(max(self.seen(view).factor for view in register.views))
        return _on_step(register, stored, Fraction(step))

    def kept(self, register: Register, stored: Fraction) -> Fraction:
        """Round a written or measured number to the resolution that the device keeps under its present configuration.

        What it holds already stays when a register that says how many decimals it keeps changes.
        """
        conversion = self.conversion(register)
        if conversion.places is None or conversion.step is None:
            return self.quantise(register, stored)
        return _on_step(register, stored, Fraction(conversion.step) / self.power(conversion.places))

    def accepts(self, register: Register, value: Fraction) -> bool:
        """Tell whether the device takes `value` (a value of use) for `register` now.

        Limits that the map leaves open are not checked, nor is anything where no case of the range holds.
        """
        if register.kind is Kind.BOOLEAN and value not in (0, 1):
            return False
        if register.enum and all(member.code != value for member in existing_members(register, self)):
            return False
        if not all(_is_member(field.enum, field_value(value, field)) for field in register.fields if field.enum):
            return False
        if not all(_in_part(field, int(value)) for field in register.fields if field.range or field.valid):
            return False
        if any(self.special(register, special) == value for special in register.specials):
            return True
        limits = self.limits(register)
        return (limits is None or within(limits, value)) and is_valid(register, value, self)

    def limits(self, register: Register) -> Limits | None:
        """Return the limits that hold now; None if no case of the range holds."""
        found = choose(register.range, self)
        return None if found is None else divided_limits(found, self.power(found.decimals), self)

    def valid(self, register: Register) -> Limits:
        """Return what is valid now; nothing where everything is."""
        found = choose(register.valid, self)
        return () if found is None else divided_limits(found, self.power(found.decimals), self)


def _in_part(field: BitField, word: int) -> bool:
    value, limits = part_value(field, word), field.range
    if not isinstance(value, Fraction):
        return True
    return (limits is None or limits[0] <= value <= limits[1]) and field.reads(value)


def _is_member(enum: Enum | None, value: Fraction) -> bool:
    return enum is None or any(member.code == value for member in enum.members)


def _on_step(register: Register, stored: Fraction, step: Fraction) -> Fraction:
    rounding = next((view.rounding for view in register.views if view.rounding is not Rounding.NONE), Rounding.NONE)
    return round_by(rounding, stored / step) * step
