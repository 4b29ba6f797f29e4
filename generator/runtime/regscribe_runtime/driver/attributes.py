"""Registers as attributes of a driver: the verbs read, write and change, synchronous and awaitable."""

from collections.abc import Awaitable, Callable
from typing import Generic, TypedDict, TypeVar, Unpack

from regscribe_runtime.driver.parts import AsyncPart, Part
from regscribe_runtime.operations import tasks
from regscribe_runtime.registers.register import Register

T = TypeVar("T")
P = TypeVar("P", bound=Part | AsyncPart)


class WriteOptions(TypedDict, total=False):
    """Options of a write.

    `view` chooses another view than the preferred one. `rounded` allows a value finer than the device can hold.
    `confirm` is needed for a dangerous write. `verify` tells whether the value is read back; by default settings are.
    """

    view: str | None
    rounded: bool
    confirm: bool
    verify: bool | None


class BoundRegister(Generic[T, P]):
    """A register of a part of a driver."""

    __slots__ = ("_part", "register")

    def __init__(self, register: Register[T], part: P) -> None:
        self.register, self._part = register, part

    def __repr__(self) -> str:
        return f"<{self.register.path} of {self._part!r}>"


class Readable(BoundRegister[T, Part]):
    """A register of a synchronous driver that can be read."""

    __slots__ = ()

    def read(self, *, view: str | None = None) -> T:
        """Read the value; `view` chooses another view than the preferred one.

        Registers that its meaning depends on (decimals, word order) are read once and remembered until they are written
        through this driver. `device.read(register)` reads them every time: for when others configure the device too.

        Raises ValueNotDecodable (SensorFault, Saturated, OutOfRange, NotDecodable) for words that are no value, and
        NoAnswer, ExceptionAnswer, WrongAnswer or LinkLost.
        """
        return self._part.run(tasks.read(self.register, view))

    def read_raw(self, *, view: str | None = None) -> tuple[int, ...]:
        """Read the words in wire order."""
        return self._part.run(tasks.read_raw(self.register, view))

    def read_unit(self) -> str:
        """The engineering unit in the present configuration of the device ("" where it has none)."""
        return self._part.run(tasks.read_unit(self.register))


class Writable(BoundRegister[T, Part]):
    """A register of a synchronous driver that can be written."""

    __slots__ = ()

    def write(self, value: T, **how: Unpack[WriteOptions]) -> None:
        """Check condition, range and resolution of a value, then write it; `how`: see `WriteOptions`.

        After a lost answer the register is read back; a write is never sent again. Raises ValueRefused before anything
        is sent, ExceptionAnswer if the device refuses, and WriteFailed (NotWritten, WriteUnknown, ReadBackDiffers,
        NotApplied, LeftAt) after that.
        """
        self._part.run(tasks.write(self.register, value, **how))

    def write_raw(self, words: tuple[int, ...], *, view: str | None = None) -> None:
        """Write words in wire order; only their number is checked, and the answer as in `write`."""
        self._part.run(tasks.write_raw(self.register, words, view))


class ReadWritable(Readable[T], Writable[T]):
    """A register of a synchronous driver that can be read and written."""

    __slots__ = ()

    def change(self, how: Callable[[T], T], *, confirm: bool = False, verify: bool | None = None) -> T:
        """Read the value, modify it by `how`, write it; returns what was written. For single fields of a word.

        A read and a write are not one step of the device: a change by another master in between is overwritten. Other
        operations of this driver wait. Raises what `read` and `write` raise.
        """
        return self._part.run(tasks.change(self.register, how, confirm=confirm, verify=verify))


class AsyncReadable(BoundRegister[T, AsyncPart]):
    """A register of an asyncio driver that can be read."""

    __slots__ = ()

    def read(self, *, view: str | None = None) -> Awaitable[T]:
        """As `Readable.read`, awaitable."""
        return self._part.run(tasks.read(self.register, view))

    def read_raw(self, *, view: str | None = None) -> Awaitable[tuple[int, ...]]:
        """As `Readable.read_raw`, awaitable."""
        return self._part.run(tasks.read_raw(self.register, view))

    def read_unit(self) -> Awaitable[str]:
        """As `Readable.read_unit`, awaitable."""
        return self._part.run(tasks.read_unit(self.register))


class AsyncWritable(BoundRegister[T, AsyncPart]):
    """A register of an asyncio driver that can be written."""

    __slots__ = ()

    def write(self, value: T, **how: Unpack[WriteOptions]) -> Awaitable[None]:
        """As `Writable.write`, awaitable."""
        return self._part.run(tasks.write(self.register, value, **how))

    def write_raw(self, words: tuple[int, ...], *, view: str | None = None) -> Awaitable[None]:
        """As `Writable.write_raw`, awaitable."""
        return self._part.run(tasks.write_raw(self.register, words, view))


class AsyncReadWritable(AsyncReadable[T], AsyncWritable[T]):
    """A register of an asyncio driver that can be read and written."""

    __slots__ = ()

    def change(self, how: Callable[[T], T], *, confirm: bool = False, verify: bool | None = None) -> Awaitable[T]:
        """As `ReadWritable.change`, awaitable."""
        return self._part.run(tasks.change(self.register, how, confirm=confirm, verify=verify))
