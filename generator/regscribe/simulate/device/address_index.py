"""Where the values of a model stand: the address index that reads and writes consult."""

from collections.abc import Iterable
from dataclasses import dataclass

from regscribe.model import Model, Register, Space, View


@dataclass(frozen=True, slots=True)
class AddressSpan:
    """One value at one address: `start` is the wire address of its first word (an alias has a start of its own)."""

    register: Register
    view: View
    start: int

    @property
    def words(self) -> int:
        """How many addresses the value takes."""
        return self.view.words

    def covers(self) -> range:
        """Return the addresses that the value takes."""
        return range(self.start, self.start + self.view.words)


@dataclass(frozen=True, slots=True)
class Region:
    """The rules for requests that start between `first` and `last`: alignment and function codes (empty: any)."""

    first: int
    last: int
    align: int
    functions: tuple[int, ...]


class AddressIndex:
    """The address index of one model: immutable once built, so devices of the same model may share it."""

    __slots__ = ("_bounds", "_places", "_regions", "command_addresses", "reserved", "unused")

    def __init__(self, model: Model, reserved: Iterable[tuple[Space, int, int]] = ()) -> None:
        self._places: dict[Space, dict[int, AddressSpan]] = {space: {} for space in Space}
        self._regions: dict[Space, tuple[Region, ...]] = {}
        for register in model.registers:
            for place in places_of(register):
                self._places[place.view.space].update(dict.fromkeys(place.covers(), place))
        self.reserved = _each(reserved)
        self.unused = _each(model.unused)
        for space in Space:
            self._regions[space] = _regions(model, space)
        steps = (step for command in model.commands for step in command.steps if step.words)
        self.command_addresses = _each((step.space, step.address, step.address + len(step.words) - 1) for step in steps)
        self._bounds = {space: self._bounds_of(space) for space in Space}

    def place(self, space: Space, address: int) -> AddressSpan | None:
        """Return the value that has a word at `address`; None if there is none."""
        return self._places[space].get(address)

    def region(self, space: Space, address: int) -> Region | None:
        """Return the rules for a request that starts at `address`; None if no view set speaks of it."""
        return next((region for region in self._regions[space] if region.first <= address <= region.last), None)

    def documents(self, space: Space, address: int) -> bool:
        """Whether `address` lies between the lowest and the highest of which the map says anything in that space."""
        return address in self._bounds[space]

    def in_hole(self, space: Space, address: int) -> bool:
        """Whether `address` holds no register but lies between the lowest and the highest that the map documents."""
        return address in self._bounds[space] and address not in self._places[space]

    def _bounds_of(self, space: Space) -> range:
        silent = (address for kind, address in self.reserved | self.unused if kind is space)
        known = (*self._places[space], *silent)
        return range(min(known), max(known) + 1) if known else range(0)


def _each(stretches: Iterable[tuple[Space, int, int]]) -> frozenset[tuple[Space, int]]:
    return frozenset((space, address) for space, first, last in stretches for address in range(first, last + 1))


def places_of(register: Register) -> tuple[AddressSpan, ...]:
    """Every place where a register is transmitted: its views, then the aliases of the base view."""
    views = (AddressSpan(register, view, view.address(register.at)) for view in register.views)
    return (*views, *(AddressSpan(register, register.base, address) for address in register.aliases))


def _regions(model: Model, space: Space) -> tuple[Region, ...]:
    views = ((register.at, view) for register in model.registers for view in register.views if view.space is space)
    found = (
        Region(*(view.region or (view.address(at), view.last(at))), align=view.align, functions=view.functions)
        for at, view in views
        if view.align > 1 or view.functions
    )
    return tuple(dict.fromkeys(found))
