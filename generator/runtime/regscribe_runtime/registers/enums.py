"""Values with names: enums whose unknown codes survive, flags that keep unknown bits, words of bit fields."""

from collections.abc import Iterator, Mapping
from enum import Enum, IntEnum, IntFlag
from fractions import Fraction
from types import MappingProxyType
from typing import Any, ClassVar, Generic, Self, TypeVar, overload

from regscribe_runtime.errors import ConditionNotMet, NotPresent, OutOfRange, SensorFault
from regscribe_runtime.values.numbers import Number, exact, rough

V = TypeVar("V")


_LABELS: dict[tuple[str, str], str] = {}
"""What manuals call the codes that they do not list, or a word without a flag, by the name and module of the class."""


class _Labelled:
    """Takes the label of all other codes, or that of no flag, with the bases of a class."""

    def __init_subclass__(cls, *, other: str = "", none: str = "") -> None:
        _LABELS[cls.__qualname__, cls.__module__] = other or none


def _label(cls: type) -> str:
    return _LABELS.get((cls.__qualname__, cls.__module__), "")


class Choice(_Labelled, IntEnum):
    """An enum of a register: members carry the manual's `label` and perhaps a `description`.

    A code that the manual does not list is read as a pseudo-member named `UNKNOWN_<code>` whose `known` is False; a
    write refuses it. `other` is the manual's label for all of these, if it has one.
    """

    _value_: int
    label: str
    description: str
    known: bool

    def __new__(cls, code: int, label: str = "", description: str = "") -> Self:
        """Make a member of code `code`."""
        member = int.__new__(cls, code)
        member._value_ = code
        member.label, member.description, member.known = label, description, True
        return member

    @classmethod
    def _missing_(cls, value: object) -> Self | None:
        return cls.unknown(value) if isinstance(value, int) else None

    @classmethod
    def unknown(cls, value: int) -> Self:
        """The pseudo-member of a code that is not known, or that no member has as the device is set."""
        unknown = int.__new__(cls, value)
        unknown._name_, unknown._value_ = f"UNKNOWN_{value}", value
        unknown.label, unknown.description, unknown.known = _label(cls) or f"unknown code {value}", "", False
        return unknown

    def __eq__(self, other: object) -> bool:
        """Whether it is the same member, or the same number; a code that is not known is no member that has it."""
        if isinstance(other, Choice):
            return type(self) is type(other) and self._value_ == other._value_ and self.known is other.known
        return int.__eq__(self, other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = int.__hash__


class SpecialNumber(float, Enum):
    """Special values that are no whole numbers: members are floats that carry the manual's `label`."""

    label: str
    description: str

    def __new__(cls, code: float, label: str = "", description: str = "") -> Self:
        """Make a member of the number `code`."""
        member = float.__new__(cls, code)
        member._value_ = code
        member.label, member.description = label, description
        return member


class Flags(_Labelled, IntFlag):
    """A word of single bits; bits that the manual does not name are kept as read.

    `none` is the manual's label for a word in which no bit is set, if it has one.
    """

    @classmethod
    def label_of_none(cls) -> str:
        """What the manual calls a word in which no bit is set; empty where it has no word for it."""
        return _label(cls)

    @classmethod
    def named(cls) -> Self:
        """All bits that have a name."""
        everything = cls(0)
        for member in cls:
            everything |= member
        return everything


def unnamed_bits(value: Flags) -> int:
    """The bits that are set and have no name."""
    return int(value) & ~int(type(value).named())


class Field(Generic[V]):
    """Bits `low` to `high` of a word as a number or an enum."""

    def __init__(self, low: int, high: int, kind: type[V], label: str = "") -> None:
        self.low, self.high, self.kind, self.label = low, high, kind, label
        self.id = self.name = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.id, self.name = name, f"{owner.__name__}.{name}"

    @property
    def mask(self) -> int:
        """The bits of the word that are its own."""
        return (1 << self.high + 1) - (1 << self.low)

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: "Word", owner: type) -> V: ...
    def __get__(self, instance: "Word | None", owner: type) -> Self | V:
        if instance is None:
            return self
        if self.id in instance.absent:
            raise instance.absent[self.id]
        return self.of(int(instance))

    def of(self, code: int) -> V:
        """The value in the word `code`."""
        kind: Any = self.kind
        value: V = kind((code & self.mask) >> self.low)
        return value


class Bit(Field[bool]):
    """One bit of a word as a bool; `low` counts from 0, the least significant."""

    def __init__(self, low: int, label: str = "") -> None:
        super().__init__(low, low, bool, label)


class NumberField(Field[V]):
    """Bits that spell a number: value = `multiply` x number + `add`; a `signed` one is in two's complement.

    `limits` are what may be written, as values, `valid` what a reading must lie in; `faults` are numbers that report
    faults: both ends, id and label.
    """

    def __init__(  # noqa: PLR0913 (a number has this many properties; most are keywords)
        self,
        low: int,
        high: int,
        kind: type[V],
        label: str = "",
        *,
        signed: bool = False,
        multiply: Number = 1,
        add: Number = 0,
        limits: tuple[Number, Number] | None = None,
        faults: tuple[tuple[Number, Number, str, str], ...] = (),
        valid: tuple[Number, Number] | None = None,
    ) -> None:
        super().__init__(low, high, kind, label)
        self.signed, self.multiply, self.add, self.limits, self.faults = signed, multiply, add, limits, faults
        self.valid = valid

    def of(self, code: int) -> V:
        """The value in the word `code`; SensorFault for a fault, OutOfRange for what is not valid."""
        size = 1 << self.high - self.low + 1
        number = code >> self.low & size - 1
        number -= size if self.signed and number >= size >> 1 else 0
        for low, high, fault, label in self.faults:
            if low <= number <= high:
                raise SensorFault(self.name, fault, label)
        amount = Fraction(number) * self.multiply + self.add
        if self.valid and not self.valid[0] <= amount <= self.valid[1]:
            raise OutOfRange(self.name, f"{rough(amount)} lies outside {_span(*self.valid)}")
        kind: Any = self.kind
        value: V = kind(amount)
        return value

    def code_of(self, value: float) -> int:
        """The bits of a value; ValueError for one that they cannot spell, or that must not be written."""
        amount = exact(value)
        number = (amount - self.add) / Fraction(self.multiply)
        size = 1 << self.high - self.low + 1
        least = -(size >> 1) if self.signed else 0
        spans = [one for one in (self.limits, self.valid) if one]
        fits = number.denominator == 1 and least <= number < least + size
        fits = fits and all(low <= amount <= high for low, high in spans)
        if not fits or any(first <= number <= last for first, last, *_ in self.faults):
            limits = "".join(f" and lies in {_span(*one)}" for one in spans)
            steps = f"steps of {rough(Fraction(self.multiply))} that {size.bit_length() - 1} bits hold"
            message = f"{self.name} is {value!r}, which is none of its {steps}{limits}"
            raise ValueError(message)
        return number.numerator & size - 1


def _span(low: Number, high: Number) -> str:
    return f"{rough(Fraction(low))} to {rough(Fraction(high))}"


class Word(int):
    """A word of bit fields: an int whose subclasses name its parts; `replace` makes a changed copy.

    `absent` are the parts that did not exist when it was read, each with the error that reading it raises.
    """

    parts: ClassVar[tuple[str, ...]] = ()
    absent: Mapping[str, NotPresent] = MappingProxyType({})

    def __init_subclass__(cls) -> None:
        cls.parts = tuple(name for name, part in vars(cls).items() if isinstance(part, Field))

    @classmethod
    def mask(cls, name: str) -> int:
        """The bits of a part."""
        part: Field[Any] = vars(cls)[name]
        return part.mask

    def lacking(self, absent: Mapping[str, NotPresent]) -> Self:
        """The same word where these parts do not exist."""
        word = type(self)(self)
        word.absent = absent
        return word

    def replace(self, **parts: float) -> Self:
        """A copy with some parts set anew.

        TypeError for an unknown part, ValueError for one that does not fit, ConditionNotMet for one that is absent.
        """
        code = int(self)
        for name, value in parts.items():
            if name not in self.parts:
                message = f"{type(self).__name__} has no part {name!r}; it has {', '.join(self.parts)}"
                raise TypeError(message)
            if name in self.absent:
                gone = self.absent[name]
                raise ConditionNotMet(gone.register, f"it exists only while {gone.condition}", gone.present)
            part = vars(type(self))[name]
            mask = (1 << (part.high - part.low + 1)) - 1
            value = part.code_of(value) if isinstance(part, NumberField) else value  # noqa: PLW2901 (its bits)
            if not 0 <= int(value) <= mask:
                message = f"{name} is {value!r}, but {part.high - part.low + 1} bits hold 0 to {mask}"
                raise ValueError(message)
            code = code & ~(mask << part.low) | int(value) << part.low
        return type(self)(code).lacking(self.absent)

    def __iter__(self) -> Iterator[tuple[str, Any]]:
        return ((name, self._part(name)) for name in self.parts)

    def _part(self, name: str) -> Any:
        try:
            return getattr(self, name)
        except (SensorFault, OutOfRange, NotPresent) as error:
            return error

    def __repr__(self) -> str:
        inside = ", ".join(f"{name}={value!r}" for name, value in self)
        return f"{type(self).__name__}(0x{int(self):04X}: {inside})"
