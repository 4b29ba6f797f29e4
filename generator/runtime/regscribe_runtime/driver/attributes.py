"""Registers as attributes of a driver: the verbs read, write and change, synchronous and awaitable."""

from collections.abc import Awaitable, Callable
from typing import Generic, TypedDict, TypeVar, Unpack

from regscribe_runtime.driver.parts import AsyncPart, Part
from regscribe_runtime.operations import tasks
from regscribe_runtime.registers.register import Register

T = TypeVar("T")


class WriteOptions(TypedDict, total=False):
    """How to write.

    `view` chooses another view than the preferred one. `rounded` allows a value finer than the device can hold.
    `confirm` is needed where the map calls the write dangerous. `verify` reads the value back (or not); without it,
    what the device keeps as its configuration is read back, and passing operation is not.
    """

    view: str | None
    rounded: bool
    confirm: bool
    verify: bool | None


class _Bound(Generic[T]):
    __slots__ = ("_part", "register")

    def __init__(self, register: Register[T], part: Part) -> None:
        self.register = register
        self._part = part

    def __repr__(self) -> str:
        return f"<{self.register.path} of {self._part!r}>"


class Readable(_Bound[T]):
    """A register of a synchronous driver that can be read."""

    __slots__ = ()

    def read(self, *, view: str | None = None) -> T:
        """Read the value of use; `view` chooses another view than the preferred one.

        What its meaning depends on (decimals, word order) is read once and remembered until it is written through this
        driver. `device.read(register)` reads it along instead: for when others configure the device as well.

        Raises SensorFault, Saturated or NotDecodable for words that are no value, NoAnswer, ExceptionAnswer,
        WrongAnswer or LinkLost for what happens on the line.
        """
        return self._part.run(tasks.read(self.register, view))

    def read_raw(self, *, view: str | None = None) -> tuple[int, ...]:
        """Read the words as they stand on the wire."""
        return self._part.run(tasks.read_raw(self.register, view))

    def read_unit(self) -> str:
        """The engineering unit as the device is configured now ("" where it has none)."""
        return self._part.run(tasks.read_unit(self.register))


class WritableAttribute(_Bound[T]):
    """A register of a synchronous driver that can be written."""

    __slots__ = ()

    def write(self, value: T, **how: Unpack[WriteOptions]) -> None:
        """Write a value of use, after checking condition, range and resolution; `how`: see `WriteOptions`.

        What the device keeps as its configuration is read back. A lost answer is answered by reading back, never by
        sending again. Raises ValueRefused before anything is sent, ExceptionAnswer if the device refuses, and
        WriteFailed (NotWritten, WriteUnknown, ReadBackDiffers, NotApplied, LeftAt) for all that may come after.
        """
        self._part.run(tasks.write(self.register, value, **how))

    def write_raw(self, words: tuple[int, ...], *, view: str | None = None) -> None:
        """Write words as they are; nothing is checked but their number and the answer (a lost one as in `write`)."""
        self._part.run(tasks.write_raw(self.register, words, view))


class ReadWritable(Readable[T], WritableAttribute[T]):
    """A register of a synchronous driver that can be read and written."""

    __slots__ = ()

    def change(self, how: Callable[[T], T], *, confirm: bool = False, verify: bool | None = None) -> T:
        """Read, modify by `how`, write; returns what was written. For the fields of a word, which only go together.

        These are a read and a write, not one step of the device: what the device or another master changes in between
        is overwritten. Nothing else of this driver comes in between. Raises what `read` and `write` raise.
        """
        return self._part.run(tasks.change(self.register, how, confirm=confirm, verify=verify))


class _AsyncBound(Generic[T]):
    __slots__ = ("_part", "register")

    def __init__(self, register: Register[T], part: AsyncPart) -> None:
        self.register = register
        self._part = part

    def __repr__(self) -> str:
        return f"<{self.register.path} of {self._part!r}>"


class AsyncReadable(_AsyncBound[T]):
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


class AsyncWritable(_AsyncBound[T]):
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
