"""Values with names: enums whose unknown codes survive, flags that keep unknown bits, words of bit fields."""

from collections.abc import Iterator
from enum import Enum, IntEnum, IntFlag
from typing import Any, ClassVar, Generic, Self, TypeVar, overload

V = TypeVar("V")


class Choice(IntEnum):
    """An enum of a register: members carry the manual's `label` and perhaps a `description`.

    A code that the manual does not list is read as a pseudo-member named `UNKNOWN_<code>` whose `known` is False; a
    write refuses it.
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
        if not isinstance(value, int):
            return None
        unknown = int.__new__(cls, value)
        unknown._name_, unknown._value_ = f"UNKNOWN_{value}", value
        unknown.label, unknown.description, unknown.known = f"unknown code {value}", "", False
        return unknown


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


class Flags(IntFlag):
    """A word of single bits; bits that the manual does not name are kept as read."""

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

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: "Word", owner: type) -> V: ...
    def __get__(self, instance: "Word | None", owner: type) -> Self | V:
        if instance is None:
            return self
        kind: Any = self.kind
        value: V = kind(int(instance) >> self.low & (1 << (self.high - self.low + 1)) - 1)
        return value


class Bit(Field[bool]):
    """One bit of a word as a bool; `low` counts from 0, the least significant."""

    def __init__(self, low: int, label: str = "") -> None:
        super().__init__(low, low, bool, label)


class Word(int):
    """A word of bit fields: an int whose subclasses name its parts; `replace` makes a changed copy."""

    parts: ClassVar[tuple[str, ...]] = ()

    def __init_subclass__(cls) -> None:
        cls.parts = tuple(name for name, part in vars(cls).items() if isinstance(part, Field))

    def replace(self, **parts: int) -> Self:
        """A copy with some parts set anew; TypeError for an unknown part, ValueError for one that does not fit."""
        code = int(self)
        for name, value in parts.items():
            if name not in self.parts:
                message = f"{type(self).__name__} has no part {name!r}; it has {', '.join(self.parts)}"
                raise TypeError(message)
            part = vars(type(self))[name]
            mask = (1 << (part.high - part.low + 1)) - 1
            if not 0 <= int(value) <= mask:
                message = f"{name} is {value!r}, but {part.high - part.low + 1} bits hold 0 to {mask}"
                raise ValueError(message)
            code = code & ~(mask << part.low) | int(value) << part.low
        return type(self)(code)

    def __iter__(self) -> Iterator[tuple[str, Any]]:
        return ((name, getattr(self, name)) for name in self.parts)

    def __repr__(self) -> str:
        inside = ", ".join(f"{name}={value!r}" for name, value in self)
        return f"{type(self).__name__}(0x{int(self):04X}: {inside})"
