"""Finding the blocks of a device: chains of headers are walked once per connection, before anything of them is read."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import wraps
from typing import Any, TypeVar, cast

from regscribe_runtime.errors import (
    GATEWAY,
    BrokenChain,
    ExceptionAnswer,
    NotPresent,
    RegscribeError,
    ValueNotDecodable,
)
from regscribe_runtime.operations.session import Operation, Session, Task
from regscribe_runtime.registers import codec
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.blocks import END_OF_SPACE, HEADER, Chain, Header, RegisterBlock
from regscribe_runtime.wire.requests import Request

MOST_HEADERS = 256
"""Headers of a chain after which its end mark is taken to be missing."""

F = TypeVar("F", bound=Callable[..., Task[Any]])


class MovedError(Exception):
    """A counter changed while registers were read that stand behind the elements that it counts."""


def locating(make: F, *, fresh: bool = False) -> F:
    """The tasks of `make`, whose first argument is a register, with the register where it stands on the device.

    With `fresh` what tells where it stands in its block is read once more.
    """

    @wraps(make)
    def made(register: Register[Any], *args: Any, **how: Any) -> Task[Any]:
        def task(session: Session) -> Operation[Any]:
            here = yield from located(session, register, fresh=fresh)
            return (yield from make(here, *args, **how)(session))

        return task if register.block else make(register, *args, **how)

    return cast("F", made)


def located(session: Session, register: Register[Any], *, fresh: bool = False) -> Operation[Register[Any]]:
    """The register where it stands on the device; NotPresent if its block is not there, BrokenChain if unknown."""
    gone = yield from locate(session, [register], fresh=fresh)
    if gone:
        raise gone[register.path]
    return session.registers[register.path]


def locate(
    session: Session, registers: Iterable[Register[Any]], *, fresh: bool = False
) -> Operation[dict[str, RegscribeError]]:
    """Find the blocks of registers that are not known yet; the errors by path of registers that are not there.

    With `fresh` the counters of packed arrays in front of them are read once more.
    """
    inside = [register for register in registers if register.block] if session.blocks else []
    if fresh:
        session.forget(path for one in inside for path in session.declared[one.path].counters)
    broken: dict[Chain | None, RegscribeError] = {}
    for chain in dict.fromkeys(session.blocks[register.block].chain for register in inside):
        try:
            yield from headers(session, chain)
        except BrokenChain as error:
            broken[chain] = error
    unknown = yield from _count(session, inside)
    found: dict[str, RegscribeError | None] = {}
    for one in inside:
        uncounted = next((unknown[path] for path in session.declared[one.path].counters if path in unknown), None)
        found[one.path] = broken.get(session.blocks[one.block].chain) or uncounted or absence(session, one)
    return {path: error for path, error in found.items() if error}


def _count(session: Session, registers: Iterable[Register[Any]]) -> Operation[dict[str, RegscribeError]]:
    """Read the counters that tell where registers stand, unless they are known; the errors of those without a value."""
    unknown: dict[str, RegscribeError] = {}
    counters = [path for one in registers for path in session.declared[one.path].counters] if session.counters else []
    for path in dict.fromkeys(counters):
        counter = session.registers[path]
        if path not in session.memory and counter.origin is not None:
            view = counter.read_view()
            request = Request(view.space.read_function, view.address(counter.at), view.words)
            try:
                words = yield from session.exchange(request)
                session.remember(path, codec.decode(counter, view, words, {}, session.givens, named=False))
            except ValueNotDecodable as error:
                unknown[path] = error
    return unknown


def headers(session: Session, chain: Chain | None) -> Operation[tuple[Header, ...]]:
    """The headers of a chain, which is walked unless that was done since the link was opened; BrokenChain."""
    if chain is None:
        return ()
    if chain.id not in session.chains:
        session.found(chain, (yield from walk(session, chain)))
    return session.chains[chain.id]


def base_of(session: Session, user: str, name: str) -> Operation[int]:
    """The base of a block that `user` needs, 0 of none; NotPresent if the device lacks it."""
    if not name:
        return 0
    yield from headers(session, session.blocks[name].chain)
    if name not in session.places:
        raise _lacking(session, user, session.blocks[name])
    return session.places[name].base


def absence(session: Session, register: Register[Any]) -> NotPresent | None:
    """Why a register of a block that was looked for is not on the device; None if it is."""
    if session.registers[register.path].origin is not None:
        return None
    block = session.blocks[register.block]
    header = session.places.get(register.block)
    if header is None:
        return _lacking(session, register.path, block)
    if header.length is None:
        end = header.base + session.declared[register.path].end
        return NotPresent(register.path, "its addresses end by 65535", {"the first one behind it": str(end)})
    end = session.declared[register.path].placed(header.base, session.memory).end
    what = f"block {block.id} has {end - header.base - HEADER} words or more"
    return NotPresent(register.path, what, {f"the length of the block at {header.base}": str(header.length)})


def _lacking(session: Session, user: str, block: RegisterBlock) -> NotPresent:
    """The error of what stands in a block that the chain lacks."""
    chain = block.chain.id if block.chain else ""
    found = ", ".join(str(one.id) for one in session.chains.get(chain, ()))
    which = " or ".join(map(str, block.ids)) + (f", number {block.number}" if block.number > 1 else "")
    condition = f"block {block.id} (id {which}) is in the chain"
    return NotPresent(user, condition, {f"the list of ids in chain {chain}": found or "empty"})


def walk(session: Session, chain: Chain) -> Operation[tuple[Header, ...]]:
    """The headers of a chain on the device; BrokenChain if it has no marker, no end, or runs out of the addresses."""
    address = yield from _start(session, chain)
    found: list[Header] = []
    while len(found) <= MOST_HEADERS:
        seen = f"{len(found)} blocks (ids {', '.join(str(one.id) for one in found) or 'none'})"
        if address + HEADER > END_OF_SPACE:
            raise BrokenChain(chain.id, f"behind {seen} the next header would stand at {address}, beyond all addresses")
        try:
            identity, length = yield from _words(session, chain, address, HEADER)
        except ExceptionAnswer as error:
            _raise_of_gateway(error)
            raise BrokenChain(chain.id, f"behind {seen} there is no header at {address}: {error}") from error
        if identity == chain.end:
            return tuple(found)
        found.append(Header(identity, address, length))
        address = found[-1].end
    raise BrokenChain(chain.id, f"there are more than {MOST_HEADERS} headers up to {address}, and no end mark")


def _start(session: Session, chain: Chain) -> Operation[int]:
    """The address behind the marker."""
    seen = []
    for address in chain.at:
        if not chain.marker:
            return address
        try:
            words = yield from _words(session, chain, address, len(chain.marker))
        except ExceptionAnswer as error:
            _raise_of_gateway(error)
            seen.append(f"{address} (exception {error.code:02d})")
            continue
        if words == chain.marker:
            return address + len(chain.marker)
        seen.append(f"{address} ({_hex(words)})")
    raise BrokenChain(chain.id, f"its marker {_hex(chain.marker)} does not stand at {', '.join(seen)}")


def _words(session: Session, chain: Chain, address: int, count: int) -> Operation[tuple[int, ...]]:
    return (yield from session.exchange(Request(chain.space.read_function, address, count)))


def _raise_of_gateway(error: ExceptionAnswer) -> None:
    """A gateway that got no answer says nothing about the chain."""
    if error.code in GATEWAY and not error.name:
        raise error


def _hex(words: tuple[int, ...]) -> str:
    return " ".join(f"{word:04X}" for word in words)
