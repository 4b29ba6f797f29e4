"""Views: the ways to transmit a value, and the order of their words."""

from collections.abc import Sequence
from typing import Any, NamedTuple, Protocol

from regscribe_runtime.values.conditions import Cases, Condition, registers_of
from regscribe_runtime.values.facts import ReadFacts
from regscribe_runtime.values.kinds import Access
from regscribe_runtime.values.numbers import Number
from regscribe_runtime.values.orders import OrderCases, WordOrder, orders_of
from regscribe_runtime.values.scales import Conversion, Range, Sentinel
from regscribe_runtime.values.terms import Term, registers_in
from regscribe_runtime.values.wire_types import WRITE_AND_READ, Order, Rounding, Space, WireType

ONE_BYTE = frozenset({WireType.UINT8, WireType.INT8})


class View(NamedTuple):
    """One way to transmit a value.

    wire address = `offset` + `stride` x at, `at` of its register; `words` are from there on. wire number = stored value
    x `factor` (and x `times`, a term that the device sets), rounded by `rounding`; with `saturates`, clipped to the
    limits of `type`. `functions` are the function codes that may address the view (empty: whatever the device
    supports); `align` is what an address and a count where the view stands must be multiples of; `region` the first and
    last address that the view set gives to this view.
    """

    name: str
    type: WireType
    offset: int = 0
    stride: int = 1
    words: int = 1
    factor: Number = 1
    rounding: Rounding = Rounding.NONE
    saturates: bool = False
    order: WordOrder | OrderCases = Order.BIG
    byte_order: WordOrder | OrderCases = Order.BIG
    functions: tuple[int, ...] = ()
    space: Space = Space.HOLDING
    preferred: bool = False
    align: int = 1
    region: tuple[int, int] | None = None
    times: Term | None = None

    def address(self, at: int) -> int:
        """The wire address of the first word for a register at `at`."""
        return self.offset + self.stride * at

    def last(self, at: int) -> int:
        """The wire address of the last word for a register at `at`."""
        return self.address(at) + self.words - 1

    def allows(self, function: int) -> bool:
        """Whether a function code may address it."""
        return not self.functions or function in self.functions

    @property
    def offsets(self) -> Sequence[int]:
        """Where its words stand, counted from the first address: next to each other, or some of `words` only."""
        order = orders_of(self.order)[0]
        if isinstance(order, Order) or len(order) == self.words:
            return range(self.words)
        return sorted(place - 1 for place in order)

    @property
    def is_apart(self) -> bool:
        """Whether other things stand between its words."""
        return len(self.offsets) < self.words

    @property
    def is_byte(self) -> bool:
        """Whether the value is one byte of a word: the high one where the byte order is little."""
        return self.type in ONE_BYTE and self.space.is_words

    @property
    def readable(self) -> bool:
        """Whether the read function of its space may address it, or the one that selects its page as well."""
        return self.allows(self.space.read_function) or self.is_read_behind_write

    @property
    def is_read_behind_write(self) -> bool:
        """Whether it is read by function 23, which writes what selects its page in the same request."""
        return WRITE_AND_READ in self.functions and not self.allows(self.space.read_function)

    @property
    def writable(self) -> bool:
        """Whether a write function of its space may address it, all words of a value at once."""
        single, several = self.space.write_functions or (0, 0)
        return self.allows(several) or (self.words == self.space.each and self.allows(single))

    def needs(self) -> tuple[str, ...]:
        """The registers that set the orders of words and bytes and the factor, if any do."""
        if isinstance(self.order, Order) and isinstance(self.byte_order, Order) and self.times is None:
            return ()
        orders = (one for one in (self.order, self.byte_order) if isinstance(one, OrderCases))
        found = [name for one in orders for name in registers_of(one.cases)]
        return tuple(dict.fromkeys((*found, *(registers_in(self.times) if self.times is not None else ()))))


def word(view_type: WireType, **more: Any) -> tuple[View, ...]:
    """The single base view of a plain register."""
    return (View("base", view_type, words=view_type.words, **more),)


class Placed(Protocol):
    """A register as planning sees it: one of a driver or of the compiler's model."""

    @property
    def path(self) -> str: ...  # noqa: D102 (a field)
    @property
    def at(self) -> int: ...  # noqa: D102
    @property
    def views(self) -> tuple[View, ...]: ...  # noqa: D102
    @property
    def aliases(self) -> tuple[int, ...]: ...  # noqa: D102
    @property
    def access(self) -> Access: ...  # noqa: D102
    @property
    def reading(self) -> ReadFacts: ...  # noqa: D102


class Scaled(Protocol):
    """The views, scales and range of a register, which decode its words and limit its writes."""

    @property
    def views(self) -> tuple[View, ...]: ...  # noqa: D102 (a field)
    @property
    def scale(self) -> Cases[Conversion]: ...  # noqa: D102
    @property
    def special_scale(self) -> Cases[Conversion]: ...  # noqa: D102
    @property
    def range(self) -> Cases[Range]: ...  # noqa: D102
    @property
    def when(self) -> Condition: ...  # noqa: D102
    @property
    def valid(self) -> Cases[Range]: ...  # noqa: D102
    @property
    def sentinels(self) -> tuple[Sentinel, ...]: ...  # noqa: D102
    @property
    def partial(self) -> Cases[str]: ...  # noqa: D102


class Readable(Placed, Scaled, Protocol):
    """A register that can be planned and decoded."""

    @property
    def static(self) -> bool: ...  # noqa: D102 (a field)


def preferred(views: tuple[View, ...]) -> View:
    """The view that drivers use by default."""
    return next((view for view in views if view.preferred), views[0])


def read_view(register: Placed) -> View:
    """The view that drivers read: the preferred one, or else the first that a read function may address."""
    wanted = preferred(register.views)
    return wanted if wanted.readable else next((view for view in register.views if view.readable), wanted)


def scale_needs(register: Scaled) -> tuple[str, ...]:
    """Registers that select or contain the scale, or that of special values."""
    cases = (*register.scale, *register.special_scale)
    if not cases:
        return ()
    found = [*registers_of(cases), *(case.then.decimals.register for case in cases if case.then.decimals)]
    numbers = [number for case in cases for number in (case.then.multiply, case.then.add)]
    terms = [number for number in numbers if isinstance(number, tuple)]  # nearly all are plain numbers
    return tuple(dict.fromkeys((*found, *registers_in(*terms))))


def needs(register: Scaled, view: View) -> tuple[str, ...]:
    """Registers that must be known to decode `view`: first those that tell whether the register exists."""
    faults = [name for one in register.sentinels for name in one.when.registers] if register.sentinels else ()
    others = (*scale_needs(register), *faults, *_range_needs(register.valid), *registers_of(register.partial))
    return tuple(dict.fromkeys((*register.when.registers, *view.needs(), *others)))


def is_lasting(register: Readable) -> bool:
    """Whether its value, once read, holds for the connection: it never changes, and its meaning depends on nothing."""
    return register.static and not needs(register, read_view(register))


def limit_needs(register: Scaled) -> tuple[str, ...]:
    """Registers that select, scale or contain the limits of a write."""
    found = [case.then.places.register for case in register.scale if case.then.places]
    return tuple(dict.fromkeys((*_range_needs(register.range), *_range_needs(register.valid), *found)))


def _range_needs(cases: Cases[Range]) -> list[str]:
    found = list(registers_of(cases))
    for _, limits in cases:
        found += [limits.decimals.register] if limits.decimals else []
        found += registers_in(limits.intervals)
    return found
