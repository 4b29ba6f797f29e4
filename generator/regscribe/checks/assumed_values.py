"""What is taken as known while a map is judged: the defaults of a model, or what a worked example says."""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from regscribe.model import GivenKind, Model, Register, RegisterMap
from regscribe.reference import Surroundings, number_of

MOST_DECIMALS = 30
"""No display has so many digits."""


def with_fields(model: Model, values: dict[str, Fraction]) -> dict[str, Fraction]:
    """The values by path, and those of the bit fields in them by `path.field`, unless these are said apart."""
    fields = {
        f"{register.path}.{bits.id}": Fraction((int(values[register.path]) >> bits.low) % (1 << bits.width))
        for register in model.registers
        if register.fields and register.path in values
        for bits in register.fields
    }
    return fields | values


def default_values(model: Model) -> dict[str, Fraction]:
    """The defaults of all registers of a model that are numbers, by path."""
    found = {register.path: number_of(register, register.default) for register in model.registers}
    return {path: number for path, number in found.items() if number is not None}


@dataclass(frozen=True, slots=True)
class Beginning:
    """What is looked up once for a model: the defaults by path, and which registers hold numbers of decimals."""

    values: dict[str, Fraction]
    counts: frozenset[str]

    @classmethod
    def of(cls, model: Model) -> "Beginning":
        """Look at all registers."""
        counts = frozenset(path for register in model.registers for path in count_registers(register))
        return cls(default_values(model), counts)

    def sensible(self, values: dict[str, Fraction]) -> dict[str, Fraction]:
        """The values without absurd numbers of decimals, since 10 to the power of them would be computed."""
        return {path: value for path, value in values.items() if path not in self.counts or value <= MOST_DECIMALS}


def count_registers(register: Register) -> list[str]:
    """The registers that hold numbers of decimals of a register: of its scale, its step and its range."""
    told = [case.then.decimals for case in register.scale]
    told += [case.then.places for case in register.scale]
    told += [case.then.decimals for case in register.range]
    return [one.register for one in told if one]


def all_defaults(model: Model, beginning: Beginning) -> Surroundings:
    """The state in which every register stands at its default; what has none, and every given, is not known."""
    return Surroundings(with_fields(model, beginning.sensible(beginning.values)))


def in_example(
    register_map: RegisterMap, model: Model, beginning: Beginning, said: Iterable[tuple[str, Fraction]]
) -> Surroundings:
    """The state of a worked example: what it says, else the defaults.

    An example may name a given: then it holds that one code (a boolean given: true unless 0). A given that is not
    named holds no code and is not true.
    """
    values = beginning.values | dict(said)
    codes = {
        given.id: frozenset({values.pop(given.id)} if given.id in values else ())
        for given in register_map.givens
        if given.kind is GivenKind.CODES
    }
    facts = {
        given.id: bool(values.pop(given.id, 0)) for given in register_map.givens if given.kind is GivenKind.BOOLEAN
    }
    return Surroundings(with_fields(model, beginning.sensible(values)), codes, facts)
