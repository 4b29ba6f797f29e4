"""Numbers that follow from several registers of a device: a sum, a difference, a product."""

from collections.abc import Awaitable
from typing import Self, overload

from regscribe_runtime.driver.parts import AsyncPart, Bound, Part
from regscribe_runtime.operations import tasks
from regscribe_runtime.values.conditions import ALWAYS, Cases, Condition
from regscribe_runtime.values.scales import Range
from regscribe_runtime.values.terms import Term, registers_in


class ComputedValue(Bound["Computed", Part]):
    """A computed number of a synchronous driver."""

    __slots__ = ()

    def read(self) -> float:
        """Read the registers in one snapshot and compute.

        NotDecodable if one of them has no value that counts, OutOfRange for a number outside what is valid, NotPresent
        while it does not exist.
        """
        return self._part.run(tasks.compute(self.declared))


class AsyncComputedValue(Bound["Computed", AsyncPart]):
    """A computed number of an asyncio driver."""

    __slots__ = ()

    def read(self) -> Awaitable[float]:
        """As `ComputedValue.read`, awaitable."""
        return self._part.run(tasks.compute(self.declared))


class Computed:
    """A number that follows from registers, in engineering units; `unit` is its own.

    It exists only while `when` holds, and is a value only within `valid`.
    """

    def __init__(self, term: Term, *, unit: str = "", valid: Cases[Range] = (), when: Condition = ALWAYS) -> None:
        self.term, self.unit, self.valid, self.when, self.path = term, unit, valid, when, ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.path = name

    @property
    def needs(self) -> tuple[str, ...]:
        """The paths of the registers that it follows from, with those of its conditions."""
        return registers_in(self.term, self.valid, self.when)

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> ComputedValue: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> AsyncComputedValue: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Self | ComputedValue | AsyncComputedValue:
        if instance is None:
            return self
        return ComputedValue(self, instance) if isinstance(instance, Part) else AsyncComputedValue(self, instance)
