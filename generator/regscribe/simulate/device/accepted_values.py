"""Which values a register accepts: enum members, special values, ranges by condition, limits that are registers."""

from fractions import Fraction

from regscribe.model import Enum, Kind, Register
from regscribe.reference import choose, divided_limits, within
from regscribe.reference.surroundings import Limits
from regscribe.simulate.device.present_meaning import PresentMeaning
from regscribe.simulate.device.value_arguments import field_value


def accepts(register: Register, value: Fraction, state: PresentMeaning) -> bool:
    """Tell whether the device takes `value` (a value of use) for `register`, given the state of the others.

    Limits that the map leaves open are not checked, nor is anything where no case of the range holds.
    """
    if register.kind is Kind.BOOLEAN and value not in (0, 1):
        return False
    if not _is_member(register.enum, value):
        return False
    if not all(_is_member(field.enum, field_value(value, field)) for field in register.fields if field.enum):
        return False
    if any(state.special(register, special) == value for special in register.specials):
        return True
    limits = limits_now(register, state)
    return limits is None or within(limits, value)


def limits_now(register: Register, state: PresentMeaning) -> Limits | None:
    """Return the limits that count now; None if no case of the range holds."""
    found = choose(register.range, state)
    return None if found is None else divided_limits(found, state.power(found.decimals), state)


def _is_member(enum: Enum | None, value: Fraction) -> bool:
    return enum is None or any(member.code == value for member in enum.members)
