"""Facts about registers and commands: communication settings, identification, write conditions, command steps."""

from enum import StrEnum
from typing import Any, NamedTuple

from regscribe_runtime.values.conditions import ALWAYS, Condition, State
from regscribe_runtime.values.numbers import Number
from regscribe_runtime.values.wire_types import Space, written_space


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
    """A register that holds a communication setting: the setting of each code, and from when it applies.

    `codes` are pairs of a code and the setting as text ("9600", "E", "8N1", "jbus"); of an address the value itself
    counts. None where the manual does not print them. `since` is at_once (the answer to the write is lost),
    after_answer, apply, restart, or empty where the manual does not say.
    """

    setting: Setting
    codes: tuple[tuple[int, str], ...] = ()
    since: str = ""

    def value(self, code: Any) -> str | None:
        """The setting of a code; None where the manual does not print it."""
        return next((text for known, text in self.codes if known == code), None)


NEVER = float("inf")
POLLS = {"fast": 0.0, "normal": 1.0, "slow": 10.0, "once": NEVER, "never": 0.0}
"""Seconds between two readings of a register that is followed, by the word; what is `never` is, by name, like any."""


class ReadFacts(NamedTuple):
    """How a register wants to be read.

    `clears`: reading it changes it, so it is read only where it is asked for by name. `poll` is a word of POLLS, or
    seconds (0: it is not stated), `good_for` the seconds for which a value that was read holds (0: not stated).
    """

    clears: bool = False
    poll: str | Number = 0
    good_for: Number = 0

    @property
    def pause(self) -> float:
        """Seconds after a reading in which another one would tell nothing new, or is not wanted."""
        wanted = POLLS[self.poll] if isinstance(self.poll, str) else float(self.poll)
        return wanted or float(self.good_for)


PLAIN_READING = ReadFacts()


class WriteCondition(NamedTuple):
    """The condition under which a write is accepted, and the manual's reason in own words."""

    when: Condition
    reason: str


class Identity(NamedTuple):
    """Identification of a model: the condition holds, and each text register begins with the text beside it."""

    when: Condition = ALWAYS
    texts: tuple[tuple[str, str], ...] = ()

    def registers(self) -> tuple[str, ...]:
        """The registers that must be read."""
        return tuple(dict.fromkeys([*self.when.registers, *(path for path, _ in self.texts)]))

    def fits(self, state: State) -> bool:
        """Tell whether the values read identify the model."""
        texts_fit = all(str(state[path]).startswith(text) for path, text in self.texts)
        return texts_fit and self.when.holds(state, {})


class CommandStep(NamedTuple):
    """One request of a command: words (bits of coils) to an address; without words, a wait in milliseconds.

    The address counts from the base of `block`, if there is one. With `argument`, as many words as stand here are those
    of the argument of that name. It is done only while `when` holds.
    """

    function: int
    address: int
    words: tuple[int, ...]
    wait: int = 0
    block: str = ""
    argument: str = ""
    when: Condition = ALWAYS

    @property
    def space(self) -> Space:
        """The address space that the function writes."""
        return written_space(self.function, self.address)


class Page(NamedTuple):
    """How registers with addresses of their own are reached: after `steps`, or at another unit id (0: the same).

    `at_once`: holding registers there are read by function 23, whose request writes the words of all steps first.
    """

    steps: tuple[CommandStep, ...] = ()
    unit: int = 0
    at_once: bool = False

    @property
    def words(self) -> tuple[int, ...]:
        """The words of all steps, whose addresses follow each other where all are written `at_once`."""
        return tuple(word for step in self.steps for word in step.words)
