"""Effects of writes, commands and power cuts on other registers, besides the words that were written."""

from collections import Counter
from collections.abc import Iterable, Iterator
from fractions import Fraction

from regscribe.model import Command, Effect, Register
from regscribe.reference import choose, holds, round_by
from regscribe.simulate.device.commands import Commands
from regscribe.simulate.device.device_plan import Stored
from regscribe.simulate.device.state import DeviceState
from regscribe.simulate.process.controller import Controller

LASTING = {"eeprom", "both"}
BOTH, RAM = "both", "ram"

KELVIN = Fraction(1), Fraction(0)
CELSIUS = Fraction(1), Fraction("273.15")
FAHRENHEIT = Fraction(5, 9), Fraction("459.67") * Fraction(5, 9)
UNITS = {"K": KELVIN, "°C": CELSIUS, "°F": FAHRENHEIT}
"""Units that convert into each other: kelvin = factor x value + offset."""


class Conduct:
    """Applies the side effects of one device; `wear` counts the writes to its lasting memory by register."""

    __slots__ = ("_commands", "_effects", "_own", "_state", "controller", "wear")

    def __init__(self, state: DeviceState, commands: Commands, controller: Controller | None) -> None:
        self.wear: Counter[str] = Counter()
        self.controller = controller
        self._state = state
        self._commands = commands
        self._effects: dict[str, Command] = {command.id: command for command in state.blueprint.model.commands}
        self._own: set[str] = set()

    def written(self, register: Register, before: Stored) -> None:
        """Handle an accepted write: it wears memory, may wait for a command, and may change other registers."""
        path, state = register.path, self._state
        after = state.stored(path)
        spared = after == before and state.blueprint.register_map.spares_memory
        if register.persistence in LASTING and not spared:
            self.wear[path] += 1
        if register.apply and after != before:
            state.hold_back(path, before)
        if register.rescales and after != before:
            self._rescale(register, before, after)
        self._pass_on(register, after)
        state.set_bits(register)
        self._own.add(path)
        self._shade(register)
        if register.stays == "momentary":
            state.store(path, state.blueprint.stored[path])

    def commanded(self, completed: Iterable[str]) -> None:
        """Handle completed commands: what waited for them comes into effect, and they have effects of their own."""
        for name in completed:
            for path in self._state.pending:
                if self._state.register(path).apply == name:
                    self._state.take_effect(path)
            for effect in self._effects[name].effects:
                if holds(effect.when, self._state):
                    self._bring_about(effect)

    def power_cycle(self) -> None:
        """Cut power and restore it: what only RAM holds is lost, what waited is in effect, unlocks are forgotten."""
        state = self._state
        self._commands.forget()
        self._own.clear()
        for path in state.pending:
            state.take_effect(path)
        for register in state.blueprint.model.registers:
            if register.persistence == RAM and not register.shadows and not state.source(register):
                state.store(register.path, state.blueprint.stored[register.path])
        state.wake()
        if self.controller is not None:
            self.controller.reset()

    def _bring_about(self, effect: Effect) -> None:
        state = self._state
        for path, value in effect.sets:
            state.put(path, value)
        for path in effect.defaults:
            register = state.register(path)
            default = state.default(register)
            if default is not None:
                self.wear[path] += register.persistence in LASTING
                state.poke(path, default)
        if effect.unlatch and self.controller is not None:
            self.controller.release()

    def _shade(self, register: Register) -> None:
        """Copy a written value to the register's shadows, and to theirs, as long as these were not written."""
        changed = {register.path: register}
        for shadow in self._state.blueprint.shadows:
            origin = changed.get(shadow.shadows)
            if origin is not None and (origin.persistence == BOTH or shadow.path not in self._own):
                self._state.put(shadow.path, self._state.usable(origin, self._state.stored(origin.path)))
                changed[shadow.path] = shadow

    def _pass_on(self, register: Register, after: Stored) -> None:
        """Write the new value of a follower to the register that it follows now, if that can be written."""
        source = self._state.source(register)
        if not source or not self._state.register(source).access.writable:
            return
        before = self._state.stored(source)
        self._state.put(source, self._state.usable(register, after))
        if self._state.stored(source) != before:
            self.written(self._state.register(source), before)

    def _rescale(self, changed: Register, before: Stored, after: Stored) -> None:
        """Convert the values of all registers of the unit of measure that `changed` sets."""
        state = self._state
        state.store(changed.path, before)
        former = tuple(_values_in(state, changed.rescales))
        state.store(changed.path, after)
        for register, old, value in former:
            new = choose(register.unit, state) or ""
            if new == old or not {new, old} <= UNITS.keys():
                continue
            (factor, offset), (per, zero) = UNITS[old], UNITS[new]
            factor, offset = factor / per, (offset - zero) / per
            if register.difference:
                offset = Fraction(0)
            state.store(register.path, _rounded(state, register, state.from_value(register, value * factor + offset)))
            if self.controller is not None:
                self.controller.convert(register.path, float(factor), float(offset))


def _values_in(state: DeviceState, unit: str) -> Iterator[tuple[Register, str, Fraction]]:
    """Registers of a unit of measure with its present symbol and their values of use; none without a number."""
    for register in state.blueprint.model.registers:
        stored = state.stored(register.path)
        if register.unit_id != unit or not isinstance(stored, Fraction) or register.is_fault(stored):
            continue
        value = state.to_value(register, stored)
        if value not in {state.special(register, each) for each in register.specials}:
            yield register, choose(register.unit, state) or "", value


def _rounded(state: DeviceState, register: Register, stored: Fraction) -> Fraction:
    """Round to the resolution of the whole numbers of its views: 37.777... is kept as 37.8."""
    views = [state.seen(view) for view in register.views if not view.type.is_float]
    if not views:
        return stored
    finest = max(views, key=lambda view: view.factor)
    return Fraction(round_by(finest.rounding, stored * finest.factor)) / finest.factor
