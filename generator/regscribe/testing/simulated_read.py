"""Run the read operation of a driver without a link, and check the requests that it makes."""

import inspect
from collections import Counter, defaultdict
from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from fractions import Fraction
from typing import Any, Literal, NamedTuple, get_args, get_origin

from regscribe_runtime import Absent, NotPresent, ValueNotDecodable
from regscribe_runtime.operations import tasks
from regscribe_runtime.operations.prepared_read import dependencies
from regscribe_runtime.operations.session import Pause, Session
from regscribe_runtime.operations.snapshot import Snapshot
from regscribe_runtime.planning.read_places import ReadPlace, read_places
from regscribe_runtime.registers.register import Register
from regscribe_runtime.values.blocks import RegisterBlock, headers_in, lay_out
from regscribe_runtime.values.kinds import Kind
from regscribe_runtime.values.wire_types import PAGE_BITS, Space
from regscribe_runtime.wire.requests import Reply, Request

Cell = tuple[str, int]
"""A space and a wire address."""

BITS = frozenset({"coil", "discrete"})
TEXTUAL = frozenset({Kind.STRING, Kind.VERSION})


class ReadTrace(NamedTuple):
    """The requests that a read made (their addresses with the number of their page), what it returned, its session."""

    requests: tuple[Request, ...]
    snapshot: Snapshot
    session: Session


def read_through(
    driver: Any,  # noqa: ANN401 (a generated class)
    chosen: Sequence[Register[Any]],
    *,
    seed: int = 0,
    code: int = 0,
    gone: Container[Cell] = (),
) -> ReadTrace:
    """Read registers from a device whose words follow from `seed`, and which lacks the addresses `gone`.

    Registers that the meaning of the chosen ones depends on are known to hold `code`, so that they are not read.
    """
    session = _session(driver)
    needs = frozenset().union(*dependencies(session.registers, chosen).values())
    session.memory.update({path: _holding(session.registers[path], code) for path in needs})
    operation = tasks.read_many(chosen, fresh=False)(session)
    requests: list[Request] = []
    try:
        asked = next(operation)
        while isinstance(asked, Request | Pause):
            if isinstance(asked, Pause):  # between requests, where the device needs time
                asked = operation.send(None)
                continue
            if not asked.fetches:  # it selects a page
                asked = operation.send(Reply(asked.function, asked.words, asked.address, len(asked.words)))
                continue
            space = asked.space or Space.HOLDING
            asked = asked._replace(address=asked.page << PAGE_BITS | asked.address)
            requests.append(asked)
            asked_for = [(space, asked.address + offset) for offset in range(asked.quantity)]
            words = tuple(word_at(*cell, seed) for cell in asked_for)
            refused = driver.protocol.absent if any(cell in gone for cell in asked_for) else None
            asked = operation.send(Reply(asked.function, words, exception=refused))
    except StopIteration as done:
        return ReadTrace(tuple(requests), done.value, session)
    message = f"a read asked for {asked}"
    raise TypeError(message)


def _holding(register: Register[Any], code: int) -> int | str:
    """What a register that holds `code` is remembered with: the number, or a text of its digits."""
    return str(code) if register.kind in TEXTUAL else code


def _session(driver: Any) -> Session:  # noqa: ANN401 (as above)
    """A session of a device where the blocks of the driver stand one behind the other."""
    blocks: tuple[RegisterBlock, ...] = driver._blocks  # noqa: SLF001 (a fact for the runtime and its judges)
    ends: dict[str, int] = {}
    for register in driver.registers.values():
        ends[register.block] = max(ends.get(register.block, 0), register.end, *(end for _, _, end in _places(register)))
    headers, words = lay_out(blocks, ends, {})
    session = Session(
        unit=driver.protocol.unit_ids[0],
        protocol=driver.protocol,
        registers=driver.registers,
        commands={},
        givens=givens_of(driver) | {block.given: headers[block.id].base for block in blocks if block.given},
        unused=unused_of(driver),
        pages=driver._pages,  # noqa: SLF001 (as above)
        blocks=blocks,
    )
    slips = (slip for register in driver.registers.values() for slip in register.slips)
    session.memory.update({slip.counter: slip.most for slip in slips})
    for chain in dict.fromkeys(block.chain for block in blocks if block.chain):
        session.found(
            chain, headers_in(chain, {at: word for (space, at), word in words.items() if space == chain.space})
        )
    return session


def givens_of(driver: Any) -> defaultdict[str, Any]:  # noqa: ANN401 (as above)
    """What a driver is given: its defaults, else the first choice, 1, or no codes."""
    found: defaultdict[str, Any] = defaultdict(frozenset)
    for one in inspect.signature(driver.__init__).parameters.values():
        if one.default is not inspect.Parameter.empty:
            found[one.name] = one.default
        elif get_origin(one.annotation) is Literal:
            found[one.name] = get_args(one.annotation)[0]
        elif Fraction in get_args(one.annotation):
            found[one.name] = 1
    return found


def word_at(space: str, address: int, seed: int) -> int:
    """Return the word (the bit, the status byte) at an address, always the same for a seed; 0 for the seed 0."""
    most = 1 if space in BITS else 0xFF if space == "status" else 0xFFFF
    return (address * 40503 + seed * 60493) >> 4 & most if seed else 0


def wrong_requests(driver: Any, chosen: Sequence[Register[Any]]) -> list[str]:  # noqa: ANN401 (a generated class)
    """Return what is wrong with the requests: registers left out or asked for twice, holes, limits."""
    requests, _, session = read_through(driver, chosen)
    asked = Counter(
        (request.space or Space.HOLDING, request.address + offset)
        for request in requests
        for offset in range(request.quantity)
    )
    here = [one for register in chosen if session.has(one := session.registers[register.path])]
    found = [f"{register.path} is not asked for" for register in here if not _is_read(register, asked)]
    found += [f"{space} {address} is asked for again" for (space, address), times in asked.items() if times > 1]
    found += [f"{space} {address} is no register" for space, address in sorted(_holes(driver, session, asked))]
    for request in requests:
        most = _most(driver, request.space or Space.HOLDING)
        if request.quantity > most:
            found += [f"{request.quantity} addresses from {request.address} in one request, where {most} are allowed"]
    return found


def _most(driver: Any, space: Space) -> int:  # noqa: ANN401 (as above)
    most: int = driver.protocol.most_read(space)
    return most


def _holes(driver: Any, session: Session, asked: Iterable[Cell]) -> set[Cell]:  # noqa: ANN401 (as above)
    """Return the addresses of no register, not unused and in no block; none where the device answers for holes."""
    if driver.protocol.read_holes:
        return set()
    known = {cell for register in session.registers.values() for cell in _cells(register)}
    known |= {(one.chain.space, at) for one in session.blocks.values() if one.chain for at in _inside(session, one.id)}
    known |= {(space, at) for space, first, last in unused_of(driver) for at in range(first, last + 1)}
    return set(asked) - known


def unused_of(driver: Any) -> tuple[tuple[Space, int, int], ...]:  # noqa: ANN401 (as above)
    """Return the addresses of a generated class that read as 0: space, first, last."""
    found: tuple[tuple[Space, int, int], ...] = driver._unused  # noqa: SLF001 (a fact for the runtime and its judges)
    return found


def _is_read(register: Register[Any], asked: Container[Cell]) -> bool:
    return any(
        all((place.span.space, address) in asked for address in range(place.span.address, place.span.end))
        for place in read_places(register)
    )


def _inside(session: Session, block: str) -> range:
    header = session.places[block]
    return range(header.base, header.end)


def _cells(register: Register[Any]) -> Iterator[Cell]:
    return ((space, address) for space, start, end in _places(register) for address in range(start, end))


def _places(register: Register[Any]) -> Iterator[tuple[Space, int, int]]:
    """Return the space, the first address and the first behind of each place of a register."""
    base = register.views[0]
    starts = [(view, view.address(register.at)) for view in register.views]
    starts += [(base, alias) for alias in register.aliases]
    return ((view.space, start, start + view.words) for view, start in starts)


def wrong_values(driver: Any, chosen: Sequence[Register[Any]], *, seed: int, code: int) -> list[str]:  # noqa: ANN401 (as above)
    """Return where a read of several registers gives another value (or another error) than each word alone."""
    reading = read_through(driver, chosen, seed=seed, code=code)
    found = []
    for register in chosen:
        together = _outcome(lambda path=register.path: reading.snapshot[path])  # type: ignore[misc]
        alone = [
            _outcome(lambda register=register, place=place: _alone(register, place, reading.session, seed))  # type: ignore[misc]
            for place in read_places(reading.session.registers[register.path])
        ]
        if together not in alone:
            found.append(f"{register.path}: {together} with others, {alone[0]} alone")
    return found


def wrong_without(driver: Any, optional: Sequence[str]) -> list[str]:  # noqa: ANN401 (as above)
    """Return what is wrong with a read of all registers from a device that lacks the optional ones.

    They are absent, and so is what stands at their addresses alone; everything else is read as on another device.
    Nothing is tried where a device does not answer for addresses that it does not have.
    """
    chosen = [one for one in driver.registers.values() if one.is_read_along]
    if not driver.protocol.absent:
        return []
    whole = read_through(driver, chosen, seed=1)
    lacking = set(optional)
    gone = {cell for path, one in whole.session.registers.items() if path in lacking for cell in _cells(one)}
    partly = read_through(driver, chosen, seed=1, gone=gone)
    found = []
    for path in partly.snapshot:
        places = read_places(whole.session.registers[path])
        absent = all(any((place.span.space, at) in gone for at in _addresses(place)) for place in places)
        there, before = (_outcome(lambda path=path, of=of: of.snapshot[path]) for of in (partly, whole))  # type: ignore[misc]
        expected = (Absent.__name__, "") if absent and before[0] != NotPresent.__name__ else before
        if there != expected:
            found.append(f"{path}: {there} of a device without {', '.join(optional)}, expected {expected}")
    return found


def _addresses(place: ReadPlace) -> range:
    return range(place.span.address, place.span.end)


def _alone(register: Register[Any], place: ReadPlace, session: Session, seed: int) -> Any:  # noqa: ANN401 (any value)
    if not session.has(register):
        raise NotPresent(register.path, "", {})
    words = [word_at(place.span.space, address, seed) for address in range(place.span.address, place.span.end)]
    return register.decode(words, view=place.view.name, state=session.memory, givens=session.givens)


def _outcome(read: Callable[[], Any]) -> tuple[str, Any]:
    try:
        value = read()
    except (NotPresent, Absent) as error:
        return type(error).__name__, ""
    except ValueNotDecodable as error:
        return type(error).__name__, str(error)
    return type(value).__name__, value
