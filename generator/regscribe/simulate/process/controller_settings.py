"""Settings of a controller: numbers and conditions that are looked up again only when one of them changed."""

from collections.abc import Iterator

from regscribe.model import Condition, Register, registers_of
from regscribe.reference import holds
from regscribe.simulate.device.state import DeviceState


class ControllerSettings:
    """Cache of numbers and conditions, also of registers that the controller itself moves."""

    def __init__(self, state: DeviceState) -> None:
        self._state = state
        self._numbers: dict[str, float] = {}
        self._conditions: dict[int, bool] = {}
        self._paths: set[str] = set()

    def refresh(self) -> frozenset[str]:
        """Forget what may have changed since the last call; return the registers that were touched."""
        touched = frozenset(self._state.touched)
        if not touched.isdisjoint(self._paths):
            self._numbers.clear()
            self._conditions.clear()
        self._state.touched.clear()
        return touched

    def number(self, path: str) -> float:
        """Return the value of use of a register; 0 for none."""
        if not path:
            return 0.0
        if path not in self._numbers:
            register, _ = self._state.find(path)
            self._paths.update(dependencies(register))
            self._numbers[path] = float(self._state.look_up(path))
        return self._numbers[path]

    def holds(self, condition: Condition | None) -> bool:
        """Whether a condition holds; none never does."""
        if condition is None:
            return False
        key = id(condition)  # conditions live as long as their map
        if key not in self._conditions:
            for path in condition.registers:
                self._paths.update(dependencies(self._state.register(path)))
            self._conditions[key] = holds(condition, self._state)
        return self._conditions[key]


def dependencies(register: Register) -> Iterator[str]:
    """The registers on which the value of one depends, itself first."""
    yield register.path
    yield from registers_of(register.scale)
    yield from (case.then.decimals.register for case in register.scale if case.then.decimals)
