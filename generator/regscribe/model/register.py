"""Registers, arrays of registers and groups, as one model has them."""

from dataclasses import dataclass, field
from fractions import Fraction

from regscribe.model.diagnostic import NOWHERE, Span
from regscribe.model.enums import BitField, Enum, Special
from regscribe_runtime.values.conditions import ALWAYS, Case, Cases, Condition, always
from regscribe_runtime.values.facts import PLAIN_READING, Governs, ReadFacts, WriteCondition
from regscribe_runtime.values.kinds import Access, Kind
from regscribe_runtime.values.octets import PLAIN_TEXT, TextForm
from regscribe_runtime.values.scales import SAME, Conversion, Range, Sentinel
from regscribe_runtime.values.terms import Term
from regscribe_runtime.values.views import View, preferred, read_view

UNITLESS = always("")


@dataclass(frozen=True, slots=True)
class Inferred:
    """Something the manual does not say outright: what was concluded and why."""

    what: str
    why: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Register:
    """One logical parameter of one model, whatever the number of its views.

    `id` is its Python name inside its owner, `path` its name in the model (`segments[3].soak_level`).
    `at` is the n of its views' address formulas; `views[0]` is the base view; `aliases` are further addresses that
    transmit the base view.
    `scale` goes from the stored value to the value of use, `special_scale` from the code of a special value to its
    value of use (the decimals that divide the range); `default` is a value of use: a number (an enum's code, a word's
    bits), a text or version, or None where the manual gives none, or gives `default_cases` instead; `delivered` (or
    `delivered_cases`) is what a new device holds instead.
    `valid` is what a reading must lie in. `section` is where the manual describes it. It exists only while `when`
    holds.
    `rescales` names the unit (of the map's units) whose registers the device converts when this one is written.
    `unlock` and `apply` name commands that must precede and follow a write.
    `stays` is why the value must not be copied to another device (`address`, `line`, `calibration`, `identity`,
    `counter`, `operation`, `momentary`; empty: it may be). `settle` is in milliseconds: before that, a read-back
    says nothing.
    `reading` is how it wants to be read. `static`: it never changes by itself. `mandatory`: whether each device of the
    model has it (None: the map does not say).
    `page` is the number of the page that it stands on (0: on none).
    `shadows` is the register from which it takes its value when power comes, `rereads` the one whose words it has,
    `follows` by case the register whose value it always has (none holding: its own). `difference`: it counts a distance
    in its unit, whose zero point does not matter, as a proportional band does.
    `symbol` is a clean reading of the manual's short code, `printed` the code as it is printed (empty: the same).
    `version_digits` is how many decimal digits a `VERSION` packs, `version_groups` how many digits stand in a group.
    In a `block` addresses count from its base, which each device tells.
    `none` is what the manual calls a word of flags in which none is set.
    `text` is the form of a text, `layout` that of a date or a time.
    `rules` are the names of the map's view set and scale or decimals rule, by key (`views`, `scale`); drivers use them.
    """

    id: str
    path: str
    name: str
    kind: Kind
    access: Access
    at: int
    views: tuple[View, ...]
    symbol: str = ""
    description: str = ""
    section: str = ""
    group: str = ""
    aliases: tuple[int, ...] = ()
    scale: Cases[Conversion] = SAME
    unit: Cases[str] = UNITLESS
    unit_id: str = ""
    range: Cases[Range] = ()
    valid: Cases[Range] = ()
    specials: tuple[Special, ...] = ()
    special_scale: Cases[Conversion] = SAME
    sentinels: tuple[Sentinel, ...] = ()
    default: Fraction | str | None = None
    delivered: Fraction | str | None = None
    default_cases: Cases[Fraction | str] = ()
    delivered_cases: Cases[Fraction | str] = ()
    enum: Enum | None = None
    fields: tuple[BitField, ...] = ()
    none: str = ""
    writable: WriteCondition | None = None
    when: Condition = ALWAYS
    persistence: str = ""
    endurance: int | None = None
    rescales: str = ""
    unlock: str = ""
    apply: str = ""
    danger: str = ""
    stays: str = ""
    governs: Governs | None = None
    settle: int = 0
    page: int = 0
    reading: ReadFacts = PLAIN_READING
    static: bool = False
    mandatory: bool | None = None
    shadows: str = ""
    rereads: str = ""
    follows: Cases[str] = ()
    difference: bool = False
    inferred: tuple[Inferred, ...] = ()
    text: TextForm = PLAIN_TEXT
    layout: str = ""
    version_digits: int = 0
    version_group: int = 0
    array: str = ""
    index: tuple[int, ...] = ()
    printed: str = ""
    block: str = ""
    rules: tuple[tuple[str, str], ...] = field(default=(), compare=False)
    span: Span = NOWHERE

    @property
    def base(self) -> View:
        """The view whose address the manual's table prints."""
        return self.views[0]

    @property
    def address(self) -> int:
        """The wire address of the base view."""
        return self.base.address(self.at)

    @property
    def preferred(self) -> View:
        """The view that drivers use unless told otherwise."""
        return preferred(self.views)

    @property
    def read_view(self) -> View:
        """The view that drivers read: that to prefer, if its functions let it be read."""
        return read_view(self)

    @property
    def write_view(self) -> View:
        """The view that drivers write."""
        writable = [view for view in self.views if view.writable]
        return self.preferred if self.preferred in writable or not writable else writable[0]

    @property
    def is_written_apart(self) -> bool:
        """Whether it is read in the base view only and written in another one only."""
        return len(self.views) > 1 and not self.base.writable and not any(view.readable for view in self.views[1:])

    @property
    def is_read_along(self) -> bool:
        """Whether it is read with its group or with everything; if not, where it is asked for by name."""
        return self.access.readable and not self.reading.clears

    @property
    def beginnings(self) -> tuple[tuple[str, Fraction | str], ...]:
        """The default and the delivered value, as far as the map says them, each with what it is."""
        both = (
            ("default", self.default, self.default_cases),
            ("delivered value", self.delivered, self.delivered_cases),
        )
        every = ((what, value) for what, one, cases in both for value in (one, *(case.then for case in cases)))
        return tuple((what, value) for what, value in every if value is not None)

    @property
    def faults(self) -> tuple[Fraction, ...]:
        """The stored numbers that are faults in any case: of intervals both ends; without that which is no number."""
        ends = [Fraction(end) for one in self.sentinels for end in one.ends or ()]
        return tuple(dict.fromkeys(ends))

    def is_fault(self, stored: object) -> bool:
        """Whether a stored number is a fault in any case."""
        return any(one.reports(stored) for one in self.sentinels)

    @property
    def partial(self) -> Cases[str]:
        """What of its value exists only in a case: enums by their places, members behind these, flags, parts."""
        found = []
        if self.enum:
            places = {one: place for place, one in enumerate(self.enum.each)}
            found += [Case(case.when, str(places[case.then])) for case in self.enum.cases]
            members = ((place, member) for one, place in places.items() for member in one.members)
            found += [Case(one.when, f"{place}.{one.id}") for place, one in members if not one.when.always]
        names = ((one.when, one.id.upper() if self.kind is Kind.FLAGS else one.id) for one in self.fields)
        return (*found, *(Case(when, name) for when, name in names if not when.always))

    @property
    def fractional(self) -> bool:
        """Whether a value may have a fraction: a number, or a float whose scale the manual does not state."""
        return self.kind is Kind.NUMBER or (self.kind is Kind.RAW and any(view.type.is_float for view in self.views))

    @property
    def bits(self) -> int:
        """Width of the base view in bits."""
        return self.base.type.bits if self.base.type.is_integer else 16 * self.base.words

    @property
    def named_bits(self) -> int:
        """The bits of the value that belong to a field."""
        return sum(((1 << bits.width) - 1) << bits.low for bits in self.fields)


@dataclass(frozen=True, slots=True, kw_only=True)
class Array:
    """A repeated structure: element i stands `stride` steps after element i-1, from `first` on, `count` of them.

    `members` are the registers (and arrays) of the *first* element; what one of them refers to in its own element has
    empty brackets in place of the index (`channels[].decimals`), as it differs from element to element. A step is one
    unit of a register's `at`, which a view may stretch (an IEEE view moves by 2 a step: `View.stride`). `to_end`: a
    device has as many as fit into the rest of the block, `count` at most; `counted`: as many as this register or
    `given.id` says, `count` at most, so that element i - `first` + 1 exists while it is that at least. `packed`: what
    stands behind moves up by each that a device lacks.
    """

    id: str
    name: str
    first: int
    count: int
    stride: int
    members: tuple["Register | Array", ...]
    description: str = ""
    section: str = ""
    to_end: bool = False
    counted: str = ""
    packed: bool = False
    span: Span = NOWHERE


@dataclass(frozen=True, slots=True, kw_only=True)
class Group:
    """A named, ordered set of registers: `members` are paths, in the order in which they should be written.

    `order` is the group's place in the map's write order (None: it has none).
    """

    id: str
    name: str
    members: tuple[str, ...]
    description: str = ""
    section: str = ""
    order: int | None = None
    span: Span = NOWHERE


@dataclass(frozen=True, slots=True, kw_only=True)
class Computed:
    """A number that follows from registers of one snapshot: `term` over their values in engineering units.

    It exists only while `when` holds, and is a value only within `valid`.
    """

    id: str
    name: str
    term: Term
    unit: str = ""
    valid: Cases[Range] = ()
    when: Condition = ALWAYS
    description: str = ""
    section: str = ""
    span: Span = NOWHERE
