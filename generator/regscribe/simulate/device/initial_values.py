"""The value that a register holds when the device is new."""

from fractions import Fraction

from regscribe.model import BOTTOM, Identity, Is, Register
from regscribe.reference import existing_members, number_of
from regscribe.simulate.device.present_meaning import PresentMeaning
from regscribe.simulate.device.value_arguments import with_field
from regscribe_runtime.values.kinds import OCTETS


def initial_value(register: Register, state: PresentMeaning) -> Fraction | str:
    """Return the value of use that `register` begins with.

    In this order: what identifies the model (so that an identification finds it), what the map says it is delivered
    with, the map's default, 0 if the register accepts it, its first enum member, its first low limit that is known, 0.
    """
    rules = state.blueprint.register_map.identity
    identities = [each.identity for each in rules if state.blueprint.model.name in each.models]
    if register.kind in OCTETS:
        return _initial_text(register, identities, state)
    tests = _identity_tests(register, identities)
    if tests:
        return _identifying(register, tests, state)
    stated = state.delivered(register)
    if stated is not None:
        special = (
            state.special(register, each) for each in register.specials if each.means is None and each.code == stated
        )
        return next(special, stated)
    return _first_accepted(register, state)


def _first_accepted(register: Register, state: PresentMeaning) -> Fraction:
    if state.accepts(register, Fraction(0)):
        return Fraction(0)
    if register.enum is not None and register.enum.members:
        return Fraction((existing_members(register, state) or register.enum.members)[0].code)
    lows = [low for low, _ in (*(state.limits(register) or ()), *state.valid(register)) if low is not None]
    return next((low for low in lows if state.accepts(register, low)), (lows or [Fraction(0)])[0])


def _initial_text(register: Register, identities: list[Identity], state: PresentMeaning) -> str:
    shown = [text for identity in identities for path, text in identity.texts if path == register.path]
    return next(
        (text for text in (*shown, state.delivered(register), state.default(register)) if isinstance(text, str)), ""
    )


def _identity_tests(register: Register, identities: list[Identity]) -> list[Is]:
    tests = [test for identity in identities[:1] for test in identity.when.leaves if test.register == register.path]
    return [test for test in tests if test.codes and not test.negated]


def _identifying(register: Register, tests: list[Is], state: PresentMeaning) -> Fraction:
    """The default, with every test on the register or on one of its fields made true."""
    default = state.default(register)
    value = number_of(register, default) or Fraction(0)
    for test in tests:
        low, high = test.codes[0]
        code = Fraction(high if low == BOTTOM else low)
        field = next((each for each in register.fields if each.id == test.field), None)
        if field is not None:
            value = with_field(value, field, code)
        elif default is None or not test.lists(value):
            value = code
    return value
