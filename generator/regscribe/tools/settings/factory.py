"""The values that the manual gives as defaults, as if a device had been saved with them."""

from fractions import Fraction
from typing import Any

from regscribe.tools.live.names import Driver
from regscribe.tools.live.reading import unit_needs, unit_of
from regscribe.tools.live.value_text import is_number, show
from regscribe.tools.settings.backup import Saved
from regscribe.tools.settings.take import writable
from regscribe_runtime import Register
from regscribe_runtime.values.numbers import exact

TEXTS = frozenset({"string", "version"})


def factory(driver: Driver) -> dict[str, Saved]:
    """The settings of a model by path, where its manual gives a default."""
    values = {one.path: default_of(one) for one in writable(driver) if one.default is not None}
    return {path: _saved(driver.registers[path], value, values) for path, value in values.items()}


def default_of(register: Register[Any]) -> Any:  # noqa: ANN401 (a value of any register)
    """The default as a driver would read it: a member of the enum, a special value, a number, a text."""
    value_type, default = register.value_type, register.default
    if register.kind in TEXTS or default is None:
        return default
    if value_type.coded:
        return value_type.make(int(default))
    number = Fraction(default) if isinstance(default, str) else exact(default)
    for member in value_type.special or ():
        if exact(member.value) == number:
            return member
    return value_type.make(number)


def _saved(register: Register[Any], value: Any, state: dict[str, Any]) -> Saved:  # noqa: ANN401 (as above)
    plain = show(register, value)
    known = set(unit_needs(register)) <= set(state)
    unit = unit_of(register, state, {}) if known and is_number(plain) else ""
    return Saved(value=plain, unit=unit, stays=register.stays)
