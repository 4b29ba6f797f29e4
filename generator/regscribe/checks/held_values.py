"""Values that a map gives to registers: the defaults by path, and whether a register can hold a value at all."""

from fractions import Fraction

from regscribe.checks.representable import Fit, best_fit, ends_of, is_meant, tells_apart
from regscribe.model import BitField, Kind, Model, Register, show
from regscribe.reference import RefusedError, number_of, version_number
from regscribe.reference.octets import octets_of
from regscribe.reference.settled_scales import forms
from regscribe_runtime.values.kinds import OCTETS
from regscribe_runtime.values.octets import PLAIN_TEXT

TEXTS = OCTETS | {Kind.VERSION}
NUMBERS = frozenset({Kind.NUMBER, Kind.INTEGER, Kind.RAW})
PATTERNS = frozenset({Kind.FLAGS, Kind.FIELDS})


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


def shown(value: Fraction | str) -> str:
    """A value for a message."""
    return repr(value) if isinstance(value, str) else show(value)


def wrong_sort(register: Register, value: Fraction | str) -> str:
    """Why a value is none of the register's kind, as `which is ...`; empty where it is one."""
    if isinstance(value, str) != (register.kind in TEXTS):
        return f"which is {'a text' if isinstance(value, str) else 'no text'}"
    if register.kind is Kind.BOOLEAN and value not in {0, 1}:
        return "which is neither 0 nor 1"
    if not isinstance(value, str):
        return ""
    if register.kind is Kind.VERSION:
        return _no_version(register, value)
    if register.text != PLAIN_TEXT or register.kind is not Kind.STRING:
        return _no_octets(register, value)
    room = 2 * register.base.words
    problem = f"which is {len(value)} characters with room for {room}" if len(value) > room else ""
    if value.endswith(" "):
        problem = "whose blanks at the end are never read"
    return problem if value.isascii() else "which is no ASCII text"


def _no_octets(register: Register, text: str) -> str:
    try:
        octets_of(register, text, 2 * register.base.words)
    except RefusedError as refused:
        return f"which its words cannot say: {refused}"
    return "whose blanks at the end are never read" if text.endswith(" ") else ""


def _no_version(register: Register, text: str) -> str:
    try:
        version_number(register, text)
    except RefusedError:
        size = register.version_group or register.version_digits
        pattern = ".".join(["n" * size] * (register.version_digits // (size or 1)))
        return f"which is not written as {pattern}" if register.version_digits else ""
    return ""


def outside_type(register: Register, value: Fraction | str) -> bool:
    """Whether a number is outside the type of every view under every scale; False for a text."""
    number = number_of(register, value)
    if number is None or is_meant(register, number):
        return False
    if register.kind in PATTERNS:
        return not 0 <= number < 1 << register.bits
    return best_fit(register, (number,)) is Fit.TOO_LARGE


def too_fine(register: Register, value: Fraction | str) -> bool:
    """Whether a number lies between two that the words can spell, in every view and scale; False for a text."""
    if isinstance(value, str) or is_meant(register, value):
        return False
    if not register.fractional and value.denominator != 1:
        return True
    fit = best_fit(register, (value,))
    return fit is Fit.TOO_FINE or (fit is Fit.EXACT and not tells_apart(register, value))


def is_fault(register: Register, value: Fraction | str) -> bool:
    """Whether the stored number of a value is a fault, under every scale."""
    number = number_of(register, value)
    if number is None or is_meant(register, number):
        return False
    if register.kind in PATTERNS:
        return any(register.is_fault(each) for each in (number, number - (1 << register.bits)))
    stored = [form.stored(number) for form in forms(register)] if register.faults else []
    return bool(stored) and all(map(register.is_fault, stored))


def no_member(register: Register, value: Fraction | str) -> str:
    """The code in a value that the enum of the register or of a bit field lacks, for a message; empty if none lacks."""
    if isinstance(value, str) or value.denominator != 1:
        return ""
    parts = [("", register.enum, int(value))]
    parts += [(f" of `{one.id}`", one.enum, int(value) >> one.low & (1 << one.width) - 1) for one in register.fields]
    for where, enum, code in parts:
        if enum is not None and all(member.code != code for member in enum.members):
            codes = ", ".join(str(member.code) for member in enum.members)
            return f"{code}{where}, which its enum does not list ({codes})"
    return ""


def impossible(register: Register, value: Fraction | str) -> str:
    """Why a register should not hold a value, as `which is ...`: its words cannot, or no enum lists it; else empty."""
    problem = unspellable(register, value)
    return problem or ("which is none of its codes" if no_member(register, value) else "")


def unspellable(register: Register, value: Fraction | str) -> str:
    """Why the words of a register cannot hold a value exactly, as `which is ...`; empty where they can."""
    problem = wrong_sort(register, value)
    if problem:
        return problem
    if outside_type(register, value):
        return f"which is outside {ends_of(register)}"
    return "which its words cannot spell exactly" if too_fine(register, value) else ""


def impossible_part(field: BitField, value: Fraction | str) -> str:
    """Why the bits of a field cannot hold a value, as `which is ...`; empty where they can."""
    if isinstance(value, str) or value.denominator != 1 or not 0 <= value < 1 << field.width:
        return f"which {field.width} {'bits' if field.width > 1 else 'bit'} cannot spell"
    codes = {member.code for member in field.enum.members} if field.enum else {value}
    return "" if value in codes else "which is none of its codes"
