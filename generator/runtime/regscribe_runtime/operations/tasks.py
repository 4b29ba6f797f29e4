"""All operations of a driver: reading, writing, commands, and the functions that concern no register."""

# an annotation of an inner function is evaluated at every call otherwise, which costs a read a hundredth of its time
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from regscribe_runtime.errors import BrokenChain, NotPresent
from regscribe_runtime.operations import read as reads
from regscribe_runtime.operations import write as writes
from regscribe_runtime.operations.compute import compute
from regscribe_runtime.operations.configure import configure
from regscribe_runtime.operations.locate import headers as headers_of
from regscribe_runtime.operations.locate import locate, locating
from regscribe_runtime.operations.read import know, read_many, read_part
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.operations.write_request import run
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.blocks import Header
from regscribe_runtime.values.conditions import GIVEN
from regscribe_runtime.wire.requests import LOOPBACK, READ_STATUS, Request

__all__ = [
    "Task",
    "change",
    "compute",
    "configure",
    "count_present",
    "count_stated",
    "exception_status",
    "headers",
    "loopback",
    "read",
    "read_many",
    "read_part",
    "read_raw",
    "read_unit",
    "run",
    "write",
    "write_raw",
]

read, read_raw, read_unit = locating(reads.read), locating(reads.read_raw), locating(reads.read_unit)
write, write_raw = locating(writes.write, fresh=True), locating(writes.write_raw, fresh=True)
change = locating(writes.change, fresh=True)


def count_present(registers: Sequence[Register[Any]]) -> Task[int]:
    """How many of these registers of one block the device has; BrokenChain if nobody can tell."""

    def task(session: Session) -> Operation[int]:
        gone = yield from locate(session, registers)
        for error in gone.values():
            if isinstance(error, BrokenChain):
                raise error
        return len(registers) - len(gone)

    return task


def count_stated(subject: str, most: int) -> Task[int]:
    """How many elements a register, or `given.id`, says there are, `most` at most; none where it does not exist."""

    def task(session: Session) -> Operation[int]:
        kind, _, name = subject.partition(".")
        if kind == GIVEN and name:
            return min(most, max(0, int(session.givens[name])))
        try:
            state = yield from know(session, [subject], fresh=True)
        except NotPresent:
            return 0
        return min(most, max(0, int(state[subject])))

    return task


def headers() -> Task[dict[str, tuple[Header, ...]]]:
    """The headers of each chain of the device."""

    def task(session: Session) -> Operation[dict[str, tuple[Header, ...]]]:
        chains = dict.fromkeys(block.chain for block in session.blocks.values() if block.chain)
        found = {}
        for chain in chains:
            found[chain.id] = yield from headers_of(session, chain)
        return found

    return task


def loopback(data: int) -> Task[int]:
    """Function 08, subfunction 00: the device echoes one word."""

    def task(session: Session) -> Operation[int]:
        (echo,) = yield from session.exchange(Request(LOOPBACK, 0, 1, (data,)))
        return echo

    return task


def exception_status() -> Task[int]:
    """Function 07: eight status bits."""

    def task(session: Session) -> Operation[int]:
        (status,) = yield from session.exchange(Request(READ_STATUS, 0))
        return status

    return task
