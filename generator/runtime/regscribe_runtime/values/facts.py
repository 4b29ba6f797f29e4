"""Facts about registers and commands: what sets the line, how a model shows itself, what a command sends."""

from enum import StrEnum
from typing import Any, NamedTuple

from regscribe_runtime.values.conditions import ALWAYS, Condition, State
from regscribe_runtime.values.wire_types import Space


class Setting(StrEnum):
    """A setting of the line; `FORMAT` is data bits, parity and stop bits together, `ADDRESSING` modbus or jbus."""

    ADDRESS = "address"
    BAUD = "baud"
    PARITY = "parity"
    DATA_BITS = "data_bits"
    STOP_BITS = "stop_bits"
    FORMAT = "format"
    ADDRESSING = "addressing"


class Governs(NamedTuple):
    """A register that sets how the device talks: what each code of it sets, and from when that holds.

    `codes` are pairs of a code and the setting as text ("9600", "E", "8N1", "jbus"); of an address the value itself
    counts. None where the manual does not print them. `since` is at_once (the answer to the write is lost),
    after_answer, apply, restart, or empty where the manual does not say.
    """

    setting: Setting
    codes: tuple[tuple[int, str], ...] = ()
    since: str = ""

    def value(self, code: Any) -> str | None:
        """What a code sets; None where the manual does not print it."""
        return next((text for known, text in self.codes if known == code), None)


class WriteCondition(NamedTuple):
    """When a write is accepted: the condition, and the manual's reason in own words."""

    when: Condition
    reason: str


class Identity(NamedTuple):
    """How a device shows its model: the condition holds, and each text register begins with the text beside it."""

    when: Condition = ALWAYS
    texts: tuple[tuple[str, str], ...] = ()

    def registers(self) -> tuple[str, ...]:
        """The registers that must be read."""
        return tuple(dict.fromkeys([*self.when.registers, *(path for path, _ in self.texts)]))

    def fits(self, state: State) -> bool:
        """Tell whether the values read are those of the model."""
        told = all(str(state[path]).startswith(text) for path, text in self.texts)
        return told and self.when.holds(state, {})


class CommandStep(NamedTuple):
    """One request of a command: words (bits of coils) to an address; without words, a wait in milliseconds."""

    function: int
    address: int
    words: tuple[int, ...]
    wait: int = 0

    @property
    def space(self) -> Space:
        """What the function writes."""
        return Space.COIL if self.function in Space.COIL.write_functions else Space.HOLDING
