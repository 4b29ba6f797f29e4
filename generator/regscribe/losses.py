"""What a form of another program cannot say of a register, and what an exporter did about it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from enum import IntEnum


class Grade(IntEnum):
    """How much a loss matters, the worst first."""

    WRONG = 0
    LOST = 1
    COSMETIC = 2

    @property
    def words(self) -> str:
        """What it means for the user of the export."""
        return ("wrong if the device is set otherwise", "lost", "cosmetic")[self]


@dataclass(frozen=True, slots=True)
class Loss:
    """A fact that an export does not carry: of which register (by path), which fact, how grave, and what was done."""

    register: str
    fact: str
    grade: Grade
    done: str
    model: str = ""


@dataclass(frozen=True, slots=True)
class Exported:
    """Texts (or bytes) by path, the losses, and remarks on the whole: whether a real program ever read such a text."""

    texts: Mapping[str, str | bytes]
    losses: tuple[Loss, ...] = ()
    remarks: tuple[str, ...] = field(default=())


def worst_first(losses: Iterable[Loss]) -> tuple[Loss, ...]:
    """The losses, the gravest first, each kind in the order of the map."""
    return tuple(sorted(losses, key=lambda one: one.grade))
