"""The parts of a driver: the device itself, its array elements, commands and groups, for both kinds of I/O."""

from collections.abc import Awaitable, Callable, Iterator, Mapping
from functools import cache
from itertools import chain
from types import MappingProxyType
from typing import Any, Generic, ParamSpec, Self, TypeVar, overload

from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.snapshot import Snapshot
from regscribe_runtime.registers.element import filled
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.blocks import Slip
from regscribe_runtime.values.conditions import ALWAYS, Condition
from regscribe_runtime.values.facts import CommandStep

T = TypeVar("T")
P = TypeVar("P", bound="Part")
A = TypeVar("A", bound="AsyncPart")
S = ParamSpec("S")
B = TypeVar("B", bound="Part | AsyncPart")
D = TypeVar("D")


class Catalogue:
    """A class attribute: every register of a part by path, array elements included.

    They stand in the order of the driver's groups; without groups, in that of declaration. In a `whole` device
    references to the same element of an array are resolved.
    """

    def __init__(self, *, whole: bool = False) -> None:
        self.whole = whole

    def __get__(self, instance: object, owner: type) -> Mapping[str, Register[Any]]:
        return _catalogue(owner, whole=self.whole)


@cache
def _catalogue(owner: type, *, whole: bool) -> Mapping[str, Register[Any]]:
    members = [member for group in groups_of(owner).values() for member in group.members]
    ranks = {member: rank for rank, member in reversed(list(enumerate(members)))}
    found = sorted(_registers(owner), key=lambda one: ranks.get(one[0].partition("[")[0], len(members)))
    return MappingProxyType({path: register.closed() if whole else register for path, register in found})


def _registers(owner: type) -> Iterator[tuple[str, Register[Any]]]:
    members = _declared(owner, Register, Array)
    packed = {name: _span(one) for name, one in members.items() if isinstance(one, Array) and one.packed}
    for name, declared in members.items():
        inside = [(name, declared)] if isinstance(declared, Register) else _elements(name, declared)
        for path, register in inside:
            before = tuple(slip for other, (end, slip) in packed.items() if other != name and register.at >= end)
            if before:
                register = register.moved(0, path)  # noqa: PLW2901 (a copy, since models share declarations)
                register.slips += before
            yield path, register


def _elements(name: str, array: "Array[Any, Any]") -> Iterator[tuple[str, Register[Any]]]:
    inside = list(_registers(array.element))
    begin = min((register.at for _, register in inside), default=0)
    inner = [_span(one)[1] for one in _declared(array.element, Array).values() if one.packed]
    for place, index in enumerate(range(array.first, array.first + array.count)):
        for path, register in inside:
            there = f"{name}[{index}].{path}"
            moved = register.moved(place * array.stride, there)
            if array.to_end and not inner:
                moved.reach = begin + (place + 1) * array.stride
            if array.counted:
                moved.counted(array.counted, place + 1)
            moved.slips += tuple(slip._replace(words=place * slip.words) for slip in inner if place)
            yield there, moved


def _span(array: "Array[Any, Any]") -> tuple[int, Slip]:
    """The first address behind a packed array with all its elements, and what it leaves free with fewer."""
    begin = min(register.at for _, register in _registers(array.element))
    return begin + array.count * array.stride, Slip(array.counted, array.stride, array.count)


@cache
def groups_of(owner: type) -> Mapping[str, "Group"]:
    """The groups of a driver's class by id, in the order of the manual."""
    return MappingProxyType(_declared(getattr(owner, "groups", object), Group))


@cache
def _members_of(owner: type) -> Mapping[str, list[Register[Any]]]:
    """The readable registers of a driver's class by the id of the register, or of its array."""
    found: dict[str, list[Register[Any]]] = {}
    registers: Mapping[str, Register[Any]] = getattr(owner, "registers", {})
    for path, register in registers.items():
        if register.is_read_along:
            found.setdefault(path.partition("[")[0], []).append(register)
    return found


def _declared(owner: type, *kinds: type) -> dict[str, Any]:
    attributes = chain.from_iterable(vars(base).items() for base in reversed(owner.__mro__))
    return {name: value for name, value in attributes if isinstance(value, kinds)}


class _AnyPart(Generic[B]):
    registers = Catalogue()
    _prefix = ""

    def __init__(self, device: B, prefix: str = "") -> None:
        self._device, self._prefix = device, prefix

    def placed(self) -> dict[str, Register[Any]]:
        """The readable registers of this part as they stand in the device, by their ids here."""
        return {
            path: self._in_device(path, register)
            for path, register in type(self).registers.items()
            if register.is_read_along
        }

    def _in_device(self, path: str, register: Register[T]) -> Register[T]:
        return self._device.registers[f"{self._prefix}.{path}"] if self._prefix else register


class Part(_AnyPart["Part"]):
    """A part of a synchronous driver: the device, an array element, its commands."""

    def bind(self, register: Register[T], sync: Any, _: object) -> Any:
        """Make a register an attribute of this part."""
        return sync(self._in_device(register.id, register), self)

    def run(self, task: tasks.Task[T]) -> T:
        """Run an operation on the device."""
        return self._device.run(task)

    def read(self) -> Snapshot:
        """Read all registers of this part in few requests; the snapshot is keyed by their ids."""
        return self.run(tasks.read_part(self.placed()))


class AsyncPart(_AnyPart["AsyncPart"]):
    """As `Part`, for asyncio."""

    def bind(self, register: Register[T], _: object, awaitable: Any) -> Any:
        """Make a register an attribute of this part."""
        return awaitable(self._in_device(register.id, register), self)

    def run(self, task: tasks.Task[T]) -> Awaitable[T]:
        """Run an operation on the device."""
        return self._device.run(task)

    def read(self) -> Awaitable[Snapshot]:
        """As `Part.read`, awaitable."""
        return self.run(tasks.read_part(self.placed()))


class Elements(Generic[T]):
    """The elements of an array, by the manual's numbers; `most` is how many there may be.

    Where the device tells how many there are, `len` and iteration ask it; an element beyond them raises NotPresent when
    it is used.
    """

    def __init__(self, make: Any, first: int, most: int, present: Callable[[], Any] | None = None) -> None:
        self._make, self.first, self.most, self._present = make, first, most, present

    def __getitem__(self, index: int) -> T:
        if not self.first <= index < self.first + self.most:
            message = f"no element {index}: they run from {self.first} to {self.first + self.most - 1}"
            raise IndexError(message)
        element: T = self._make(index)
        return element

    def __iter__(self) -> Iterator[T]:
        return map(self.__getitem__, range(self.first, self.first + len(self)))

    def __len__(self) -> int:
        return self.most if self._present is None else int(self._present())


class AsyncElements(Elements[T]):
    """As `Elements`, for asyncio; where the device tells how many there are, `await .count()` in place of `len`."""

    def __len__(self) -> int:
        if self._present is None:
            return self.most
        message = "how many elements there are is read from the device: await .count()"
        raise TypeError(message)

    async def count(self) -> int:
        """How many elements the device has."""
        return self.most if self._present is None else int(await self._present())


class Array(Generic[P, A]):
    """A repeated structure: `count` elements, numbered from `first` as in the manual, `stride` steps apart.

    `to_end`: there are as many as fit into what the block has left, `count` at most; `counted`: as many as this
    register (or `given.id`) says, `count` at most. `packed`: what stands behind moves up by each that a device lacks.
    """

    def __init__(
        self,
        element: type[P],
        awaitable: type[A],
        *,
        first: int,
        count: int,
        stride: int,
        to_end: bool = False,
        counted: str = "",
        packed: bool = False,
    ) -> None:
        self.element, self.awaitable = element, awaitable
        self.first, self.count, self.stride, self.to_end = first, count, stride, to_end
        self.counted, self.packed = counted, packed
        self.id = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.id = name

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> Elements[P]: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> AsyncElements[A]: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Self | Elements[P] | AsyncElements[A]:
        if instance is None:
            return self
        make: Any = self.element if isinstance(instance, Part) else self.awaitable
        inside = f"{instance._prefix}." if instance._prefix else ""  # noqa: SLF001 (parts are one family)

        def element(index: int) -> Any:
            return make(instance._device, f"{inside}{self.id}[{index}]")  # noqa: SLF001 (as above)

        def present() -> Any:
            if self.counted:
                here = filled(self.counted, instance._prefix)  # noqa: SLF001 (as above)
                return instance.run(tasks.count_stated(here, self.count))
            heads = (f"{inside}{self.id}[{index}]." for index in range(self.first, self.first + self.count))
            registers = instance._device.registers  # noqa: SLF001 (as above)
            every = [next(one for path, one in registers.items() if path.startswith(head)) for head in heads]
            return instance.run(tasks.count_present(every))

        kind: Any = Elements if isinstance(instance, Part) else AsyncElements
        asks = present if self.to_end or self.counted else None
        found: Elements[P] | AsyncElements[A] = kind(element, self.first, self.count, asks)
        return found


class Bound(Generic[D, B]):
    """Something declared, as an attribute of a part."""

    __slots__ = ("_part", "declared")

    def __init__(self, declared: D, part: B) -> None:
        self.declared, self._part = declared, part


class _BoundCommand(Bound["Command", Part]):
    __slots__ = ()

    def __call__(self, *, confirm: bool = False) -> None:
        """Send the command; `confirm` is needed for a dangerous one (ValueRefused otherwise)."""
        self._part.run(tasks.run(self.declared, confirm=confirm))


class _AsyncBoundCommand(Bound["Command", AsyncPart]):
    __slots__ = ()

    def __call__(self, *, confirm: bool = False) -> Awaitable[None]:
        """Send the command; `confirm` is needed for a dangerous one (ValueRefused otherwise)."""
        return self._part.run(tasks.run(self.declared, confirm=confirm))


class AnyCommand:
    """Requests that make the device act, one after the other; `arguments` are declarations of what a program gives.

    It exists only while `when` holds.
    """

    def __init__(
        self,
        *steps: CommandStep,
        danger: str = "",
        arguments: Mapping[str, Register[Any]] = MappingProxyType({}),
        when: Condition = ALWAYS,
    ) -> None:
        self.steps, self.danger, self.arguments, self.when, self.id = steps, danger, arguments, when, ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.id = name
        for argument, register in self.arguments.items():
            register.id = register.path = f"{name}.{argument}"


class CommandWith(AnyCommand, Generic[S]):
    """A command with arguments, which a program gives by name; `takes` has their types."""

    def __init__(self, takes: Callable[S, None], *steps: CommandStep, **more: Any) -> None:
        super().__init__(*steps, **more)
        self.takes = takes

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> Callable[S, None]: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> Callable[S, Awaitable[None]]: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Any:
        if instance is None:
            return self

        def call(*, confirm: bool = False, **values: object) -> Any:
            return instance.run(tasks.run(self, confirm=confirm, values=values))

        return call


class Command(AnyCommand):
    """A command without arguments."""

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> _BoundCommand: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> _AsyncBoundCommand: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Self | _BoundCommand | _AsyncBoundCommand:
        if instance is None:
            return self
        return _BoundCommand(self, instance) if isinstance(instance, Part) else _AsyncBoundCommand(self, instance)


class SubPart(Generic[P, A]):
    """A named part of a device without address: its commands."""

    def __init__(self, part: type[P], awaitable: type[A]) -> None:
        self.part, self.awaitable = part, awaitable

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> P: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> A: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Self | P | A:
        if instance is None:
            return self
        make: Any = self.part if isinstance(instance, Part) else self.awaitable
        part: P | A = make(instance._device)  # noqa: SLF001 (parts are one family)
        return part

    def commands(self) -> dict[str, AnyCommand]:
        """The commands declared here, by id."""
        return _declared(self.part, AnyCommand)


class Group:
    """A named, ordered set of registers and arrays; an array stands for all registers of its elements.

    Members are found by id, so that a model's own register of that id takes the place of the declared one. `order` is
    the group's position when a whole configuration is written (None: the manual gives none).
    """

    def __init__(self, name: str, *members: Register[Any] | Array[Any, Any], order: int | None = None) -> None:
        self.name, self.order = name, order
        self.members = tuple(member.id for member in members)
        self.id = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.id = name

    def registers(self, owner: type) -> list[Register[Any]]:
        """The readable registers of this group that the driver class of a model has."""
        present = _members_of(owner)
        return [register for member in self.members for register in present.get(member, ())]
