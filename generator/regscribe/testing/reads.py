"""Drive the read operation of a driver without a link, and judge the requests that it makes."""

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence
from typing import Any

from regscribe.runtime import operations
from regscribe.runtime.register import Register
from regscribe.runtime.request import READ_FUNCTIONS, Reply, Request
from regscribe.runtime.session import Protocol, Session
from regscribe.runtime.spec import View

Cell = tuple[str, int]
"""A space and a wire address."""

SPACES = {function: space for space, function in READ_FUNCTIONS.items()}
BITS = frozenset({"coil", "discrete"})


def read_through(driver: Any, chosen: Sequence[Register[Any]]) -> list[str]:  # noqa: ANN401 (a generated class)
    """Read registers from a device whose words are all zero; return what is wrong with the requests."""
    if not chosen:
        return []
    requests = tuple(_requests(driver, chosen))
    asked = Counter(cell for request in requests for cell in _cells(SPACES[request.function], request))
    wanted = Counter(cell for register in chosen for cell in _cells_of(register, register.view()))
    known = {
        cell for register in driver.registers.values() for view in register.views for cell in _cells_of(register, view)
    }
    found = [f"{space} {address} is asked for {asked[space, address]} times" for space, address in wanted - asked]
    found += [f"{space} {address} is asked for again" for space, address in asked if asked[space, address] > 1]
    if not driver.protocol.read_holes:
        found += [f"{space} {address} is no register" for space, address in asked if (space, address) not in known]
    return found + [text for request in requests for text in _too_much(driver.protocol, request)]


def _requests(driver: Any, chosen: Sequence[Register[Any]]) -> Iterator[Request]:  # noqa: ANN401 (as above)
    session = Session(
        unit=driver.protocol.unit_ids[0],
        protocol=driver.protocol,
        registers=driver.registers,
        commands={},
        givens=defaultdict(frozenset),
    )
    needs = (path for register in chosen for path in register.needs(register.view()))
    session.memory.update(dict.fromkeys(needs, 0))  # what decides about them is known, so only they are read
    operation = operations.read_many(chosen)(session)
    try:
        request = next(operation)
        while True:
            if not isinstance(request, Request):
                message = f"a read paused: {request}"
                raise TypeError(message)
            yield request
            request = operation.send(Reply(request.function, (0,) * request.quantity))
    except StopIteration:
        return


def _cells(space: str, request: Request) -> Iterator[Cell]:
    return ((space, request.address + offset) for offset in range(request.quantity))


def _cells_of(register: Register[Any], view: View) -> Iterator[Cell]:
    starts = (view.address(register.at), *(register.aliases if view is register.views[0] else ()))
    wanted = starts[:1] if view is register.view() else starts
    return ((view.space, start + offset) for start in wanted for offset in range(view.words))


def _too_much(protocol: Protocol, request: Request) -> Iterator[str]:
    most = protocol.read_bits if SPACES[request.function] in BITS else protocol.read_words
    if request.quantity > most:
        yield f"{request.quantity} addresses from {request.address} in one request, where {most} are allowed"
