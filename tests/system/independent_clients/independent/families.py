"""The families of devices: a model of each, the states in which it is tried, and values for all its registers."""

import importlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any

from regscribe.model import Kind, Model, Register, RegisterMap, Space, WireType, registers_of
from regscribe.simulate import SimulatedDevice
from regscribe.simulate.map_cache import find_map

MAPS = Path(__file__).parents[4] / "maps"
LINEAR = {"input_type": 14, "linear_decimal_position": 2, "ieee_register_ordering": 0}
LINEAR_INPUTS = {"linear_inputs": frozenset({17})}


@dataclass(frozen=True, eq=False)
class Family:
    """A map, the model to try, and what is set before it is tried."""

    map: str
    model: str
    sets: Mapping[str, int] = field(default_factory=dict)
    givens: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """How tests and the table call it."""
        return self.map if not self.sets else f"{self.map} (linear input)"

    @property
    def register_map(self) -> RegisterMap:
        """The compiled map."""
        return compiled(self.map)

    def device(self) -> SimulatedDevice:
        """Make a device in which every register holds something to be recognised."""
        device = SimulatedDevice(self.register_map, self.model, givens=self.givens)
        for path, value in self.sets.items():
            device.poke(path, value)
        fill(device)
        return device

    def driver(self, link: Any, unit: int) -> Any:
        """Make the own driver on `link`."""
        maker, _, name = self.map.partition("/")
        module = importlib.import_module(f"regscribe_devices.{maker}.{name.replace('-', '_')}")
        return getattr(module, self.register_map.model(self.model).class_name)(link, unit=unit, **self.givens)


FAMILIES = (
    Family("athena/series-c", "16C"),
    Family("athena/series-c", "16C", sets=LINEAR),
    Family("omega/cn8200", "CN8200"),
    Family("omega/cn8200", "CN8200", sets=LINEAR),
    Family("fdc/series-100", "C21", givens=LINEAR_INPUTS),
    Family("fdc/series-100", "BTC-9100", sets={"inpt": 17, "dp": 3}, givens=LINEAR_INPUTS),
    Family("athena/platinum-c10-m10", "C10"),
    Family("athena/platinum-m300", "M300"),
    Family("athena/platinum-m400", "M400"),
    Family("athena/platinum-m5000", "M5000"),
    Family("athena/platinum-x100-x400", "X400"),
    Family("athena/platinum-x5000", "X5000"),
)


def compiled(name: str) -> RegisterMap:
    """Return the map of this id."""
    return find_map(MAPS / f"{name}.yaml")


def steering(model: Model) -> set[str]:
    """Return the registers that decide what others mean: they stay as they are."""
    found = {register.path for register in model.registers if register.governs is not None}
    for register in model.registers:
        found |= {*registers_of(register.scale), *registers_of(register.unit)}
        told = (one for case in register.scale for one in (case.then.decimals, case.then.places))
        found |= {one.register for one in told if one}
        found |= {path for view in register.views for path in view.needs()}
        found |= set(register.writable.when.registers) if register.writable else set()
    return found


def fill(device: SimulatedDevice) -> None:
    """Let every register hold a value of its own; those that steer others keep theirs."""
    fixed = steering(device.model)
    for place, register in enumerate(device.model.registers, 1):
        if register.path not in fixed:
            device.state.store(register.path, _something(register, place))


def _something(register: Register, place: int) -> Fraction | str:
    if register.kind is Kind.STRING:
        letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
        return "".join(letters[(place + at) % len(letters)] for at in range(2 * register.base.words))
    if register.enum is not None:
        return Fraction(register.enum.members[place % len(register.enum.members)].code)
    if register.base.type is WireType.BIT:
        return Fraction(place % 2)
    if register.kind in {Kind.FLAGS, Kind.FIELDS}:
        return Fraction(_field_bits(register, place))
    if any(view.type.is_float for view in register.views):
        return Fraction((-1) ** place * place * 321, 4)
    low, high = register.base.type.minimum, register.base.type.maximum
    return Fraction(low + place * 40503 % (high - low + 1))


def _field_bits(register: Register, place: int) -> int:
    bits = 0
    for count, each in enumerate(register.fields):
        code = each.enum.members[place % len(each.enum.members)].code if each.enum else (place + count) % 2
        bits |= code << each.low
    return bits


def column(register: Register, space: Space, wire: WireType, view: str, *, swapped: bool) -> str:
    """Return the column of the table that a value belongs to."""
    if space is not Space.HOLDING:
        return space.value
    if register.kind is Kind.STRING:
        return "text"
    if register.kind in {Kind.VERSION, Kind.FLAGS, Kind.FIELDS}:
        return "flags" if register.kind is not Kind.VERSION else "version"
    if wire.is_float:
        return f"{wire.value} {'low word first' if swapped else 'high word first'}"
    return wire.value + (" x10" if view == "x10" else "")


COLUMNS = (
    "int16",
    "int16 x10",
    "uint16",
    "float32 low word first",
    "float32 high word first",
    "text",
    "version",
    "flags",
    "coil",
    "status",
)


def columns() -> Iterator[str]:
    """Yield the columns of the table, in order."""
    yield from COLUMNS
