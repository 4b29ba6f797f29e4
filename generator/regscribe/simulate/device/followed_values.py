"""What a register takes from others by itself."""

from fractions import Fraction

from regscribe.model import Kind, Register
from regscribe.reference import Known, choose, holds
from regscribe.simulate.device.value_arguments import with_field


def sources_of(register: Register) -> set[str]:
    """Return the registers whose change may change this one."""
    conditions = [case.when for case in register.follows]
    conditions += [field.follows for field in register.fields if field.follows is not None]
    return {case.then for case in register.follows} | {path for when in conditions for path in when.registers}


def source_of(register: Register, state: Known) -> str:
    """Return the register that this one follows now; empty if it follows none."""
    return choose(register.follows, state) or ""


def followed_bits(register: Register, word: Fraction, state: Known) -> Fraction:
    """Return `word` with the bits that follow a condition as the conditions have them now."""
    for field in register.fields:
        if field.follows is not None:
            word = with_field(word, field, Fraction(int(holds(field.follows, state))))
    return word


def has_followed_bits(register: Register) -> bool:
    """Whether a bit of the register follows anything."""
    return register.kind is not Kind.STRING and any(field.follows is not None for field in register.fields)
