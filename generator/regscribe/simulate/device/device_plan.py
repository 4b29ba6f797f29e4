"""The part of a device that all devices of its model share: its address index, dependencies and initial state."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from types import MappingProxyType

from regscribe.model import Model, NotANumber, Register, RegisterMap, Space, View
from regscribe.reference import Surroundings

Stored = Fraction | str | NotANumber
"""What the device holds for a register: a number (an enum's code, a word's bits), a text, or a float that is none."""

Image = dict[Space, dict[int, int]]
"""What a read shows at each address."""


@dataclass(frozen=True, slots=True)
class AddressSpan:
    """One value at one address: `start` is the wire address of its first word (an alias has a start of its own)."""

    register: Register
    view: View
    start: int

    def serves(self, *, writing: bool) -> bool:
        """Whether it is for reading, or for writing."""
        access, view = self.register.access, self.view
        return (access.writable and view.writable) if writing else (access.readable and view.readable)

    @property
    def addresses(self) -> list[int]:
        """The addresses of its words."""
        return [self.start + offset for offset in self.view.offsets]

    @property
    def end(self) -> int:
        """The first address behind the value."""
        return self.start + self.view.words


class AddressIndex:
    """The address index of one model, which reads and writes consult; immutable once built.

    `fixed` are the words of chains around blocks, which read as they are.
    """

    __slots__ = (
        *("_all", "_bounds", "_places", "_regions", "_written", "conditional"),
        *("command_addresses", "fixed", "reserved", "silent", "unused"),
    )

    def __init__(
        self,
        model: Model,
        reserved: Iterable[tuple[Space, int, int]],
        fixed: Mapping[tuple[Space, int], int] = MappingProxyType({}),
    ) -> None:
        self.fixed = fixed
        self._all: dict[tuple[Space, int], list[AddressSpan]] = {}
        self._places: dict[Space, dict[int, AddressSpan]] = {space: {} for space in Space}
        self._written: dict[Space, dict[int, AddressSpan]] = {space: {} for space in Space}
        self._regions: dict[tuple[Space, range, int, tuple[int, ...]], View] = {}
        for register in model.registers:
            for place in places_of(register):
                self._take(place)
            for view in register.views:
                if (view.align, view.functions) != (1, ()):
                    first, last = view.region or (view.address(register.at), view.last(register.at))
                    self._regions.setdefault((view.space, range(first, last + 1), view.align, view.functions), view)
        self.reserved = _addresses(reserved)
        self.unused = _addresses(model.unused)
        self.silent = self.reserved | self.unused
        self.command_addresses = _addresses(
            (step.space, step.address, step.address + len(step.words) - 1)
            for command in model.commands
            for step in command.steps
        )
        self._bounds = {
            (space, page): self._bounds_of(space, page) for space in Space for page in range(len(model.pages) + 1)
        }
        some = (
            there
            for there, spans in self._all.items()
            if any(not one.register.when.always for one in spans) or (len(spans) > 1 and spans[0].view.is_byte)
        )
        self.conditional = {there: tuple(self._all[there]) for there in some}

    def _take(self, place: AddressSpan) -> None:
        for address in place.addresses:
            self._all.setdefault((place.view.space, address), []).append(place)
        access, view = place.register.access, place.view
        addresses = place.addresses
        for index, fits in (
            (self._places, access.readable and view.readable),
            (self._written, access.writable and view.writable),
        ):
            there = index[view.space]
            there.update((each, place) for each in addresses if fits or each not in there)

    def place(self, space: Space, address: int, *, writing: bool = False) -> AddressSpan | None:
        """Return the value that has a word at `address`; None if there is none.

        Where one value is read and another one written, it is the one to read, or the one to write if `writing`.
        """
        return (self._written if writing else self._places)[space].get(address)

    def place_now(
        self, space: Space, address: int, exists: Callable[[Register], bool], *, writing: bool = False
    ) -> AddressSpan | None:
        """As `place`, among the registers that exist."""
        spans = self.conditional.get((space, address))
        if spans is None:
            return self.place(space, address, writing=writing)
        here = [one for one in spans if exists(one.register)]
        return next((one for one in here if one.serves(writing=writing)), here[0] if here else None)

    def region(self, space: Space, address: int, function: int) -> View | None:
        """Return the view whose alignment and functions bind a request that starts at `address`; None if none does."""
        regions = self._regions.items()
        found = [view for (kind, addresses, *_), view in regions if kind is space and address in addresses]
        return next((view for view in found if view.allows(function)), found[0] if found else None)

    def documents(self, space: Space, address: int) -> bool:
        """Whether `address` lies between the lowest and the highest that the map documents in that space."""
        return address in self._bounds[space, space.page(address)]

    def plain(self, space: Space) -> frozenset[int]:
        """The addresses of a space that a request may begin at, as they stand in it."""
        return frozenset(space.plain(address) for address in (*self._places[space], *self._written[space]))

    def _bounds_of(self, space: Space, page: int) -> range:
        silent = (address for kind, address in self.silent if kind is space)
        fixed = (address for kind, address in self.fixed if kind is space)
        documented = [each for each in (*self._places[space], *silent, *fixed) if space.page(each) == page]
        return range(min(documented), max(documented) + 1) if documented else range(0)


def _addresses(stretches: Iterable[tuple[Space, int, int]]) -> frozenset[tuple[Space, int]]:
    return frozenset((space, address) for space, first, last in stretches for address in range(first, last + 1))


def places_of(register: Register) -> tuple[AddressSpan, ...]:
    """Every place where a register is transmitted: its views, then the aliases of the base view.

    What reads the words of another register again has none: they are shown, and held, for the other alone.
    """
    if register.rereads:
        return ()
    views = (AddressSpan(register, view, view.address(register.at)) for view in register.views)
    return (*views, *(AddressSpan(register, register.base, address) for address in register.aliases))


@dataclass(frozen=True, slots=True)
class Blueprint:
    """The immutable part of a device: 1,000 devices of one model share one.

    `stored` and `image` are the state of a new device, of which each device keeps only what is different; `DeviceState`
    fills them once. `places` are where a register is transmitted, `ordered_by` the registers whose word order a
    register sets, `followers` those that (or whose bits) change with it, `shadows` the registers that take their value
    from another one when power comes, each behind the one that it shadows; `rereading` those that read the words of
    another one.
    """

    register_map: RegisterMap
    model: Model
    givens: Surroundings
    layout: AddressIndex
    places: Mapping[str, tuple[AddressSpan, ...]]
    ordered_by: Mapping[str, tuple[Register, ...]]
    followers: Mapping[str, tuple[Register, ...]]
    shadows: tuple[Register, ...]
    rereading: frozenset[str]
    stored: dict[str, Stored] = field(default_factory=dict)
    image: Image = field(default_factory=lambda: {space: {} for space in Space})


def draw(
    register_map: RegisterMap, model: Model, givens: Surroundings, fixed: Mapping[tuple[Space, int], int]
) -> Blueprint:
    """Return a new blueprint, its state still empty."""
    origins = {register.path: register.shadows for register in model.registers if register.shadows}
    return Blueprint(
        register_map,
        model,
        givens,
        AddressIndex(model, register_map.reserved, fixed),
        {register.path: places_of(register) for register in model.registers},
        _by_source(model.registers, lambda register: {path for view in register.views for path in view.needs()}),
        _by_source(model.registers, sources_of),
        tuple(model.register(path) for path in sorted(origins, key=lambda path: _depth(path, origins))),
        frozenset(register.path for register in model.registers if register.rereads),
    )


def sources_of(register: Register) -> set[str]:
    """Return the registers that this one, or one of its bits, follows in some state."""
    conditions = [case.when for case in register.follows]
    conditions += [field.follows for field in register.fields if field.follows is not None]
    return {case.then for case in register.follows} | {path for when in conditions for path in when.registers}


def _by_source(
    registers: Iterable[Register], sources: Callable[[Register], Iterable[str]]
) -> dict[str, tuple[Register, ...]]:
    found: dict[str, list[Register]] = {}
    for register in registers:
        for path in sources(register):
            found.setdefault(path, []).append(register)
    return {path: tuple(dependents) for path, dependents in found.items()}


def _depth(path: str, origins: Mapping[str, str]) -> int:
    passed: list[str] = []
    while path in origins and path not in passed:  # the latter: a circle, which has to end somewhere
        passed.append(path)
        path = origins[path]
    return len(passed)
