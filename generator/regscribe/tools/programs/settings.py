"""Values of registers as settings of a program, and settings as values: units of time converted, others compared."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any

from regscribe.tools.live import value_text
from regscribe.tools.live.reading import unit_needs, unit_of
from regscribe.tools.programs.program import RAW, SECONDS, Amount, Setting
from regscribe.tools.programs.slot import ProgramSlot
from regscribe_runtime import Register, Snapshot, ValueRefused
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.values.conditions import Givens

NO_UNIT = "the number has no unit"


def needs(register: Register[Any]) -> set[str]:
    """The registers that decide the unit, the scale and the limits of a register."""
    return {*unit_needs(register), *register.needs(register.read_view()), *register.limit_needs}


def read_with_needs(registers: Iterable[Register[Any]]) -> Task[Snapshot]:
    """Read registers, and with them those that decide their units, scales and limits."""

    def task(session: Session) -> Operation[Snapshot]:
        own = {one.path: one for one in registers}
        paths = sorted({path for one in own.values() for path in needs(one)})
        wanted = {path: session.registers[path] for path in paths} | own
        return (yield from tasks.read_many(list(wanted.values()))(session))

    return task


@dataclass(frozen=True, slots=True)
class SettingConverter:
    """What the settings of a program mean on a device as it is configured: `state` has the registers that decide."""

    place: ProgramSlot
    state: Mapping[str, Any]
    givens: Givens
    time_unit: str = ""

    def unit(self, register: Register[Any], *, time: bool = False) -> str:
        """The unit in which a register is given."""
        if register.kind == "raw":
            return RAW
        return (self.time_unit if time else "") or unit_of(register, self.state, self.givens)

    def setting(self, register: Register[Any], value: Any, *, time: bool = False) -> Setting:  # noqa: ANN401 - a value of any register
        """A value of use as a setting; no time is nought, also where the device calls it by a name."""
        if time and int(value) == 0:
            return Amount(Decimal(0), self.unit(register, time=True))
        shown = value_text.show(register, value)
        if isinstance(shown, bool) or not isinstance(shown, int | float):
            return str(shown).lower() if isinstance(shown, bool) else str(shown)
        number = int(shown) if shown == int(shown) else shown
        return Amount(Decimal(repr(number)), self.unit(register, time=time))

    def value(self, register: Register[Any], setting: Setting, *, time: bool = False) -> Any:  # noqa: ANN401 - as above
        """The value of use of a setting; ValueRefused for another unit, and for what the register does not know."""
        if isinstance(setting, str):
            return value_text.parse(register, setting)
        unit = self.unit(register, time=time)
        if register.kind == "raw":
            return value_text.parse(register, str(_raw(register, setting, self.time_unit if time else "").number))
        if setting.unit == RAW:
            message = f"`{setting}`: the scale is known here: write it in {unit or 'the plain number'}"
            raise ValueRefused(register.path, message)
        if time:
            return value_text.parse(register, _converted(register, setting, unit))
        return value_text.parse(register, str(setting), current_unit=unit)

    def words(self, register: Register[Any], value: Any) -> tuple[int, ...]:  # noqa: ANN401 - as above
        """The words of a value; ValueRefused for one that the device does not take as it is configured now."""
        return register.encode(value, state=self.state, givens=self.givens)


def _raw(register: Register[Any], setting: Amount, unit: str) -> Amount:
    if setting.unit != RAW and setting.number:  # nought is nought at any scale
        counted = f" (the device counts in {unit})" if unit else ""
        message = (
            f"`{setting}`: the manual does not state the decimals of this number, so it is given as the register "
            f"holds it{counted}: write `{str(setting).split()[0]} raw` if that is what the register is to hold"
        )
        raise ValueRefused(register.path, message)
    return setting


def _converted(register: Register[Any], setting: Amount, unit: str) -> str:
    """The number of a time in the unit of the device."""
    if setting.unit not in SECONDS:
        said = NO_UNIT if not setting.unit else f"{setting.unit} is no unit of time"
        message = f"`{setting}`: {said}: write {', '.join(SECONDS)} behind it, as in `30 {unit}`"
        raise ValueRefused(register.path, message)
    number = Fraction(setting.number) * Fraction(SECONDS[setting.unit]) / Fraction(SECONDS[unit])
    decimals = Decimal(number.numerator) / Decimal(number.denominator)
    if Fraction(decimals) != number or (register.kind == "integer" and number.denominator != 1):
        message = f"`{setting}`: the device counts whole {unit}, and this is {float(number):.6g} {unit}"
        raise ValueRefused(register.path, message)
    return f"{decimals:f}"
