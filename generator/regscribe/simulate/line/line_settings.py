"""The settings of a device on its line (unit id, first address), and the registers that govern them."""

from regscribe.model import Setting
from regscribe.simulate.device.state import DeviceState
from regscribe.simulate.errors import SimulatorError
from regscribe_runtime.values.serial_line import ADDRESSINGS, first_address

AT_ONCE, RESTART = "at_once", "restart"


class Tuning:
    """The unit id and the first address of one device; a speed or a format is the line's own and changes nothing here.

    At first the registers show what the device was made with. Where the map does not say from when a setting holds, it
    holds after the answer.
    """

    def __init__(self, state: DeviceState, *, unit: int, addressing: str) -> None:
        self._state, self.unit = state, unit
        try:
            self.first = first_address(addressing)
        except ValueError as problem:
            raise SimulatorError(str(problem)) from None
        registers = state.blueprint.model.registers
        self._governing = tuple((each, each.governs) for each in registers if each.governs is not None)
        self._applied: dict[str, object] = {}
        self.keep()

    def keep(self) -> None:
        """Keep the present settings whatever was put into the registers, and show them there."""
        addressing = next(name for name, first in ADDRESSINGS.items() if first == self.first)
        for register, governs in self._governing:
            code = None
            if governs.setting is Setting.ADDRESS:
                code = self.unit
            elif governs.setting is Setting.ADDRESSING:
                code = next((code for code, name in governs.codes if name == addressing), None)
            if code is not None:
                self._state.poke(register.path, code)
        self._applied.update((each.path, self._state.stored(each.path)) for each, _ in self._governing)

    def follow(self, *, restarted: bool = False) -> bool:
        """Apply the registers after a request, or after power came back; whether its answer is lost by that."""
        lost = False
        for register, governs in self._governing:
            path, stored = register.path, self._state.stored(register.path)
            waits = path in self._state.pending or (governs.since == RESTART and not restarted)
            if waits or stored == self._applied[path]:
                continue
            self._applied[path] = stored
            value = self._state.look_up(path)
            if governs.setting is Setting.ADDRESS:
                self.unit = int(value)
            elif governs.setting is Setting.ADDRESSING:
                name = next((name for code, name in governs.codes if code == value), "")
                self.first = ADDRESSINGS.get(name, self.first)
            lost |= governs.since == AT_ONCE
        return lost
