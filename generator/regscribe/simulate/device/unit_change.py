"""A new unit of measure: a device converts the values that it holds."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction

from regscribe.model import Register
from regscribe.reference import choose, round_by
from regscribe.simulate.device.device_plan import Stored
from regscribe.simulate.device.state import DeviceState

KELVIN = Fraction(1), Fraction(0)
CELSIUS = Fraction(1), Fraction("273.15")
FAHRENHEIT = Fraction(5, 9), Fraction("459.67") * Fraction(5, 9)
UNITS = {"K": KELVIN, "°C": CELSIUS, "°F": FAHRENHEIT}
"""Units that convert into each other: kelvin = factor x value + offset."""


@dataclass(frozen=True, slots=True)
class Held:
    """What a register held under its former unit: a value of use."""

    register: Register
    symbol: str
    value: Fraction


def held_before(state: DeviceState, changed: Register, before: Stored, after: Stored) -> tuple[Held, ...]:
    """Return what all registers of a unit held before `changed`, which sets the unit, took its new value."""
    state.store(changed.path, before)
    found = tuple(_held(state, changed.rescales))
    state.store(changed.path, after)
    return found


def _held(state: DeviceState, unit: str) -> Iterator[Held]:
    for register in state.blueprint.model.registers:
        stored = state.stored(register.path)
        if register.unit_id != unit or not isinstance(stored, Fraction) or stored in register.faults:
            continue
        if state.to_value(register, stored) not in {state.special(register, each) for each in register.specials}:
            yield Held(register, choose(register.unit, state) or "", state.to_value(register, stored))


def rescale(state: DeviceState, former: Iterable[Held]) -> Iterator[tuple[str, float, float]]:
    """Convert what registers held into the units of now; yields each register with its factor and offset."""
    for held in former:
        symbol = choose(held.register.unit, state) or ""
        if symbol == held.symbol or not {symbol, held.symbol} <= UNITS.keys():
            continue
        factor, offset = _between(held.symbol, symbol)
        if held.register.difference:
            offset = Fraction(0)
        stored = state.from_value(held.register, held.value * factor + offset)
        state.store(held.register.path, _rounded(held.register, stored))
        yield held.register.path, float(factor), float(offset)


def _between(old: str, new: str) -> tuple[Fraction, Fraction]:
    (factor, offset), (per, zero) = UNITS[old], UNITS[new]
    return factor / per, (offset - zero) / per


def _rounded(register: Register, stored: Fraction) -> Fraction:
    """As fine as the whole numbers of its views tell apart: 37.777... is kept as 37.8."""
    views = [view for view in register.views if not view.type.is_float]
    if not views:
        return stored
    finest = max(views, key=lambda view: view.factor)
    return Fraction(round_by(finest.rounding, stored * finest.factor)) / finest.factor
