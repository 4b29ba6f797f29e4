"""What single codes mean: special values, the members of enums and bit fields."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.model.diagnostic import NOWHERE, Span
from regscribe_runtime.values.conditions import Cases, Condition
from regscribe_runtime.values.scales import Sentinel


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
    `columns` are the heads of the manual's table, where it says several things of each code; `other` is what it calls
    all codes that it does not list.
    """

    id: str
    members: tuple[Member, ...]
    invalid: tuple[tuple[int, str], ...] = ()
    description: str = ""
    span: Span = NOWHERE
    columns: tuple[str, ...] = ()
    other: str = ""


@dataclass(frozen=True, slots=True)
class BitField:
    """Bits `low` to `high` (0 is the least significant) of a word: one flag, a number or an enum.

    The number of a part is `multiply` times that in its bits (in two's complement if `signed`), and `add`; `range` is
    what may be written, `sentinels` numbers in the bits that report faults.
    `follows`: the device sets a flag where this holds, and clears it where not (None: it does neither by itself).
    """

    id: str
    label: str
    low: int
    high: int
    enum: Enum | None = None
    description: str = ""
    follows: Condition | None = None
    signed: bool = False
    multiply: Fraction = Fraction(1)
    add: Fraction = Fraction(0)
    unit: str = ""
    range: tuple[Fraction, Fraction] | None = None
    sentinels: tuple[Sentinel, ...] = ()

    @property
    def is_scaled(self) -> bool:
        """Whether its number is not just that of its bits."""
        return self.signed or self.multiply != 1 or self.add != 0

    @property
    def is_number(self) -> bool:
        """Whether more is said of its number than the bits."""
        return self.is_scaled or self.range is not None or bool(self.sentinels)

    @property
    def width(self) -> int:
        """How many bits."""
        return self.high - self.low + 1

    @property
    def is_flag(self) -> bool:
        """Whether it is one bit with no enum."""
        return self.width == 1 and self.enum is None and not self.is_number


Units = Cases[str]
"""Engineering unit symbols by condition; an empty symbol: no unit."""
