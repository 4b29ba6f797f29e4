"""What a register holds when the device is new."""

from fractions import Fraction

from regscribe.model import Is, Kind, Model, Register, RegisterMap
from regscribe.reference import number_of
from regscribe.simulate.device.accepted_values import accepts, limits_now
from regscribe.simulate.device.present_meaning import PresentMeaning
from regscribe.simulate.device.value_arguments import with_field


def initial_value(register_map: RegisterMap, model: Model, register: Register, state: PresentMeaning) -> Fraction | str:
    """Return the value of use that `register` begins with.

    In this order: what tells the model (so that an identification finds it), what the map says it is delivered with,
    the map's default, 0 if the register accepts it, its first enum member, its first low limit that is known, 0.
    """
    if register.kind is Kind.STRING:
        return _initial_text(register_map, model, register)
    tests = _identifying_tests(register_map, model, register)
    if tests:
        return _identifying(register, tests)
    stated = register.default if register.delivered is None else register.delivered
    if stated is not None:
        special = next((each for each in register.specials if each.means is None and each.code == stated), None)
        return state.special(register, special) if special else stated
    return Fraction(0) if accepts(register, Fraction(0), state) else _first_accepted(register, state)


def _first_accepted(register: Register, state: PresentMeaning) -> Fraction:
    if register.enum is not None and register.enum.members:
        return Fraction(register.enum.members[0].code)
    return next((low for low, _ in limits_now(register, state) or () if low is not None), Fraction(0))


def _initial_text(register_map: RegisterMap, model: Model, register: Register) -> str:
    mine = [each for each in register_map.identity if model.name in each.models]
    shown = [text for each in mine for path, text in each.identity.texts if path == register.path]
    return next((text for text in (*shown, register.delivered, register.default) if isinstance(text, str)), "")


def _identifying_tests(register_map: RegisterMap, model: Model, register: Register) -> tuple[Is, ...]:
    identity = next((each for each in register_map.identity if model.name in each.models), None)
    tests = identity.identity.when.tests if identity else ()
    return tuple(test for test in tests if test.register == register.path and test.codes and not test.negated)


def _identifying(register: Register, tests: tuple[Is, ...]) -> Fraction:
    value = number_of(register, register.default) or Fraction(0)
    for test in tests:
        code = Fraction(test.codes[0][0])
        field = next((each for each in register.fields if each.id == test.field), None)
        if field is not None:
            value = with_field(value, field, code)
        elif register.default is None or not test.lists(value):
            value = code
    return value
