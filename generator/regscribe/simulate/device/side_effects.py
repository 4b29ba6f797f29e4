"""What follows from a write, from a command and from a power cut, besides the words that change."""

from collections import Counter
from collections.abc import Iterable
from fractions import Fraction

from regscribe.model import Command, Effect, Register
from regscribe.reference import holds
from regscribe.simulate.device.commands import Commands
from regscribe.simulate.device.device_plan import Stored
from regscribe.simulate.device.followed_values import source_of
from regscribe.simulate.device.state import DeviceState
from regscribe.simulate.device.unit_change import held_before, rescale
from regscribe.simulate.process.controller import Controller

LASTING = {"eeprom", "both"}
BOTH, RAM = "both", "ram"


class Conduct:
    """One device's conduct: `wear` counts the writes that its lasting memory took, by register."""

    __slots__ = ("_commands", "_effects", "_own", "_state", "controller", "wear")

    def __init__(self, state: DeviceState, commands: Commands, controller: Controller | None) -> None:
        self.wear: Counter[str] = Counter()
        self.controller = controller
        self._state = state
        self._commands = commands
        self._effects: dict[str, Command] = {command.id: command for command in state.blueprint.model.commands}
        self._own: set[str] = set()

    def written(self, register: Register, before: Stored) -> None:
        """A write was taken: it wears memory, may wait for a command, and may change other registers."""
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
        self._own.add(path)
        self._shade(register)

    def commanded(self, completed: Iterable[str]) -> None:
        """Commands were completed: what waited for them comes into effect, and they have effects of their own."""
        for name in completed:
            for path in self._state.pending:
                if self._state.register(path).apply == name:
                    self._state.take_effect(path)
            for effect in self._effects[name].effects:
                if holds(effect.when, self._state):
                    self._bring_about(effect)

    def power_cycle(self) -> None:
        """Power goes and comes: what only RAM holds is lost, what waited is in effect, what was unlocked is locked."""
        state = self._state
        self._commands.forget()
        self._own.clear()
        for path in state.pending:
            state.take_effect(path)
        for register in state.blueprint.model.registers:
            if register.persistence == RAM and not register.shadows and not source_of(register, state):
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
            if register.default is not None:
                self.wear[path] += register.persistence in LASTING
                state.poke(path, register.default)
        if effect.unlatch and self.controller is not None:
            self.controller.release()

    def _shade(self, register: Register) -> None:
        """What is written to a register counts in its shadows, and in theirs, as long as these were not written."""
        changed = {register.path: register}
        for shadow in self._state.blueprint.shadows:
            origin = changed.get(shadow.shadows)
            if origin is not None and (origin.persistence == BOTH or shadow.path not in self._own):
                self._state.put(shadow.path, self._value(origin))
                changed[shadow.path] = shadow

    def _pass_on(self, register: Register, after: Stored) -> None:
        """What is written to a follower goes on to the register that it follows now, if that can be written."""
        source = source_of(register, self._state)
        if not source or not self._state.register(source).access.writable:
            return
        origin = self._state.register(source)
        before = self._state.stored(source)
        self._state.put(source, self._state.to_value(register, after) if isinstance(after, Fraction) else after)
        if self._state.stored(source) != before:
            self.written(origin, before)

    def _value(self, register: Register) -> Stored:
        stored = self._state.stored(register.path)
        return self._state.to_value(register, stored) if isinstance(stored, Fraction) else stored

    def _rescale(self, register: Register, before: Stored, after: Stored) -> None:
        former = held_before(self._state, register, before, after)
        for path, factor, offset in rescale(self._state, former):
            if self.controller is not None:
                self.controller.convert(path, factor, offset)
