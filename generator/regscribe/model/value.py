"""What a number means: scales, limits, special values, sentinels, enums and bit fields."""

from dataclasses import dataclass
from enum import Enum as Enumeration
from fractions import Fraction

from regscribe.model.condition import Cases, Condition
from regscribe.model.diagnostic import NOWHERE, Span
from regscribe_runtime.values.numbers import show


@dataclass(frozen=True, slots=True)
class Decimals:
    """A register holds the number of decimals: the factor is 10 to the power of it, at most `at_most`."""

    register: str
    at_most: int | None = None


@dataclass(frozen=True, slots=True)
class Conversion:
    """value = (`multiply` x stored + `add`) / 10^d, d from `decimals` (0 without); exact.

    `step` is the smallest increment of the *stored* value, if the device has one (1: it stores whole digits). With
    `places`, a register says how many decimals that value can have: the increment is `step` / 10^d of it.
    """

    multiply: Fraction = Fraction(1)
    add: Fraction = Fraction(0)
    decimals: Decimals | None = None
    step: Fraction | None = None
    places: Decimals | None = None


IDENTITY = Conversion()


@dataclass(frozen=True, slots=True)
class Number:
    """A limit that is a number, in the unit of the value."""

    value: Fraction


@dataclass(frozen=True, slots=True)
class Reference:
    """A limit that is the present value of another register."""

    register: str


@dataclass(frozen=True, slots=True)
class Open:
    """A limit that the manual names but does not give: nothing is checked against it."""

    text: str


Limit = Number | Reference | Open


@dataclass(frozen=True, slots=True)
class Interval:
    """From `low` to `high`, both included."""

    low: Limit
    high: Limit


@dataclass(frozen=True, slots=True)
class Range:
    """A union of intervals; number limits are divided by 10^d of `decimals`, if there is one."""

    intervals: tuple[Interval, ...]
    decimals: Decimals | None = None


@dataclass(frozen=True, slots=True)
class Special:
    """A value with a meaning of its own, allowed beside the range: 0 = off.

    `code` is the value as the range counts: where `range_decimals` divide the range, they divide it too. `means` is the
    number it stands for, if it stands for one (0 = 0.2 s).
    """

    code: Fraction
    label: str
    id: str
    means: Fraction | None = None

    @property
    def value(self) -> Fraction:
        """The number that it stands for, or else its code, which decimals of the range still divide."""
        return self.code if self.means is None else self.means


class NotANumber(Enumeration):
    """Any IEEE 754 pattern that is no number, as what a device sends in place of a value."""

    NAN = "nan"


NAN = NotANumber.NAN


@dataclass(frozen=True, slots=True)
class Sentinel:
    """A stored number that is a fault and no value: -32768 = sensor low; `NAN`: no number at all.

    It counts before any scale, and whatever the kind of the register: for bits, as the number that the type spells.
    """

    stored: Fraction | NotANumber
    label: str
    id: str

    @property
    def spelled(self) -> str:
        """The stored number as decimal text, or `nan`."""
        return self.stored.value if isinstance(self.stored, NotANumber) else show(self.stored)


@dataclass(frozen=True, slots=True)
class Member:
    """One code of an enum; `id` is its Python name in capitals, `cells` what the enum's columns say of it."""

    code: int
    label: str
    id: str
    description: str = ""
    cells: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Enum:
    """Codes with meanings, as one model has them; `invalid` lists codes that the manual calls invalid, with why.

    `id` is the map's name; models whose members differ have enums of the same id with different members.
    `columns` are the heads of the manual's table, where it says several things of each code.
    """

    id: str
    members: tuple[Member, ...]
    invalid: tuple[tuple[int, str], ...] = ()
    description: str = ""
    span: Span = NOWHERE
    columns: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class BitField:
    """Bits `low` to `high` (0 is the least significant) of a word: one flag, a number or an enum.

    `follows`: the device sets a flag where this holds, and clears it where not (None: it does neither by itself).
    """

    id: str
    label: str
    low: int
    high: int
    enum: Enum | None = None
    description: str = ""
    follows: Condition | None = None

    @property
    def width(self) -> int:
        """How many bits."""
        return self.high - self.low + 1

    @property
    def is_flag(self) -> bool:
        """Whether it is one bit with no enum."""
        return self.width == 1 and self.enum is None


Units = Cases[str]
"""Engineering unit symbols by condition; an empty symbol: no unit."""
