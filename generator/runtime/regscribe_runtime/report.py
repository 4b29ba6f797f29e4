"""Reports of writes: the fate of each register and command of a `configure`, and the count of EEPROM writes."""

from collections import UserDict
from collections.abc import Callable
from enum import StrEnum
from typing import Any, NamedTuple

Words = tuple[int, ...]


MOST_EQUAL = 5
"""More registers that held their value already are counted, not named, so that the others stand out."""


class Fate(StrEnum):
    """The fate of one value.

    `PLANNED` of a dry run. `EQUAL`: the device held it already. `DIFFERS`: written, but reading it back shows something
    else. `RESTORED`: written and undone. `UNKNOWN`: the device may hold the old value, the new one or something else.
    """

    PLANNED = "planned"
    EQUAL = "equal"
    WRITTEN = "written"
    NOT_WRITTEN = "not written"
    DIFFERS = "differs"
    RESTORED = "restored"
    UNKNOWN = "unknown"


class Change(NamedTuple):
    """One register of a `configure`: the value that it held, the one that it is to hold, and its fate.

    `before` and `sent` are words of `view`, `was` and `value` what they mean (None where the register cannot be read,
    or holds no value). `read` are the words that were read back last (None: not read).
    """

    register: str
    view: str
    before: Words | None
    sent: Words
    was: Any
    value: Any
    fate: Fate = Fate.PLANNED
    read: Words | None = None


class Sent(NamedTuple):
    """One request of a `configure`, or a command of it (`command` names it; it may be several requests)."""

    function: int
    address: int
    words: Words
    registers: tuple[str, ...]
    command: str = ""
    fate: Fate = Fate.PLANNED


class Progress(NamedTuple):
    """How far a `configure` is: `done` of `total` registers; `what` comes next."""

    done: int
    total: int
    what: str


Teller = Callable[[Progress], None]
"""Called before each request of a `configure`; an exception that it raises breaks the operation off (and undoes it)."""


class WriteReport(NamedTuple):
    """What a `configure` did, or would do: its registers and requests in the order of writing."""

    changes: tuple[Change, ...]
    requests: tuple[Sent, ...]
    dry_run: bool = False

    def paths(self, *fates: Fate) -> tuple[str, ...]:
        """The registers with one of these fates."""
        return tuple(change.register for change in self.changes if change.fate in fates)

    @property
    def written(self) -> tuple[str, ...]:
        """Registers that hold their new value now."""
        return self.paths(Fate.WRITTEN)

    @property
    def equal(self) -> tuple[str, ...]:
        """Registers that held it already and were spared."""
        return self.paths(Fate.EQUAL)

    @property
    def not_written(self) -> tuple[str, ...]:
        """Registers that hold what they held, written and restored ones included."""
        return self.paths(Fate.NOT_WRITTEN, Fate.RESTORED)

    @property
    def unknown(self) -> tuple[str, ...]:
        """Registers that may hold the old value, the new one or something else."""
        return self.paths(Fate.UNKNOWN, Fate.DIFFERS)

    @property
    def commands(self) -> dict[str, Fate]:
        """The fates of the commands that unlock and apply, by id; of several runs the last counts."""
        return {one.command: one.fate for one in self.requests if one.command}

    @property
    def told(self) -> str:
        """The report in words: registers and commands by fate (many that were equal are counted)."""
        groups = {fate: self.paths(fate) for fate in Fate if self.paths(fate)}
        parts = [f"{fate}: {_listed(fate, paths)}" for fate, paths in groups.items()]
        parts += [f"{command}: {_COMMAND[fate]}" for command, fate in self.commands.items()]
        return "; ".join(parts) or "nothing to write"


def _listed(fate: Fate, paths: tuple[str, ...]) -> str:
    return f"{len(paths)} registers" if fate is Fate.EQUAL and len(paths) > MOST_EQUAL else ", ".join(paths)


_COMMAND = {
    Fate.PLANNED: "not run",
    Fate.WRITTEN: "run",
    Fate.NOT_WRITTEN: "not run",
    Fate.UNKNOWN: "may have been run",
}


class Count(NamedTuple):
    """Writes of one register: sent, and spared because it held the value already."""

    written: int = 0
    spared: int = 0


class Wear(UserDict[str, Count]):
    """Writes to the EEPROM by this driver since it was made: registers by path."""

    @property
    def written(self) -> int:
        """Writes to the EEPROM that were sent."""
        return sum(count.written for count in self.data.values())

    @property
    def spared(self) -> int:
        """Writes that were not sent, because the register held the value already."""
        return sum(count.spared for count in self.data.values())

    def add(self, path: str, *, written: int = 0, spared: int = 0) -> None:
        """Count writes of a register."""
        now = self.data.get(path, Count())
        self.data[path] = Count(now.written + written, now.spared + spared)

    def __repr__(self) -> str:
        return f"Wear(written={self.written}, spared={self.spared})"
