"""Numbers that follow from several registers of a device: a sum, a difference, a product."""

from collections.abc import Awaitable
from typing import Generic, Self, TypeVar, overload

from regscribe_runtime.driver.parts import AsyncPart, Part
from regscribe_runtime.operations import tasks
from regscribe_runtime.values.terms import Term

P = TypeVar("P", bound=Part | AsyncPart)


class _Bound(Generic[P]):
    __slots__ = ("_part", "computed")

    def __init__(self, computed: "Computed", part: P) -> None:
        self.computed, self._part = computed, part


class ComputedValue(_Bound[Part]):
    """A computed number of a synchronous driver."""

    __slots__ = ()

    def read(self) -> float:
        """Read the registers in one snapshot and compute; NotDecodable if one of them has no value that counts."""
        return self._part.run(tasks.compute(self.computed.id, self.computed.term))


class AsyncComputedValue(_Bound[AsyncPart]):
    """A computed number of an asyncio driver."""

    __slots__ = ()

    def read(self) -> Awaitable[float]:
        """As `ComputedValue.read`, awaitable."""
        return self._part.run(tasks.compute(self.computed.id, self.computed.term))


class Computed:
    """A number that follows from registers, in engineering units; `unit` is its own."""

    def __init__(self, term: Term, *, unit: str = "") -> None:
        self.term, self.unit, self.id = term, unit, ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.id = name

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
