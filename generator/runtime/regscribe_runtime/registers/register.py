"""The declaration of a register: where it stands, what its words mean, when it may be written."""

from collections.abc import Sequence
from functools import cached_property
from typing import Generic, Never, Self, TypeVar, cast

from regscribe_runtime.errors import ValueRefused
from regscribe_runtime.registers import codec, element
from regscribe_runtime.registers.octets import OctetType
from regscribe_runtime.registers.presence import absence
from regscribe_runtime.registers.value_types import ValueType
from regscribe_runtime.values.blocks import Slip
from regscribe_runtime.values.conditions import ALWAYS, Cases, Condition, Givens, State, always, at_least
from regscribe_runtime.values.facts import PLAIN_READING, Governs, ReadFacts, WriteCondition
from regscribe_runtime.values.kinds import Access
from regscribe_runtime.values.numbers import Number
from regscribe_runtime.values.scales import SAME, Conversion, Range, Sentinel
from regscribe_runtime.values.views import View, limit_needs, needs

T = TypeVar("T")
SPEAKING = (
    "views",
    "scale",
    "special_scale",
    "range",
    "valid",
    "sentinels",
    "partial",
    "unit",
    "writable",
    "when",
    "default_cases",
)
"""The attributes of a register that may refer to other registers."""
NOWHERE = -(1 << 20)
"""The base of a block that was not found: no request can be made to such an address."""


class Register(Generic[T]):
    """The declaration of a register: its address, what its words mean and when it may be written.

    `at` is the n of its views' address formulas. `special_scale` divides the codes of special values, as the range's
    decimals divide its limits; `valid` is what a reading must lie in. `partial` names flags and parts that exist only
    in some case, and enums by their place in the type (`0`, one member `0.AUTO`). `default` is the manual's, in
    engineering units (`default_cases` where it differs by case). `unit` is an engineering unit, or cases of them.
    `stays` is why the value must not be copied to another device (address, line, calibration, identity, counter,
    operation, momentary; "": it may be), `governs` what it sets of the serial line, `settle` the milliseconds after a
    write in which reading back is not reliable; `rescales` names the unit whose values the device converts. It exists
    only while `when` holds; `reading` is how it wants to be read. `static`: it never changes by itself; `mandatory`:
    whether each device of the model has it (None: the manual does not say).

    In a `block` addresses count from its base, which is not known (`origin` is None) before it is `located`;
    `reach` is the first address behind its element in an array that goes to the end of the block, else 0. `slips` are
    the packed arrays in front of it.

    `decode` and `encode` need no device: `state` holds the values of the registers in `needs`.
    """

    access = Access.READ

    def __init__(  # noqa: PLR0913 (a register has this many properties; all but three are keywords)
        self,
        at: int,
        views: tuple[View, ...],
        value_type: ValueType[T],
        *,
        scale: Cases[Conversion] = SAME,
        special_scale: Cases[Conversion] = SAME,
        range: Cases[Range] = (),  # noqa: A002 (the manuals' own word)
        valid: Cases[Range] = (),
        default: float | str | None = None,
        default_cases: Cases[Number | str] = (),
        unit: str | Cases[str] = "",
        section: str = "",
        sentinels: tuple[Sentinel, ...] = (),
        partial: Cases[str] = (),
        aliases: tuple[int, ...] = (),
        writable: WriteCondition | None = None,
        persistence: str = "",
        unlock: str = "",
        apply: str = "",
        danger: str = "",
        stays: str = "",
        governs: Governs | None = None,
        settle: int = 0,
        rescales: str = "",
        when: Condition = ALWAYS,
        reading: ReadFacts = PLAIN_READING,
        static: bool = False,
        mandatory: bool | None = None,
        block: str = "",
    ) -> None:
        self.at, self.views, self.value_type, self.kind = at, views, value_type, value_type.kind
        self.scale, self.range, self.valid, self.sentinels = scale, range, valid, sentinels
        self.special_scale, self.partial = special_scale, partial
        spelled = isinstance(value_type, OctetType) and isinstance(default, str)
        self.default: T | float | str | None = value_type.parse(default) if spelled else default  # type: ignore[attr-defined] # of octets
        self.default_cases, self.section, self.aliases = default_cases, section, aliases
        self.unit: Cases[str] = always(unit) if isinstance(unit, str) else unit
        self.writable, self.persistence = writable, persistence
        self.unlock, self.apply, self.danger = unlock, apply, danger
        self.stays, self.governs, self.settle, self.rescales = stays, governs, settle, rescales
        self.when, self.reading, self.static, self.mandatory = when, reading, static, mandatory
        self.block, self.reach = block, 0
        self.slips: tuple[Slip, ...] = ()
        self.origin: int | None = None if block else 0
        self.id = self.path = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.id = self.path = name

    def __set__(self, instance: object, value: Never) -> None:
        message = f"{self.path} is a register: use .write(...) to change it"
        raise AttributeError(message)

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.path} at {self.at}: {self.kind}>"

    def _copy(self) -> Self:
        # copy.copy goes through the protocol of pickle, which takes five times as long
        other = object.__new__(type(self))
        other.__dict__ = self.__dict__.copy()
        return other

    @cached_property
    def is_open(self) -> bool:
        """Whether it refers to others in the same element of an array."""
        return any(element.is_open(getattr(self, name)) for name in SPEAKING)

    def moved(self, steps: int, path: str) -> Self:
        """The same register of another array element: `steps` further on, at this path."""
        _ = self.is_open  # cached before the copy is made, so that all elements share it
        other = self._copy()
        other.at, other.path, other.reach = self.at + steps, path, self.reach and self.reach + steps
        stride = self.views[0].stride
        other.aliases = tuple(alias + steps * stride for alias in self.aliases)
        return other

    def counted(self, subject: str, least: int) -> None:
        """Let it exist only while a register, or `given.id`, is `least` or more: an element of so many."""
        self.when = Condition((at_least(subject, least), *self.when.tests))
        self.is_open = element.is_open(self.when) or self.is_open

    def located(self, base: int | None) -> Self:
        """The same register of a block at its address on a device where the block begins at `base`; None: nowhere."""
        other = self._copy()
        steps = NOWHERE if base is None else base
        other.origin, other.at, other.reach = base, self.at + steps, self.reach and self.reach + steps
        other.aliases = tuple(alias + steps for alias in self.aliases)
        return other

    def placed(self, base: int, counts: State) -> Self:
        """As `located`, on a device with these counts of elements in packed arrays; nowhere if one is not known."""
        if not all(slip.counter in counts for slip in self.slips):
            return self.located(None)
        moved = self.located(base)
        steps = sum(slip.steps(int(counts[slip.counter])) for slip in self.slips)
        moved.at += steps
        moved.aliases = tuple(alias + steps for alias in moved.aliases)
        return moved

    @property
    def counters(self) -> tuple[str, ...]:
        """The registers that tell where it stands in its block."""
        return tuple(dict.fromkeys(slip.counter for slip in self.slips))

    @property
    def end(self) -> int:
        """The first address that its block need not have."""
        return max(self.reach, *(view.last(self.at) + 1 for view in self.views), 0)

    def closed(self) -> Self:
        """The same register with references to the same element resolved by its path."""
        if not self.is_open:
            return self
        other = self._copy()
        for name in SPEAKING:
            setattr(other, name, element.closed(getattr(self, name), self.path))
        other.is_open = False
        return other

    @property
    def is_configuration(self) -> bool:
        """Whether it is a setting that the device keeps: no operation, no counter, not in RAM alone."""
        passing = self.persistence == "ram" or self.stays in {"operation", "counter", "momentary"}
        return self.can_be_checked and not passing

    @property
    def can_be_checked(self) -> bool:
        """Whether it can be read back after a write, without harm."""
        return self.access is Access.READ_WRITE and not self.reading.clears

    @property
    def is_read_along(self) -> bool:
        """Whether it is read with its group or with everything; if not, where it is asked for by name."""
        return self.access.readable and not self.reading.clears

    @property
    def view_names(self) -> tuple[str, ...]:
        """The names of the views, the base view first."""
        return tuple(view.name for view in self.views)

    def view(self, name: str | None = None) -> View:
        """The view of that name; without one, the view to prefer. ValueError for an unknown name."""
        for view in self.views:
            if view.name == name or (name is None and view.preferred):
                return view
        if name is None:
            return self.views[0]
        message = f"{self.path} has no view {name!r}; it has {', '.join(self.view_names)}"
        raise ValueError(message)

    def read_view(self, name: str | None = None) -> View:
        """The view of that name, or without one the preferred view, or the first that can be read.

        ValueError for an unknown name, and for a view that cannot be read.
        """
        view = self.view(name)
        return view if view.readable else self._other_view(name, [one for one in self.views if one.readable], "read")

    def write_view(self, name: str | None = None) -> View:
        """As `read_view`, of the view to write."""
        view = self.view(name)
        return view if view.writable else self._other_view(name, [one for one in self.views if one.writable], "written")

    def _other_view(self, name: str | None, able: Sequence[View], verb: str) -> View:
        if name is None and able:
            return able[0]
        view = self.view(name)
        message = (
            f"the {view.name} view of {self.path} cannot be {verb} (it is by functions {list(view.functions)}); "
            f"{', '.join(one.name for one in able) or 'none'} can"
        )
        raise ValueError(message)

    def seen_in(self, view: View) -> View:
        """The view in which what was written in `view` is read back."""
        return view if view.readable else self.read_view()

    def needs(self, view: View) -> tuple[str, ...]:
        """Registers whose values the meaning of `view` depends on."""
        return needs(self, view)

    @property
    def limit_needs(self) -> tuple[str, ...]:
        """Registers that decide or are limits of a write."""
        return limit_needs(self)

    def check_present(self, state: State, givens: Givens) -> None:
        """Raise NotPresent if the register does not exist in this state."""
        gone = absence(self.path, self.when, state, givens)
        if gone:
            raise gone

    def decode(
        self, words: Sequence[int], *, view: str | None = None, state: State | None = None, givens: Givens | None = None
    ) -> T:
        """The value of `words` in `view`; raises ValueNotDecodable (its subclasses say more) or NotPresent."""
        chosen = self.view(view) if view else self.read_view()
        self.check_present(state or {}, givens or {})
        return cast("T", codec.decode(self, chosen, words, state or {}, givens or {}))

    def encode(
        self,
        value: T,
        *,
        view: str | None = None,
        state: State | None = None,
        givens: Givens | None = None,
        rounded: bool = False,
    ) -> tuple[int, ...]:
        """The words of `value` in `view`; raises ValueRefused for what must not or cannot be written."""
        if not self.access.writable:
            raise ValueRefused(self.path, "the register is read-only")
        chosen = self.view(view) if view else self.write_view()
        self.check_present(state or {}, givens or {})
        return codec.encode(self, chosen, value, state or {}, givens or {}, rounded=rounded)
