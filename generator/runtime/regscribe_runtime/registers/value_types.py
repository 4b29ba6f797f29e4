"""Python types of register values: float, int, enum, flags, word, text, version or bool."""

from collections.abc import Callable
from enum import Enum
from fractions import Fraction
from typing import Any, Generic, TypeVar

from regscribe_runtime.errors import NotDecodable, ValueRefused
from regscribe_runtime.registers.enums import Choice, Flags, SpecialNumber, Word
from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.numbers import Number, brief, exact, rough

T = TypeVar("T")
C = TypeVar("C", bound=Choice)
S = TypeVar("S", bound=Choice | SpecialNumber)
F = TypeVar("F", bound=Flags)
W = TypeVar("W", bound=Word)


class ValueType(Generic[T]):
    """The Python type of a register's values.

    `make` builds a value from a number; `number` is the reverse (ValueRefused for what is no value). `coded` kinds have
    no scale: their number is the code itself. `special` is the enum of special values, `means` maps codes of special
    values to the number they stand for.
    """

    __slots__ = ("coded", "kind", "make", "means", "number", "special")

    def __init__(
        self,
        kind: Kind,
        make: Callable[[Any], T],
        number: Callable[[str, Any], Fraction],
        *,
        coded: bool = False,
        special: type[Enum] | None = None,
        means: dict[Number, Number] | None = None,
    ) -> None:
        self.kind, self.make, self.number, self.coded = kind, make, number, coded
        self.special, self.means = special, means or {}


def _any_number(register: str, value: Any) -> Fraction:
    try:
        return exact(value)
    except ValueError as error:
        raise ValueRefused(register, str(error)) from None


def _whole_number(register: str, value: Any) -> Fraction:
    number = _any_number(register, value)
    if number.denominator != 1:
        raise ValueRefused(register, f"{rough(number)} is no whole number; the register holds whole numbers only")
    return number


number: ValueType[float] = ValueType(Kind.NUMBER, float, _any_number)
integer: ValueType[int] = ValueType(Kind.INTEGER, int, _whole_number)
raw: ValueType[int] = ValueType(Kind.RAW, int, _whole_number)
raw_float: ValueType[float] = ValueType(Kind.RAW, float, _any_number)


def number_or(special: type[S], means: dict[Number, Number] | None = None) -> ValueType[float | S]:
    """A number with special values: a code in `means` stands for a number, the others are members of `special`."""
    return ValueType(Kind.NUMBER, float, _any_number, special=special, means=means)


def integer_or(special: type[C], means: dict[Number, Number] | None = None) -> ValueType[int | C]:
    """As `number_or`, of whole numbers."""
    return ValueType(Kind.INTEGER, int, _whole_number, special=special, means=means)


def number_with(means: dict[Number, Number]) -> ValueType[float]:
    """A number some of whose codes stand for another number (0 for 0.2 s)."""
    return ValueType(Kind.NUMBER, float, _any_number, means=means)


def integer_with(means: dict[Number, Number]) -> ValueType[int]:
    """As `number_with`, of whole numbers."""
    return ValueType(Kind.INTEGER, int, _whole_number, means=means)


def choice(members: type[C]) -> ValueType[C]:
    """An enum; unknown codes are read as pseudo-members and refused in a write."""

    def code(register: str, value: Any) -> Fraction:
        if isinstance(value, bool) or not isinstance(value, int) or (isinstance(value, Choice) and not value.known):
            raise ValueRefused(register, f"{brief(value)} is no member of {members.__name__}")
        if isinstance(value, Choice) and not isinstance(value, members):
            raise ValueRefused(register, f"{value!r} belongs to {type(value).__name__}, not to {members.__name__}")
        if all(member.value != value for member in members):
            known = ", ".join(f"{member.value} {member.label}" for member in members)
            raise ValueRefused(register, f"code {brief(int(value))} is none of {known}")
        return Fraction(int(value))

    return ValueType(Kind.ENUM, members, code, coded=True)


def flags(members: type[F]) -> ValueType[F]:
    """A word of single bits; unnamed bits are refused in a write."""

    def code(register: str, value: Any) -> Fraction:
        if isinstance(value, bool) or not isinstance(value, int):
            raise ValueRefused(register, f"{brief(value)} is no {members.__name__}")
        unnamed = _any_number(register, int(value)).numerator & ~int(members.named())
        if unnamed:
            raise ValueRefused(register, f"bits 0x{unnamed:X} have no meaning in {members.__name__}")
        return Fraction(int(value))

    return ValueType(Kind.FLAGS, members, code, coded=True)


def word_of(members: type[W]) -> ValueType[W]:
    """A word of bit fields, written as one number."""

    def code(register: str, value: Any) -> Fraction:
        if isinstance(value, bool) or not isinstance(value, int):
            raise ValueRefused(register, f"{brief(value)} is no {members.__name__}")
        return _any_number(register, int(value))

    return ValueType(Kind.FIELDS, members, code, coded=True)


def _bit(register: str, value: Any) -> Fraction:
    if not isinstance(value, int | float) or value not in (0, 1):
        raise ValueRefused(register, f"{brief(value)} is neither True nor False")
    return Fraction(int(value))


def _truth(number: int) -> bool:
    if number not in (0, 1):
        raise NotDecodable(_BOOLEAN, f"{number} is neither 0 nor 1")
    return bool(number)


_BOOLEAN = "a truth value"
boolean: ValueType[bool] = ValueType(Kind.BOOLEAN, _truth, _bit, coded=True)

_VERSION = "a version"


def version(digits: int, group: int) -> ValueType[str]:
    """Decimal digits packed in a number: 013100 with groups of 2 is "01.31.00"."""

    def make(code: int) -> str:
        packed = f"{code:0{digits}d}"
        if code < 0 or len(packed) > digits:
            raise NotDecodable(_VERSION, f"{code} has more than {digits} decimal digits")
        return ".".join(packed[start : start + group] for start in range(0, digits, group))

    def code(register: str, value: Any) -> Fraction:
        packed = value.replace(".", "") if isinstance(value, str) else ""
        if not (packed.isascii() and packed.isdigit() and len(packed) == digits and make(int(packed)) == value):
            raise ValueRefused(register, f"{brief(value)} is no version of {digits} digits in groups of {group}")
        return Fraction(int(packed))

    return ValueType(Kind.VERSION, make, code, coded=True)
