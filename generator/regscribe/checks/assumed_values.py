"""Values that are taken as known: the defaults of a model, with the bit fields in them."""

from fractions import Fraction

from regscribe.model import Model
from regscribe.reference import number_of


def default_values(model: Model) -> dict[str, Fraction]:
    """The defaults of all registers of a model that are numbers, by path."""
    found = {register.path: number_of(register, register.default) for register in model.registers}
    return {path: number for path, number in found.items() if number is not None}


def with_fields(model: Model, values: dict[str, Fraction]) -> dict[str, Fraction]:
    """The values by path, and those of the bit fields in them by `path.field`, unless `values` has these as well."""
    fields = {
        f"{register.path}.{bits.id}": Fraction((int(values[register.path]) >> bits.low) % (1 << bits.width))
        for register in model.registers
        if register.fields and register.path in values
        for bits in register.fields
    }
    return fields | values
