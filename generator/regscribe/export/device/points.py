"""A register as a poller of one device sees it: an address, a type, an order, a scale, all worked out for one state."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from regscribe.emit.words import condition_words, one_line
from regscribe.export.device.facts import KINDS, Carries, Carry
from regscribe.export.device.numbers import places
from regscribe.model import (
    IDENTITY,
    BitField,
    Cases,
    Interval,
    Kind,
    Limit,
    Member,
    Number,
    Open,
    Order,
    Range,
    Register,
    Sentinel,
    Space,
    Special,
    View,
    WireType,
)
from regscribe.reference import RefusedError, Surroundings, UnknownValueError, holds, limits, special_value
from regscribe.reference.limits import Limits
from regscribe.reference.surroundings import choose, decimal_factor
from regscribe.reference.terms import amount, present_view, straight
from regscribe.reference.words import AS_IS, Arrangement, carried, word_order


class LeftOutError(Exception):
    """A form cannot say a register; the message says why."""


class Wire(NamedTuple):
    """How a number stands on the wire: the space, its type, the order of its words and that of their bytes.

    `words` is an order, or the place of each word; `apart`: other words stand between.
    """

    space: Space
    type: WireType
    words: Order | tuple[int, ...] = Order.BIG
    bytes: Order | tuple[int, ...] = Order.BIG
    apart: bool = False


class Fault(NamedTuple):
    """Numbers on the wire, from `low` to `high`, that report a fault and no value; `low` is None for an IEEE NaN."""

    low: Number | None
    high: Number | None
    id: str
    label: str


class SpecialNumber(NamedTuple):
    """A special value: the number on the wire, the value of use, what it is called, and its id.

    `code` is that number in the unit, which is no value where it stands for another one.
    """

    wire: Number
    value: Fraction
    label: str
    code: Fraction
    id: str


Fits = Callable[[Wire], bool]
"""Whether a form can read what stands on the wire so."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """A register of one device in one state: value = `slope` x number on the wire + `offset`.

    `address` is that on the wire, from 0, of the first of `words` registers (or bits); `view` is the one that is read,
    as the map has it. `limits` are the ends of what may be written, in the unit (None: not stated); `members`,
    `fields`, `sentinels` those that there are in this state, `faults` the sentinels as they stand on the wire of the
    view, as far as it can carry them, `special_numbers` the `specials` likewise. `ranges` are the intervals that
    `limits` are the ends of (an end is None where nothing limits), `valid` those that a reading must lie in; None: they
    are not known as things stand. `write` is the address for writes; None: it cannot be
    written, or in another form only (`written_otherwise`).
    """

    register: Register
    view: View
    wire: Wire
    address: int
    words: int
    slope: Fraction = Fraction(1)
    offset: Fraction = Fraction(0)
    unit: str = ""
    limits: tuple[Fraction, Fraction] | None = None
    ranges: Limits | None = ()
    valid: Limits | None = ()
    members: tuple[Member, ...] = ()
    fields: tuple[BitField, ...] = ()
    sentinels: tuple[Sentinel, ...] = ()
    faults: tuple[Fault, ...] = ()
    specials: tuple[Special, ...] = ()
    special_numbers: tuple[SpecialNumber, ...] = ()
    write: int | None = None
    written_otherwise: bool = False

    @property
    def path(self) -> str:
        """Its path in the model: `segments[1].ramp_time`."""
        return self.register.path

    @property
    def id(self) -> str:
        """The path in letters, digits and underscores: `segments_1_ramp_time`."""
        return self.path.replace("[", "_").replace("]", "").replace(".", "_")

    @property
    def is_scaled(self) -> bool:
        """Whether the value is not the number on the wire."""
        return self.slope != 1 or self.offset != 0

    @property
    def is_truth(self) -> bool:
        """Whether it is on or off: a bit, or a word that says true or false."""
        return self.wire.space.is_bits or self.register.kind is Kind.BOOLEAN

    @property
    def decimals(self) -> int | None:
        """How many decimals a value has at most; None for floats, and where a value may have no finite decimal."""
        if self.wire.type.is_float:
            return None
        return places(self.slope, self.offset)


def point_of(register: Register, known: Surroundings, carries: Carries, fits: Fits) -> Point:
    """Work out a register for the state `known`. Raises LeftOutError."""
    _refuse_kind(register, carries)
    with _needs("whether it exists"):
        said = carries.get("condition", Carry.FIXED) in {Carry.WHOLE, Carry.PARTLY}
        if not said and not holds(register.when, known):
            message = f"it exists only while {one_line(condition_words(register.when))}"
            raise LeftOutError(message)
    view, wire = _read(register, known, fits)
    with _needs("its scale"):
        slope, offset = _line(register, view, known)
    with _needs("its unit"):
        unit = choose(register.unit, known) or ""
    with _needs("its codes, parts or faults"):
        members = tuple(one for one in _members(register, known) if holds(one.when, known))
        fields = tuple(one for one in register.fields if holds(one.when, known))
        sentinels = _sentinels(register, known)
    with _needs("its special values"):
        special_numbers = _special_numbers(register, view, known, slope, offset)
    write = _write(register, view)
    return Point(
        register=register,
        view=view,
        wire=wire,
        address=view.address(register.at),
        words=view.words,
        slope=slope,
        offset=offset,
        unit=unit,
        limits=_limits(register, known),
        ranges=_intervals(register.range, known, None if register.range else ()),
        valid=_intervals(register.valid, known),
        members=members,
        fields=fields,
        sentinels=sentinels,
        faults=_faults(present_view(view, known) or view, sentinels),
        specials=register.specials,
        special_numbers=special_numbers,
        write=write,
        written_otherwise=register.access.writable and write is None,
    )


@contextmanager
def _needs(what: str) -> Iterator[None]:
    """Turn the error of a value that is not known into a LeftOutError that says what depends on it."""
    try:
        yield
    except UnknownValueError as unknown:
        message = f"{what} depends on {unknown}, which has no default: say it by --with or --given"
        raise LeftOutError(message) from None


def _refuse_kind(register: Register, carries: Carries) -> None:
    fact = KINDS.get(register.kind)
    if fact and carries.get(fact, Carry.NO) is Carry.NO and not (fact == "boolean" and register.base.space.is_bits):
        message = f"it is a {register.kind}, which the format does not have"
        raise LeftOutError(message)
    if not register.access.readable and carries.get("write-only", Carry.NO) is Carry.NO:
        message = "it is write only, which the format does not have"
        raise LeftOutError(message)
    if register.page and carries.get("page", Carry.NO) is Carry.NO:
        message = "it stands on a page or at another unit id, which the format cannot select"
        raise LeftOutError(message)


def _read(register: Register, known: Surroundings, fits: Fits) -> tuple[View, Wire]:
    """Return the view to read, the one that drivers prefer or else the first that fits, as it stands on the wire."""
    views = dict.fromkeys((register.read_view, *register.views))
    usable = [one for one in views if one.readable] or [register.write_view]
    tried: list[Wire] = []
    for view in usable:
        with _needs("its order"):
            order = word_order(view, known) if view.space.is_words else AS_IS
        with _needs("its scale"):
            present = present_view(view, known)
        if order is not None and present is not None:
            tried.append(Wire(view.space, view.type, *_plain(order, view), apart=view.is_apart))
            if fits(tried[-1]):
                return view, tried[-1]
    if not tried:
        message = "its order or its factor has no value as the device is stated"
        raise LeftOutError(message)
    message = f"the format does not read {_words(tried[0])}"
    raise LeftOutError(message)


def _plain(order: Arrangement, view: View) -> Arrangement:
    """The order, as a word where places say no more than that."""
    places = {tuple(range(1, view.words + 1)): Order.BIG, tuple(range(view.words, 0, -1)): Order.LITTLE}
    words = order.words if isinstance(order.words, Order) else places.get(order.words, order.words)
    return Arrangement(words, order.bytes)


def _words(wire: Wire) -> str:
    turned = "" if wire.words is Order.BIG else " with the least significant word first"
    turned = turned if isinstance(wire.words, Order) else f" with its words at {wire.words}"
    swapped = " and the bytes of a word swapped" if wire.bytes is not Order.BIG else ""
    return f"{wire.type.value} in the {wire.space.value} space{turned}{swapped}"


def _line(register: Register, view: View, known: Surroundings) -> tuple[Fraction, Fraction]:
    """Return factor and summand that turn the number on the wire into the value of use."""
    if register.kind in {Kind.FLAGS, Kind.FIELDS}:
        return Fraction(1), Fraction(0)  # a pattern of bits is no number
    line = straight(choose(register.scale, known) if register.scale else IDENTITY, known)
    if line is None:
        message = "no scale is stated for this state of the device"
        raise LeftOutError(message)
    seen = present_view(view, known) or view
    return line.slope / Fraction(seen.factor), line.offset


def _members(register: Register, known: Surroundings) -> tuple[Member, ...]:
    if register.enum is None:
        return ()
    enum = choose(register.enum.cases, known) if register.enum.cases else register.enum
    return enum.members if enum else ()


def _sentinels(register: Register, known: Surroundings) -> tuple[Sentinel, ...]:
    when = next((one.when for one in register.sentinels if holds(one.when, known)), None)
    return tuple(one for one in register.sentinels if one.when == when)


def _faults(view: View, sentinels: Sequence[Sentinel]) -> tuple[Fault, ...]:
    """Return the fault words as numbers on the wire; one that the view cannot carry is never seen there."""
    found = []
    for one in sentinels:
        if one.ends is None:
            found.append(Fault(None, None, one.id, one.label))
            continue
        ends = [carried(view, Fraction(end * view.factor)) for end in one.ends]
        known = [end for end in ends if end is not None]
        if len(known) == len(ends):
            found.append(Fault(min(known), max(known), one.id, one.label))
    return tuple(found)


def _special_numbers(
    register: Register, view: View, known: Surroundings, slope: Fraction, offset: Fraction
) -> tuple[SpecialNumber, ...]:
    """Return the special values as they stand on the wire; one that the view cannot carry is never seen there."""
    found = []
    for one in register.specials:
        code = special_value(register, one, known)
        if code is None:
            message = "its special values have no number as the device is stated"
            raise LeftOutError(message)
        number = carried(view, (code - offset) / slope)
        if number is not None:
            found.append(SpecialNumber(number, code if one.means is None else one.means, one.label, code, one.id))
    return tuple(found)


def _intervals(cases: Cases[Range], known: Surroundings, otherwise: Limits | None = ()) -> Limits | None:
    """Return the intervals that hold in this state (`otherwise` where no case holds); None where they are not known."""
    try:
        chosen = choose(cases, known)
        return otherwise if chosen is None else limits(chosen, known)
    except (UnknownValueError, RefusedError):
        return None


def _limits(register: Register, known: Surroundings) -> tuple[Fraction, Fraction] | None:
    """Return the lowest and the highest value that may be written; None where they are not known as things stand."""
    try:
        chosen = choose(register.range, known)
        if chosen is None:
            return None
        factor = decimal_factor(chosen.decimals, known)
        ends = [_ends(interval, known, factor) for interval in chosen.intervals]
    except UnknownValueError:
        return None
    known_ends = [end for end in ends if end is not None]
    if len(known_ends) < len(ends) or not ends:
        return None
    return min(low for low, _ in known_ends), max(high for _, high in known_ends)


def _ends(interval: Interval, known: Surroundings, factor: Fraction | None) -> tuple[Fraction, Fraction] | None:
    if factor is None or isinstance(interval.low, Open) or isinstance(interval.high, Open):
        return None
    low, high = amount(interval.low, known), amount(interval.high, known)
    if low is None or high is None:
        return None
    return low / _divisor(interval.low, factor), high / _divisor(interval.high, factor)


def _divisor(limit: Limit, factor: Fraction) -> Fraction:
    """Only limits that are plain numbers are divided by the decimals of the range."""
    return factor if isinstance(limit, Number) else Fraction(1)


def _write(register: Register, view: View) -> int | None:
    """The address for writes, where they have the form of what is read."""
    if not register.access.writable:
        return None
    to = register.write_view
    alike = to._replace(name="", offset=0, functions=(), preferred=False, region=None, align=1)
    return (
        to.address(register.at)
        if alike == view._replace(name="", offset=0, functions=(), preferred=False, region=None, align=1)
        else None
    )
