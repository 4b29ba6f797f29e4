"""Python types of register values: float, int, enum, flags, word, text, version or bool."""

from collections.abc import Callable, Mapping
from enum import Enum
from fractions import Fraction
from types import MappingProxyType
from typing import Any, Generic, TypeVar

from regscribe_runtime.errors import ConditionNotMet, NotDecodable, NotPresent, ValueRefused
from regscribe_runtime.registers.enums import Choice, Flags, SpecialNumber, Word
from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.numbers import Number, brief, exact, rough

T = TypeVar("T")
Missing = Mapping[str, NotPresent]
"""What a value can be made of and does not exist now, by name, with the error of each."""
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

    def without(self, missing: Missing) -> "ValueType[T]":
        """The same type while some of what its values are made of does not exist."""
        message = f"values of kind {self.kind} are not made of {', '.join(missing)}"
        raise TypeError(message)


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


class ChoiceType(ValueType[C]):
    """Values of an enum, or of one enum in each case; unknown codes are pseudo-members, which a write refuses."""

    __slots__ = ("classes", "missing")

    def __init__(self, classes: tuple[type[C], ...], missing: Missing = MappingProxyType({})) -> None:
        self.classes, self.missing = classes, missing
        make = classes[0] if len(classes) == 1 and not missing else self._make
        super().__init__(Kind.ENUM, make, self._code, coded=True)

    def without(self, missing: Missing) -> "ChoiceType[C]":
        """The same enums while some of their members do not exist."""
        return ChoiceType(self.classes, missing) if missing else self

    @property
    def members(self) -> tuple[C, ...]:
        """The members of all enums."""
        return tuple(member for one in self.classes for member in one)

    @property
    def _name(self) -> str:
        return " or ".join(one.__name__ for one in self.classes)

    def _gone(self, member: C) -> NotPresent | None:
        place = self.classes.index(type(member))
        return self.missing.get(str(place)) or self.missing.get(f"{place}.{member.name}")

    def _make(self, code: int) -> C:
        for member in self.members:
            if member.value == code and not self._gone(member):
                return member
        present = [one for place, one in enumerate(self.classes) if str(place) not in self.missing]
        return (present or self.classes)[0].unknown(code)

    def _code(self, register: str, value: Any) -> Fraction:
        if isinstance(value, bool) or not isinstance(value, int) or (isinstance(value, Choice) and not value.known):
            raise ValueRefused(register, f"{brief(value)} is no member of {self._name}")
        if isinstance(value, Choice) and not isinstance(value, self.classes):
            raise ValueRefused(register, f"{value!r} belongs to {type(value).__name__}, not to {self._name}")
        members = [value] if isinstance(value, self.classes) else [one for one in self.members if one.value == value]
        if not members:
            known = ", ".join(f"{member.value} {member.label}" for member in self.members if not self._gone(member))
            raise ValueRefused(register, f"code {brief(int(value))} is none of {known}")
        if all(map(self._gone, members)):
            raise _not_now(register, f"{type(members[0]).__name__}.{members[0].name}", self._gone(members[0]))
        return Fraction(int(value))


def _not_now(register: str, name: str, gone: NotPresent | None) -> ValueRefused:
    condition, present = (gone.condition, gone.present) if gone else ("", {})
    return ConditionNotMet(register, f"{name} exists only while {condition}", present)


def choice(*classes: type[C]) -> ChoiceType[C]:
    """An enum; with several, the register's `partial` cases say which of them counts."""
    return ChoiceType(classes)


class _BitsType(ValueType[T]):
    """A word whose bits have meanings by name, some of which may be `missing` now."""

    __slots__ = ("bits", "missing", "named")

    def __init__(
        self, kind: Kind, make: Callable[[Any], T], name: str, bits: Mapping[str, int], missing: Missing
    ) -> None:
        self.named, self.bits, self.missing = name, bits, missing
        super().__init__(kind, make, self._code, coded=True)

    @property
    def absent(self) -> int:
        """The bits of what does not exist now."""
        return sum(self.bits[name] for name in self.missing)

    def _code(self, register: str, value: Any) -> Fraction:
        if isinstance(value, bool) or not isinstance(value, int):
            raise ValueRefused(register, f"{brief(value)} is no {self.named}")
        code = int(value)
        for name, gone in self.missing.items():
            if code & self.bits[name]:
                raise _not_now(register, name, gone)
        return Fraction(code)


class FlagsType(_BitsType[F]):
    """A word of single bits; unnamed bits are refused in a write, and those of flags that do not exist."""

    __slots__ = ("members",)

    def __init__(self, members: type[F], missing: Missing = MappingProxyType({})) -> None:
        self.members = members
        bits = {str(one.name): int(one) for one in members}
        super().__init__(Kind.FLAGS, members, members.__name__, bits, missing)

    def without(self, missing: Missing) -> "FlagsType[F]":
        """The same word while some of its flags do not exist."""
        return FlagsType(self.members, missing) if missing else self

    def idle(self, code: int) -> int:
        """The bits of a word that mean nothing now."""
        return code & (~int(self.members.named()) | self.absent)

    def _code(self, register: str, value: Any) -> Fraction:
        code = super()._code(register, value)
        unnamed = int(code) & ~int(self.members.named())
        if unnamed:
            raise ValueRefused(register, f"bits 0x{unnamed:X} have no meaning in {self.members.__name__}")
        return code


def flags(members: type[F]) -> FlagsType[F]:
    """A word of single bits."""
    return FlagsType(members)


class WordType(_BitsType[W]):
    """A word of bit fields, written as one number; bits of parts that do not exist are refused in a write."""

    __slots__ = ("members",)

    def __init__(self, members: type[W], missing: Missing = MappingProxyType({})) -> None:
        self.members = members
        bits = {name: members.mask(name) for name in members.parts}
        super().__init__(Kind.FIELDS, self._make if missing else members, members.__name__, bits, missing)

    def without(self, missing: Missing) -> "WordType[W]":
        """The same word while some of its parts do not exist."""
        return WordType(self.members, missing) if missing else self

    def idle(self, code: int) -> int:
        """The bits of a word that are of no part that exists now, though of one that may."""
        return code & self.absent

    def _make(self, code: int) -> W:
        return self.members(code).lacking(self.missing)


def word_of(members: type[W]) -> WordType[W]:
    """A word of bit fields."""
    return WordType(members)


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
