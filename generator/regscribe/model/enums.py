"""What single codes mean: special values, the members of enums and bit fields."""

from dataclasses import dataclass
from fractions import Fraction

from regscribe.model.diagnostic import NOWHERE, Span
from regscribe_runtime.values.conditions import ALWAYS, Cases, Condition
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
    """One code of an enum; `id` is its Python name in capitals, `cells` what the enum's columns say of it.

    It exists only while `when` holds.
    """

    code: int
    label: str
    id: str
    description: str = ""
    cells: tuple[str, ...] = ()
    when: Condition = ALWAYS


@dataclass(frozen=True, slots=True)
class Enum:
    """Codes with meanings, as one model has them; `invalid` lists codes that the manual calls invalid, with why.

    `id` is the map's name; models whose members differ have enums of the same id with different members.
    `columns` are the heads of the manual's table, where it says several things of each code; `other` is what it calls
    all codes that it does not list. Where the codes mean other things in other `cases`, `members` are those of all
    cases, each while its case is the first that holds.
    """

    id: str
    members: tuple[Member, ...]
    invalid: tuple[tuple[int, str], ...] = ()
    description: str = ""
    span: Span = NOWHERE
    columns: tuple[str, ...] = ()
    other: str = ""
    cases: "Cases[Enum]" = ()

    @property
    def each(self) -> "tuple[Enum, ...]":
        """The enums of its cases; itself where it has none."""
        return tuple(dict.fromkeys(case.then for case in self.cases)) or (self,)

    @property
    def codes(self) -> dict[str, int]:
        """The code of each id, in small letters, that has one code only."""
        found: dict[str, set[int]] = {}
        for member in self.members:
            found.setdefault(member.id.lower(), set()).add(member.code)
        return {name: min(codes) for name, codes in found.items() if len(codes) == 1}

    @property
    def labels(self) -> dict[int, str]:
        """The label of each code, those of several cases joined."""
        found: dict[int, dict[str, None]] = {}
        for member in self.members:
            found.setdefault(member.code, {})[member.label] = None
        return {code: " / ".join(labels) for code, labels in found.items()}


@dataclass(frozen=True, slots=True)
class BitField:
    """Bits `low` to `high` (0 is the least significant) of a word: one flag, a number or an enum.

    The number of a part is `multiply` times that in its bits (in two's complement if `signed`), and `add`; `range` is
    what may be written, `valid` what a reading must lie in, `sentinels` numbers in the bits that report faults. It
    exists only while `when` holds. `follows`: the device sets a flag where this holds, and clears it where not (None:
    it does neither by itself).
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
    valid: tuple[Fraction, Fraction] | None = None
    sentinels: tuple[Sentinel, ...] = ()
    when: Condition = ALWAYS

    @property
    def is_scaled(self) -> bool:
        """Whether its number is not just that of its bits."""
        return self.signed or self.multiply != 1 or self.add != 0

    @property
    def is_number(self) -> bool:
        """Whether more is said of its number than the bits."""
        return self.is_scaled or bool(self.range or self.valid or self.sentinels)

    def reads(self, value: Fraction) -> bool:
        """Whether a number of the part is a value, and not one that it never has while all is well."""
        return self.valid is None or self.valid[0] <= value <= self.valid[1]

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
