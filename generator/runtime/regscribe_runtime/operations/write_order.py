"""In which order values are written, and which of them go in one request."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from typing import Any, NamedTuple

from regscribe_runtime.operations.session import Session
from regscribe_runtime.operations.write_request import condition_needs, write_request
from regscribe_runtime.registers.register import Register
from regscribe_runtime.report import Change, Words
from regscribe_runtime.values.conditions import registers_of
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
    return [chosen[path] for path in _sorted(waits, keys)]


def _sorted(waits: dict[str, set[str]], keys: Mapping[str, Any]) -> Iterator[str]:
    """Paths whose prerequisites went before, the one of the lowest key first; a circle is broken at its lowest key."""
    behind: dict[str, list[str]] = {}
    for path, before in waits.items():
        for one in before:
            behind.setdefault(one, []).append(path)
    ready = [(keys[path], path) for path, before in waits.items() if not before]
    heapq.heapify(ready)
    left = set(waits)
    while left:
        path = heapq.heappop(ready)[1] if ready else min(left, key=lambda one: keys[one])
        if path not in left:
            continue
        left.discard(path)
        yield path
        for one in behind.get(path, ()):
            waits[one].discard(path)
            if not waits[one] and one in left:
                heapq.heappush(ready, (keys[one], one))


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
    found = list(pieces)
    start = 0
    for at, (one, other) in enumerate(pairwise(found), start=1):
        if not _together(session, found[start:at], one, other):
            yield _batch(session, found[start:at])
            start = at
    if found:
        yield _batch(session, found[start:])


def _together(session: Session, so_far: list[RegisterWrite], one: RegisterWrite, other: RegisterWrite) -> bool:
    view, its = one.view, other.view
    bits = view.space.is_bits
    function, most = (
        (WRITE_COILS, session.protocol.write_bits) if bits else (WRITE_REGISTERS, session.protocol.write_words)
    )
    return (
        (view.space, view.functions) == (its.space, its.functions)
        and one.address + view.words == other.address
        and function in session.protocol.functions
        and view.allows(function)
        and sum(len(piece.words) for piece in so_far) + len(other.words) <= most
        and not (one.register.governs or other.register.governs)
        and not {piece.path for piece in so_far}.intersection(needs(other.register, its))
        and (one.register.unlock, one.register.apply) == (other.register.unlock, other.register.apply)
    )


def _batch(session: Session, pieces: list[RegisterWrite]) -> Batch:
    first = pieces[0]
    words = tuple(word for piece in pieces for word in piece.words)
    return Batch(write_request(session, first.view, first.address, words), tuple(pieces))


def piece(register: Register[Any], change: Change) -> RegisterWrite:
    """What a change of a register writes."""
    return RegisterWrite(register, register.view(change.view), change.sent)  # pyright: ignore[reportArgumentType] # a register is a descriptor, but no attribute of this tuple
