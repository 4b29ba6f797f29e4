"""In which order values are written, and which of them go in one request."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from regscribe_runtime.operations.session import Session
from regscribe_runtime.operations.write_request import condition_needs, write_request
from regscribe_runtime.planning.dependency_order import dependency_order
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Words
from regscribe_runtime.values.conditions import registers_of
from regscribe_runtime.values.protocol import Protocol
from regscribe_runtime.values.views import View
from regscribe_runtime.wire.requests import WRITE_COILS, WRITE_REGISTERS, Request

LAST = 1 << 30
"""The place of a group without one."""


class RegisterWrite(NamedTuple):
    """One value to write: where it stands and its words."""

    register: Register[Any]
    view: View
    words: Words

    @property
    def path(self) -> str:
        """The register's path."""
        return self.register.path

    @property
    def address(self) -> int:
        """The wire address of the first word."""
        return self.view.address(self.register.at)


class Batch(NamedTuple):
    """One write request and the values in it, in the order of their addresses."""

    request: Request
    pieces: tuple[RegisterWrite, ...]


def needs(register: Register[Any], view: View) -> tuple[str, ...]:
    """Registers that must hold their new value first: they decide what this one means, its limits, its permission."""
    return (*register.needs(view), *register.limit_needs, *condition_needs(register), *registers_of(register.unit))


def order(session: Session, registers: Iterable[Register[Any]]) -> list[Register[Any]]:
    """The registers as they are to be written.

    First what others depend on; then as the groups of the map are ordered; in a group by address, so that neighbours
    share a request. What governs the line comes last: if the device gets lost, all else is done.
    """
    chosen = {register.path: register for register in registers}
    waits = {
        path: {one for one in needs(register, register.write_view()) if one in chosen and one != path}
        for path, register in chosen.items()
    }
    places = _places(session)
    keys = {path: _key(register, places) for path, register in chosen.items()}
    return [chosen[path] for path in dependency_order(waits, keys.__getitem__)]


def _places(session: Session) -> dict[str, int]:
    return {
        member: LAST if group.order is None else group.order
        for group in session.groups.values()
        for member in group.members
    }


def _key(register: Register[Any], places: Mapping[str, int]) -> tuple[bool, int, str, str, int]:
    view = register.write_view()
    place = places.get(register.path.partition("[")[0], LAST)
    return bool(register.governs), place, view.space, view.name, view.address(register.at)


def batches(session: Session, pieces: Iterable[RegisterWrite]) -> Iterator[Batch]:
    """The requests that write pieces in their order: neighbours in one, as far as the device takes them together.

    What depends on a value goes in a later request: a device may check all of a request before it takes any of it.
    """
    so_far: list[RegisterWrite] = []
    for each in pieces:
        if so_far and not _together(session.protocol, so_far, each):
            yield _batch(session, so_far)
            so_far = []
        so_far.append(each)
    if so_far:
        yield _batch(session, so_far)


def _together(protocol: Protocol, so_far: list[RegisterWrite], other: RegisterWrite) -> bool:
    one = so_far[-1]
    return (
        one.address + one.view.words == other.address
        and not (one.register.governs or other.register.governs)
        and _manner(one) == _manner(other)
        and _takes(protocol, one.view, sum(len(each.words) for each in (*so_far, other)))
        and not {each.path for each in so_far}.intersection(needs(other.register, other.view))
    )


def _manner(one: RegisterWrite) -> tuple[object, ...]:
    """What values that are written in one request have in common."""
    return one.view.space, one.view.functions, one.register.unlock, one.register.apply


def _takes(protocol: Protocol, view: View, count: int) -> bool:
    """Whether the device takes so many values of a view in one request."""
    function, most = WRITE_REGISTERS, protocol.write_words
    if view.space.is_bits:
        function, most = WRITE_COILS, protocol.write_bits
    return count <= most and function in protocol.functions and view.allows(function)


def _batch(session: Session, pieces: list[RegisterWrite]) -> Batch:
    first = pieces[0]
    words = tuple(word for piece in pieces for word in piece.words)
    return Batch(write_request(session, first.view, first.address, words), tuple(pieces))
