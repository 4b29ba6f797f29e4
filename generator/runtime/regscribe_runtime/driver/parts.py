"""The parts of a driver: the device itself, its array elements, commands and groups, for both kinds of I/O."""

from collections.abc import Awaitable, Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, ClassVar, Generic, Protocol, Self, TypeVar, overload

from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.snapshot import Snapshot
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.facts import CommandStep

T = TypeVar("T")
P = TypeVar("P", bound="Part")
A = TypeVar("A", bound="AsyncPart")


class Catalogue:
    """A class attribute: every register of a part by path, array elements included.

    They stand in the order of the manual, which is that of a driver's groups; without groups, in that of declaration.
    In a `whole` device each path is complete, so that "the same element" of an array has a meaning.
    """

    def __init__(self, *, whole: bool = False) -> None:
        self.whole = whole

    def __get__(self, instance: object, owner: type) -> Mapping[str, Register[Any]]:
        cached: Mapping[str, Register[Any]] | None = vars(owner).get("_catalogue")
        if cached is None:
            found = sorted(_registers(owner), key=_place(owner))
            cached = MappingProxyType({path: register.closed() if self.whole else register for path, register in found})
            owner._catalogue = cached  # type: ignore[attr-defined] # noqa: SLF001 (its own cache)
        return cached


class Runner(Protocol):
    """What a part asks of the synchronous device that it belongs to."""

    registers: ClassVar[Catalogue]

    def run(self, task: tasks.Task[T]) -> T:
        """Run an operation on the device."""
        raise NotImplementedError

    def read_part(self, part: "Part") -> Snapshot:
        """Read all registers of a part."""
        raise NotImplementedError


class AsyncRunner(Protocol):
    """As `Runner`, for asyncio."""

    registers: ClassVar[Catalogue]

    async def run(self, task: tasks.Task[T]) -> T:
        """Run an operation on the device."""
        raise NotImplementedError

    async def read_part(self, part: "AsyncPart") -> Snapshot:
        """Read all registers of a part."""
        raise NotImplementedError


def _place(owner: type) -> Callable[[tuple[str, object]], int]:
    """What says where in the manual's order a register stands, by its path."""
    groups = getattr(owner, "groups", object)
    members = [member for group in _declared(groups, Group).values() for member in group.members]
    places = {member: place for place, member in reversed(list(enumerate(members)))}
    return lambda found: places.get(found[0].partition("[")[0], len(members))


def _registers(owner: type) -> Iterator[tuple[str, Register[Any]]]:
    for name, declared in _declared(owner, Register, Array).items():
        if isinstance(declared, Register):
            yield name, declared
        elif isinstance(declared, Array):
            inside = list(_registers(declared.element))
            for index in range(declared.first, declared.first + declared.count):
                for path, register in inside:
                    there = f"{name}[{index}].{path}"
                    yield there, register.moved(declared.steps(index), there)


_GROUPS: dict[type, Mapping[str, "Group"]] = {}
_MEMBERS: dict[type, Mapping[str, list[Register[Any]]]] = {}
"""What was asked of classes: worked out once for all drivers of a model."""


def groups_of(owner: type) -> Mapping[str, "Group"]:
    """The groups of a driver's class by id, in the order of the manual."""
    if owner not in _GROUPS:
        _GROUPS[owner] = MappingProxyType(_declared(getattr(owner, "groups", object), Group))
    return _GROUPS[owner]


def _members_of(owner: type) -> Mapping[str, list[Register[Any]]]:
    """The readable registers of a driver's class by what groups call them: a register's id, or that of its array."""
    if owner not in _MEMBERS:
        found: dict[str, list[Register[Any]]] = {}
        every: Mapping[str, Register[Any]] = getattr(owner, "registers", {})
        for path, register in every.items():
            if register.access.readable:
                found.setdefault(path.partition("[")[0], []).append(register)
        _MEMBERS[owner] = found
    return _MEMBERS[owner]


def _declared(owner: type, *kinds: type) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for base in reversed(owner.__mro__):
        found.update({name: value for name, value in vars(base).items() if isinstance(value, kinds)})
    return found


def _here(part: "Part | AsyncPart", register: Register[T]) -> Register[T]:
    """A register as the device has it that this part belongs to."""
    if part._prefix:  # noqa: SLF001 (parts are one family)
        return _everything(part)[f"{part._prefix}.{register.id}"]  # noqa: SLF001 (as above)
    return register


def _placed(part: "Part | AsyncPart") -> dict[str, Register[Any]]:
    every, prefix = _everything(part), part._prefix  # noqa: SLF001 (as above)
    return {
        path: every[f"{prefix}.{path}"] if prefix else register
        for path, register in type(part).registers.items()
        if register.access.readable
    }


def _everything(part: "Part | AsyncPart") -> Mapping[str, Register[Any]]:
    return part._device.registers  # noqa: SLF001 (as above)


class Part:
    """A place of registers in a synchronous driver: the device, an array element, its commands."""

    registers = Catalogue()
    _device: Runner
    _prefix = ""

    def __init__(self, device: Runner, prefix: str = "") -> None:
        self._device, self._prefix = device, prefix

    def bind(self, register: Register[T], sync: Any, _: object) -> Any:
        """Make a register an attribute of this part."""
        return sync(_here(self, register), self)

    def run(self, task: tasks.Task[T]) -> T:
        """Run an operation on the device."""
        return self._device.run(task)

    def read(self) -> Snapshot:
        """Read all registers of this part in few requests; the snapshot is keyed by their ids."""
        return self._device.read_part(self)

    def placed(self) -> dict[str, Register[Any]]:
        """The readable registers of this part as they stand in the device, by their ids here."""
        return _placed(self)


class AsyncPart:
    """As `Part`, for asyncio."""

    registers = Catalogue()
    _device: AsyncRunner
    _prefix = ""

    def __init__(self, device: AsyncRunner, prefix: str = "") -> None:
        self._device, self._prefix = device, prefix

    def bind(self, register: Register[T], _: object, awaitable: Any) -> Any:
        """Make a register an attribute of this part."""
        return awaitable(_here(self, register), self)

    def run(self, task: tasks.Task[T]) -> Awaitable[T]:
        """Run an operation on the device."""
        return self._device.run(task)

    def read(self) -> Awaitable[Snapshot]:
        """As `Part.read`, awaitable."""
        return self._device.read_part(self)

    def placed(self) -> dict[str, Register[Any]]:
        """As `Part.placed`."""
        return _placed(self)


class Elements(Generic[T]):
    """The elements of an array, numbered as the manual does."""

    def __init__(self, make: Any, first: int, count: int) -> None:
        self._make, self.first, self.count = make, first, count

    def __getitem__(self, index: int) -> T:
        if not self.first <= index < self.first + self.count:
            message = f"no element {index}: they run from {self.first} to {self.first + self.count - 1}"
            raise IndexError(message)
        element: T = self._make(index)
        return element

    def __iter__(self) -> Iterator[T]:
        return (self[index] for index in range(self.first, self.first + self.count))

    def __len__(self) -> int:
        return self.count


class Array(Generic[P, A]):
    """A repeated structure: `count` elements, the manual's numbers from `first`, `stride` steps apart."""

    def __init__(self, element: type[P], awaitable: type[A], *, first: int, count: int, stride: int) -> None:
        self.element, self.awaitable = element, awaitable
        self.first, self.count, self.stride = first, count, stride
        self.id = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.id = name

    def steps(self, index: int) -> int:
        """How far element `index` stands behind the first."""
        return (index - self.first) * self.stride

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> Elements[P]: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> Elements[A]: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Self | Elements[P] | Elements[A]:
        if instance is None:
            return self
        make: Any = self.element if isinstance(instance, Part) else self.awaitable
        inside = f"{instance._prefix}." if instance._prefix else ""  # noqa: SLF001 (parts are one family)

        def element(index: int) -> Any:
            return make(instance._device, f"{inside}{self.id}[{index}]")  # noqa: SLF001 (as above)

        return Elements(element, self.first, self.count)


class _BoundCommand:
    __slots__ = ("_part", "command")

    def __init__(self, command: "Command", part: Part) -> None:
        self.command, self._part = command, part

    def __call__(self, *, confirm: bool = False) -> None:
        """Send the command; `confirm` is needed for a dangerous one (ValueRefused otherwise)."""
        self._part.run(tasks.run(self.command, confirm=confirm))


class _AsyncBoundCommand:
    __slots__ = ("_part", "command")

    def __init__(self, command: "Command", part: AsyncPart) -> None:
        self.command, self._part = command, part

    def __call__(self, *, confirm: bool = False) -> Awaitable[None]:
        """Send the command; `confirm` is needed for a dangerous one (ValueRefused otherwise)."""
        return self._part.run(tasks.run(self.command, confirm=confirm))


class Command:
    """Requests that make the device act, one after the other."""

    def __init__(self, *steps: CommandStep, danger: str = "") -> None:
        self.steps, self.danger, self.id = steps, danger, ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.id = name

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
    """A named part of a device without registers of its own address: its commands."""

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
        if isinstance(instance, Part):
            return self.part(instance._device)  # noqa: SLF001 (parts are one family)
        return self.awaitable(instance._device)  # noqa: SLF001 (as above)

    def commands(self) -> dict[str, Command]:
        """The commands declared here, by id."""
        return _declared(self.part, Command)


class Group:
    """A named, ordered set of registers and arrays; an array stands for all that is in it.

    A model whose register of the same id is another one has that in the group. `order` is the group's place when a
    whole configuration is written (None: the manual gives none).
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
