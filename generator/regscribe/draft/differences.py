"""What becomes of a difference between two versions of a list, and how registers of both are found."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from regscribe.draft.map_registers import MapRegister
from regscribe.model import Span


class Change(StrEnum):
    """What became of a difference between two versions of a list."""

    CHANGED = "changed"
    ADDED = "added"
    KEPT = "kept as you have it"
    GONE = "gone from the list"


@dataclass(frozen=True, slots=True)
class Note:
    """One difference: what became of it, of which register, where that stands in the map, and what was what."""

    change: Change
    name: str
    message: str
    place: Span


@dataclass(frozen=True, slots=True)
class Merged:
    """The text of the map with what the list changed, and every difference."""

    text: str
    notes: tuple[Note, ...]


class Index:
    """Finds registers by where they are on the wire, else by their id."""

    def __init__(self, registers: Sequence[MapRegister]) -> None:
        self._places: dict[Any, list[MapRegister]] = {}
        self._ids: dict[str, list[MapRegister]] = {}
        for register in registers:
            self._places.setdefault(register.place, []).append(register)
            self._ids.setdefault(register.id, []).append(register)

    def find(self, wanted: MapRegister) -> MapRegister | None:
        """The same register; by its place the one of that id, if several stand there."""
        there = self._places.get(wanted.place, [])
        named = [register for register in there if register.id == wanted.id]
        if named or len(there) == 1:
            return (named or there)[0]
        alike = self._ids.get(wanted.id, [])
        return alike[0] if len(alike) == 1 and not there else None
