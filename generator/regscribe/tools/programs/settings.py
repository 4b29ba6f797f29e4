"""Values of registers as settings of a program, and settings as values: units of time converted, others compared."""

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any

from regscribe.tools.live import value_text
from regscribe.tools.live.reading import unit_needs, unit_of
from regscribe.tools.programs.program import RAW, SECONDS, Amount, Setting
from regscribe_runtime import Register, ValueRefused
from regscribe_runtime.values.conditions import Givens


def needs(register: Register[Any]) -> set[str]:
    """The registers that decide the unit, the scale and the limits of a register."""
    return {*unit_needs(register), *register.needs(register.read_view()), *register.limit_needs}


@dataclass(frozen=True, slots=True)
class SettingConverter:
    """Converts settings and values on a device as it is configured: `state` has the registers that decide."""

    state: Mapping[str, Any]
    givens: Givens
    time_unit: str = ""

    def unit(self, register: Register[Any], *, time: bool = False) -> str:
        """The unit in which a register is given."""
        if register.kind == "raw":
            return RAW
        return (self.time_unit if time else "") or unit_of(register, self.state, self.givens)

    def setting(self, register: Register[Any], value: Any, *, time: bool = False) -> Setting:  # noqa: ANN401 - a value of any register
        """A value of use as a setting; no time is 0, also where the device calls it by a name."""
        if time and int(value) == 0:
            return Amount(Decimal(0), self.unit(register, time=True))
        shown = value_text.show(register, value)
        if isinstance(shown, bool) or not isinstance(shown, int | float):
            return str(shown).lower() if isinstance(shown, bool) else str(shown)
        number = int(shown) if shown == int(shown) else shown
        return Amount(Decimal(repr(number)), self.unit(register, time=time))

    def value(self, register: Register[Any], setting: Setting, *, time: bool = False) -> Any:  # noqa: ANN401 - as above
        """The value of use of a setting; ValueRefused for another unit, or a name that the register does not have."""
        if isinstance(setting, str):
            return value_text.parse(register, setting)
        unit = self.unit(register, time=time)
        if register.kind == "raw":
            _check_raw(register, setting, self.time_unit if time else "")
            return value_text.parse(register, str(setting.number))
        if setting.unit == RAW:
            message = f"`{setting}`: the scale is known here: write it in {unit or 'the plain number'}"
            raise ValueRefused(register.path, message)
        if time:
            return value_text.parse(register, _converted(register, setting, unit))
        return value_text.parse(register, str(setting), current_unit=unit)


def _check_raw(register: Register[Any], setting: Amount, unit: str) -> None:
    if setting.unit != RAW and setting.number:  # nought is nought at any scale
        counted = f" (the device counts in {unit})" if unit else ""
        message = (
            f"`{setting}`: the manual does not state the decimals of this number, so it is given as the register "
            f"holds it{counted}: write `{str(setting).split()[0]} raw` if that is what the register is to hold"
        )
        raise ValueRefused(register.path, message)


def _converted(register: Register[Any], setting: Amount, unit: str) -> str:
    """The number of a time in the unit of the device."""
    if setting.unit not in SECONDS:
        fault = f"{setting.unit} is no unit of time" if setting.unit else "the number has no unit"
        message = f"`{setting}`: {fault}: write {', '.join(SECONDS)} behind it, as in `30 {unit}`"
        raise ValueRefused(register.path, message)
    number = Fraction(setting.number) * Fraction(SECONDS[setting.unit]) / Fraction(SECONDS[unit])
    decimals = Decimal(number.numerator) / Decimal(number.denominator)
    if Fraction(decimals) != number or (register.kind == "integer" and number.denominator != 1):
        message = f"`{setting}`: the device counts whole {unit}, and this is {float(number):.6g} {unit}"
        raise ValueRefused(register.path, message)
    return f"{decimals:f}"
