"""The order in which values are written, and which of them go in one request."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from regscribe_runtime.operations.read_back import RegisterWrite
from regscribe_runtime.operations.session import Session
from regscribe_runtime.operations.write_request import condition_needs, write_request
from regscribe_runtime.planning.dependency_order import dependency_order
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.conditions import registers_of
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.views import View
from regscribe_runtime.wire.requests import Request

LAST = 1 << 30
"""The place of a group without one."""


class Batch(NamedTuple):
    """One write request and the values in it, in the order of their addresses."""

    request: Request
    pieces: tuple[RegisterWrite, ...]


def needs(register: Register[Any], view: View) -> tuple[str, ...]:
    """Registers to write before this one: its meaning, its limits or its permission depend on them."""
    return (*register.needs(view), *register.limit_needs, *condition_needs(register), *registers_of(register.unit))


def order(session: Session, registers: Iterable[Register[Any]]) -> list[Register[Any]]:
    """The registers in the order of writing.

    Dependencies come first; then the map's order of groups counts; in a group addresses, so that neighbours share a
    request. What governs the line comes last: if the device is lost, all else is done.
    """
    chosen = {register.path: register for register in registers}
    waits = {
        path: {one for one in needs(register, register.write_view()) if one in chosen and one != path}
        for path, register in chosen.items()
    }
    places = {
        member: LAST if group.order is None else group.order
        for group in session.groups.values()
        for member in group.members
    }

    def rank(path: str) -> tuple[bool, int, str, str, int]:
        register, view = chosen[path], chosen[path].write_view()
        place = places.get(path.partition("[")[0], LAST)
        return bool(register.governs), place, view.space, view.name, view.address(register.at)

    return [chosen[path] for path in dependency_order(waits, rank)]


def batches(session: Session, pieces: Iterable[RegisterWrite]) -> Iterator[Batch]:
    """The requests that write pieces in their order: neighbours in one, as far as the device takes them together.

    What depends on a value goes in a later request: a device may check a whole request before it takes any of it.
    """
    groups: list[list[RegisterWrite]] = []
    for each in pieces:
        if groups and _fits(session.protocol, groups[-1], each):
            groups[-1].append(each)
        else:
            groups.append([each])
    for group in groups:
        words = tuple(word for piece in group for word in piece.words)
        yield Batch(write_request(session, group[0].view, group[0].address, words), tuple(group))


def _fits(protocol: Protocol, batch: list[RegisterWrite], other: RegisterWrite) -> bool:
    """Whether the device takes a value in one request with those of a batch."""
    last, count = batch[-1], sum(len(each.words) for each in (*batch, other))
    space = last.view.space
    function, most = space.write_functions[-1], protocol.most_written(space)
    return (
        last.address + last.view.words == other.address
        and not last.register.governs
        and _common(last) == _common(other)
        and count <= min(most, space.most)
        and function in protocol.functions
        and last.view.allows(function)
        and not {each.path for each in batch}.intersection(needs(other.register, other.view))
    )


def _common(one: RegisterWrite) -> tuple[object, ...]:
    """What values of one request must have in common."""
    return one.view.space, one.view.functions, one.register.unlock, one.register.apply, one.register.governs
