"""Registers as attributes of a driver: the verbs read, write and change, synchronous and awaitable."""

from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, Generic, TypeVar

from regscribe.runtime import operations

if TYPE_CHECKING:
    from regscribe.runtime.parts import AsyncPart, Part
    from regscribe.runtime.register import Register

T = TypeVar("T")


class _Bound(Generic[T]):
    __slots__ = ("_part", "register")

    def __init__(self, register: "Register[T]", part: "Part") -> None:
        self.register = register
        self._part = part

    def __repr__(self) -> str:
        return f"<{self.register.path} of {self._part!r}>"


class Readable(_Bound[T]):
    """A register of a synchronous driver that can be read."""

    __slots__ = ()

    def read(self, *, view: str | None = None) -> T:
        """Read the value of use; `view` chooses another view than the preferred one.

        Raises SensorFault, Saturated or NotDecodable for words that are no value, NoAnswer, ExceptionAnswer,
        WrongAnswer or LinkLost for what happens on the line.
        """
        return self._part.run(operations.read(self.register, view))

    def read_raw(self, *, view: str | None = None) -> tuple[int, ...]:
        """Read the words as they stand on the wire."""
        return self._part.run(operations.read_raw(self.register, view))

    def read_unit(self) -> str:
        """The engineering unit as the device is configured now ("" where it has none)."""
        return self._part.run(operations.read_unit(self.register))


class Writable(_Bound[T]):
    """A register of a synchronous driver that can be written."""

    __slots__ = ()

    def write(self, value: T, *, view: str | None = None, rounded: bool = False, confirm: bool = False) -> None:
        """Write a value of use, after checking condition, range and resolution; the answer is verified.

        `rounded` allows a value finer than the device can hold; `confirm` is needed where the map calls a write
        dangerous. Raises ValueRefused before anything is sent, and what `read` raises for the line.
        """
        self._part.run(operations.write(self.register, value, view=view, rounded=rounded, confirm=confirm))

    def write_raw(self, words: tuple[int, ...], *, view: str | None = None) -> None:
        """Write words as they are; nothing is checked but their number and the answer."""
        self._part.run(operations.write_raw(self.register, words, view))


class ReadWritable(Readable[T], Writable[T]):
    """A register of a synchronous driver that can be read and written."""

    __slots__ = ()

    def change(self, how: Callable[[T], T], *, confirm: bool = False) -> T:
        """Read, modify by `how`, write; returns what was written. For bit fields; the device may change in between."""
        return self._part.run(operations.change(self.register, how, confirm=confirm))


class _AsyncBound(Generic[T]):
    __slots__ = ("_part", "register")

    def __init__(self, register: "Register[T]", part: "AsyncPart") -> None:
        self.register = register
        self._part = part

    def __repr__(self) -> str:
        return f"<{self.register.path} of {self._part!r}>"


class AsyncReadable(_AsyncBound[T]):
    """A register of an asyncio driver that can be read."""

    __slots__ = ()

    def read(self, *, view: str | None = None) -> Awaitable[T]:
        """As `Readable.read`, awaitable."""
        return self._part.run(operations.read(self.register, view))

    def read_raw(self, *, view: str | None = None) -> Awaitable[tuple[int, ...]]:
        """As `Readable.read_raw`, awaitable."""
        return self._part.run(operations.read_raw(self.register, view))

    def read_unit(self) -> Awaitable[str]:
        """As `Readable.read_unit`, awaitable."""
        return self._part.run(operations.read_unit(self.register))


class AsyncWritable(_AsyncBound[T]):
    """A register of an asyncio driver that can be written."""

    __slots__ = ()

    def write(
        self, value: T, *, view: str | None = None, rounded: bool = False, confirm: bool = False
    ) -> Awaitable[None]:
        """As `Writable.write`, awaitable."""
        return self._part.run(operations.write(self.register, value, view=view, rounded=rounded, confirm=confirm))

    def write_raw(self, words: tuple[int, ...], *, view: str | None = None) -> Awaitable[None]:
        """As `Writable.write_raw`, awaitable."""
        return self._part.run(operations.write_raw(self.register, words, view))


class AsyncReadWritable(AsyncReadable[T], AsyncWritable[T]):
    """A register of an asyncio driver that can be read and written."""

    __slots__ = ()

    def change(self, how: Callable[[T], T], *, confirm: bool = False) -> Awaitable[T]:
        """As `ReadWritable.change`, awaitable."""
        return self._part.run(operations.change(self.register, how, confirm=confirm))
