"""Values of registers as plain text and numbers, as backups have them, and back."""

from collections.abc import Iterable
from decimal import Decimal, InvalidOperation, localcontext
from fractions import Fraction

from regscribe.model import BitField, Enum, Kind, Register, Sentinel, parse, show
from regscribe.model.nearest import nearest
from regscribe.reference import choose, existing_members, part_bits, part_value
from regscribe.reference.codec import PATTERNS
from regscribe.simulate.device.device_plan import Stored
from regscribe.simulate.device.state import DeviceState
from regscribe.simulate.device.value_arguments import codes_of, field_value, with_field
from regscribe.simulate.errors import SimulatorError
from regscribe_runtime.values.kinds import OCTETS

Plain = str | int | float | bool | list[str]
"""A number, a name, a text, or the names of set flags (`part=value` of bit fields)."""

LARGEST = 400
"""Power of ten beyond all numbers that any type carries."""

DIGITS = 17
"""Significant digits of a number: more than any view carries."""


def shown(state: DeviceState, register: Register, stored: Stored) -> Plain:
    """Return the plain value of what is stored for a register, by the present scale and names."""
    if register.kind in PATTERNS and isinstance(stored, Fraction) and not state.fault(register, stored):
        return _parts(register, stored)
    value = state.meant(register, stored)
    if isinstance(value, str):
        return value
    return bool(value) if register.kind is Kind.BOOLEAN else _named(state, register, value)


def spell(state: DeviceState, register: Register, stored: Stored) -> str:
    """Return the plain value as text for people: `150.5 °F`, `RUN`, `alarm_1, alarm_2`."""
    plain = shown(state, register, stored)
    if isinstance(plain, list):
        return ", ".join(plain) or register.none or "none"
    text = f"{plain:.10g}" if isinstance(plain, float) else str(plain)
    text = text.lower() if isinstance(plain, bool) else text
    unit = choose(register.unit, state) if isinstance(plain, int | float) else ""
    return f"{text} {unit}" if unit else text


def set_to(state: DeviceState, register: Register, plain: object) -> None:
    """Set a register to a plain value; SimulatorError if it is none of the register's."""
    if isinstance(plain, list) and register.kind in PATTERNS:
        state.poke(register.path, _word(register, plain))
    elif isinstance(plain, bool) and register.kind is Kind.BOOLEAN:
        state.poke(register.path, int(plain))
    elif isinstance(plain, str | int | float | Decimal) and not isinstance(plain, bool):
        try:
            state.poke(register.path, _bounded(register, plain))
        except (ValueError, OverflowError):
            message = f"{str(plain)[:60]!r} is no value of `{register.path}`"
            raise SimulatorError(message) from None
    else:
        message = f"{plain!r} is no value of `{register.path}`, which is of kind {register.kind}"
        raise SimulatorError(message)


def _bounded(register: Register, plain: str | float | Decimal) -> str | int | float | Decimal:
    """Refuse a number that would take long to compute with: ValueError."""
    try:
        exponent = Decimal(str(plain)).adjusted() if register.kind not in OCTETS else 0
    except InvalidOperation:
        return plain
    if abs(exponent) > LARGEST:
        raise ValueError
    return plain


def _named(state: DeviceState, register: Register, value: Fraction) -> str | int | float:
    """The name of a value, else the number as YAML has it: whole, or with enough digits to be unique."""
    names = {Fraction(each.code): each.id for each in existing_members(register, state)} | {
        state.special(register, each): each.id for each in register.specials if each.means is None
    }
    if value in names:
        return names[value]
    if value.denominator == 1:
        return value.numerator
    with localcontext() as context:
        context.prec = DIGITS
        return float(Decimal(value.numerator) / Decimal(value.denominator))


def _parts(register: Register, stored: Fraction) -> list[str]:
    """The names of set flags and `part=value` of wider fields; a word that has more in it as a number."""
    shown: list[str] = []
    rest = stored
    for field in register.fields:
        value = field_value(stored, field)
        rest = with_field(rest, field, Fraction(0))
        if not field.is_flag:
            shown.append(f"{field.id}={_ids(field.enum).get(value) or _number(part_value(field, int(stored)))}")
        elif value:
            shown.append(field.id)
    return [*shown, str(int(rest))] if rest else shown


def _number(value: Fraction | Sentinel) -> str:
    return value.id if isinstance(value, Sentinel) else show(value)


def _ids(enum: Enum | None) -> dict[Fraction, str]:
    return {Fraction(each.code): each.id for each in enum.members} if enum else {}


def _word(register: Register, parts: list[object]) -> Fraction:
    word = Fraction(0)
    fields = {field.id.lower(): field for field in register.fields}
    for part in parts:
        name, equals, value = str(part).partition("=")
        field = fields.get(name.strip().lower())
        if field is not None:
            word = with_field(word, field, _part(register, field, value) if equals else Fraction(1))
        elif str(part).isdecimal() and len(str(part)) <= len(str(1 << register.base.type.bits)):
            word += int(str(part))
        else:
            message = f"`{register.path}` has no flag `{part}`{meant(str(part), fields)}"
            raise SimulatorError(message)
    return word


def _part(register: Register, field: BitField, value: str) -> Fraction:
    members = codes_of(field.enum)
    if value.strip().lower() in members:
        return members[value.strip().lower()]
    try:
        bits = part_bits(field, parse(value))
        return Fraction(fault_bits(field, value) if bits is None else bits)
    except ValueError:
        message = f"`{register.path}.{field.id}` has no value `{value}`{meant(value, members)}"
        raise SimulatorError(message) from None


def fault_bits(field: BitField, value: str) -> int:
    """Return the number in the bits of the fault of this id; ValueError for any other text."""
    found = next((one.ends for one in field.sentinels if one.id.lower() == value.strip().lower()), None)
    if found is None:
        raise ValueError(value)
    return int(found[0]) % (1 << field.width)


def meant(name: str, known: Iterable[str]) -> str:
    """Return a hint at the name that was probably meant; empty if none is near."""
    near = nearest(name.lower(), known)
    return f"; did you mean `{near}`?" if near else ""
