"""Registers as drivers declare them: one descriptor that serves synchronous and asynchronous drivers."""

from typing import Self, TypeVar, cast, overload

from regscribe_runtime.driver.attributes import (
    AsyncReadable,
    AsyncReadWritable,
    AsyncWritable,
    Readable,
    ReadWritable,
    Writable,
)
from regscribe_runtime.driver.parts import AsyncPart, Part
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.kinds import Access

T = TypeVar("T")


class ReadOnly(Register[T]):
    """A register that can only be read."""

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> Readable[T]: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> AsyncReadable[T]: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Self | Readable[T] | AsyncReadable[T]:
        if instance is None:
            return self
        return cast("Readable[T]", instance.bind(self, Readable, AsyncReadable))


class ReadWrite(Register[T]):
    """A register that can be read and written."""

    access = Access.READ_WRITE

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> ReadWritable[T]: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> AsyncReadWritable[T]: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Self | ReadWritable[T] | AsyncReadWritable[T]:
        if instance is None:
            return self
        return cast("ReadWritable[T]", instance.bind(self, ReadWritable, AsyncReadWritable))


class WriteOnly(Register[T]):
    """A register that can only be written."""

    access = Access.WRITE

    @overload
    def __get__(self, instance: None, owner: type) -> Self: ...
    @overload
    def __get__(self, instance: Part, owner: type) -> Writable[T]: ...
    @overload
    def __get__(self, instance: AsyncPart, owner: type) -> AsyncWritable[T]: ...
    def __get__(self, instance: Part | AsyncPart | None, owner: type) -> Self | Writable[T] | AsyncWritable[T]:
        if instance is None:
            return self
        return cast("Writable[T]", instance.bind(self, Writable, AsyncWritable))
