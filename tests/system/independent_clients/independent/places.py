"""Everything that a model shows, and how it is read in few requests without leaving what is documented."""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby

from independent.families import column
from regscribe.model import Model, Order, Protocol, Register, RegisterMap, Space, View, WireType
from regscribe.simulate import SimulatedDevice


@dataclass(frozen=True, slots=True)
class Shown:
    """One value at one address, in one view; `swapped`: its words come the least significant first."""

    register: Register
    view: View
    address: int
    swapped: bool

    @property
    def column(self) -> str:
        """The column of the table that it belongs to."""
        return column(self.register, self.view.space, self.view.type, self.view.name, swapped=self.swapped)


@dataclass(frozen=True, slots=True)
class Stretch:
    """Values of one type that stand one behind the other, within the device's limit for one request."""

    values: tuple[Shown, ...]

    @property
    def first(self) -> Shown:
        """The first of them, which tells space, type and order of all."""
        return self.values[0]

    @property
    def words(self) -> int:
        """How many addresses they take."""
        return sum(each.view.words for each in self.values)


def shown(device: SimulatedDevice) -> list[Shown]:
    """Return every readable value of the device in every view and at every alias, by space and address."""
    found = [
        Shown(register, view, address, device.state.order(view).words is Order.LITTLE)
        for register in device.model.registers
        if register.access.readable
        for view in register.views
        for address in (view.address(register.at), *(register.aliases if view is register.base else ()))
    ]
    return sorted(found, key=lambda each: (each.view.space, each.address))


def stretches(device: SimulatedDevice) -> Iterator[Stretch]:
    """Yield all of `shown` in stretches."""
    for _, alike in groupby(shown(device), key=lambda each: (each.view.space, each.view.type, each.swapped)):
        together: list[Shown] = []
        for each in alike:
            if together and not _fits(together, each, device.register_map.protocol):
                yield Stretch(tuple(together))
                together = []
            together.append(each)
        yield Stretch(tuple(together))


def _fits(together: list[Shown], each: Shown, protocol: Protocol) -> bool:
    last = together[-1]
    most = protocol.read_bits if each.view.space.is_bits else protocol.read_words
    words = sum(one.view.words for one in together) + each.view.words
    return each.view.type is not WireType.STRING and each.address == last.address + last.view.words and words <= most


def reading_functions(register_map: RegisterMap, space: Space) -> tuple[int, ...]:
    """Return the functions that read a space of this device: the usual one, and those that do the same."""
    usual = {Space.COIL: 1, Space.DISCRETE: 2, Space.HOLDING: 3, Space.INPUT: 4, Space.STATUS: 7}[space]
    return next((codes for codes in register_map.alike if usual in codes), (usual,))


def readable(model: Model) -> int:
    """Count the registers that can be read."""
    return sum(register.access.readable for register in model.registers)
